#include "core/body/find_parts.h"

#include <algorithm>
#include <string>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/body/chains.h"
#include "core/body/landmarks.h"
#include "core/body/mirror.h"
#include "core/body/segments.h"
#include "core/body/shape.h"
#include "core/body/told_landmarks.h"

namespace capfit::body {
namespace {

// Turns the limbs found into left and right ones.
void AssignSides(const Extremities& extremities, const IntrinsicFrame& frame, Shape& shape) {
  const int first_foot = frame.first_foot_is_left ? kLeft : kRight;
  const int first_hand = frame.first_hand_is_left ? kLeft : kRight;
  shape.head = extremities.limb(Tip::kHead);
  shape.arms[first_hand] = extremities.limb(Tip::kHandA);
  shape.arms[1 - first_hand] = extremities.limb(Tip::kHandB);
  shape.legs[first_foot] = extremities.limb(Tip::kFootA);
  shape.legs[1 - first_foot] = extremities.limb(Tip::kFootB);
  shape.legs_are_cut = extremities.legs_are_cut;
}

absl::Status CheckRequired(const Body& body, const PartSelection& required) {
  const std::array<bool, kPartCount> has_vertices = PartsAmong(body.vertex_segments);
  std::string missing;
  for (int i = 0; i < kPartCount; ++i) {
    const Part part = static_cast<Part>(i);
    const bool is_found = i < kChainCount ? body.chain(part).has_value() : has_vertices[i];
    if (!required.Includes(part) || is_found) continue;
    absl::StrAppend(&missing, missing.empty() ? "" : ", ", std::string(PartName(part)));
  }
  if (missing.empty()) return absl::OkStatus();
  return Refused(ErrorReason::kPartMissing,
                 absl::StrCat("required but not found on this body: ", missing));
}

// Landmarks, segments and curves, once the frame is known.
class Anatomist {
 public:
  Anatomist(const BodyOptions& options, const FramedBody& found, const ThreadPool& pool,
            const FitObserver& observer, Body& body)
      : options_(options),
        found_(found),
        body_(body),
        surface_(found.coarse.points, found.coarse.triangles, pool),
        mesh_surface_(body.mesh.vertices(), body.mesh.triangles(), pool) {
    shape_.vertices = body.mesh.vertices();
    shape_.mesh_triangles = body.mesh.triangles();
    shape_.first_triangle = body.mesh.first_triangle();
    shape_.mesh_surface = &mesh_surface_;
    body.cutter = mesh_surface_.cutter();
    shape_.coarse = &found.coarse;
    shape_.points = found.coarse.points;
    shape_.triangles = found.coarse.triangles;
    shape_.graph = &found.graph;
    shape_.surface = &surface_;
    shape_.pool = &pool;
    shape_.observer = &observer;
    shape_.top_m = body.height_m;
  }

  absl::Status Run() {
    const FitObserver& observer = *shape_.observer;
    shape_.stature_m = found_.stature_m;
    shape_.distance_unit_m = found_.distance_unit_m;
    CAPFIT_RETURN_IF_ERROR(CheckCancelled(observer));
    AssignSides(found_.extremities, found_.frame, shape_);
    CAPFIT_ASSIGN_OR_RETURN(body_.landmarks,
                            ToldLandmarks(options_, found_.rig, body_.body_from_caller,
                                          found_.extremities, shape_, body_.warnings));
    CAPFIT_RETURN_IF_ERROR(CheckCancelled(observer));
    CAPFIT_RETURN_IF_ERROR(
        FindLandmarks(found_.extremities, shape_, body_.landmarks, body_.warnings));
    if (!AllLandmarksFinite()) {
      return Refused(ErrorReason::kNotABody,
                     "not a human body: a limb has no sections from which its landmarks could be "
                     "measured");
    }
    CAPFIT_RETURN_IF_ERROR(CheckCancelled(observer));
    body_.is_symmetric = IsSymmetric(shape_, body_.landmarks);
    if (body_.is_symmetric) {
      Symmetrise(body_.landmarks);
      Symmetrise(shape_);
    }
    CAPFIT_RETURN_IF_ERROR(CheckCancelled(observer));
    shape_.pool->ForEach(2, [this](std::size_t half) {
      if (half == 0) body_.vertex_segments = LabelVertices(shape_, body_.landmarks);
      if (half == 1) body_.chains = BuildChains(shape_, body_.landmarks);
    });
    CAPFIT_RETURN_IF_ERROR(CheckCancelled(observer));
    if (body_.is_symmetric) Symmetrise(body_.chains);
    return CheckRequired(body_, options_.required);
  }

 private:
  [[nodiscard]] bool AllLandmarksFinite() const {
    return std::all_of(body_.landmarks.begin(), body_.landmarks.end(), [](const auto& landmark) {
      return !landmark.has_value() || landmark->position_m.allFinite();
    });
  }

  const BodyOptions& options_;
  const FramedBody& found_;
  Body& body_;
  CutSurface surface_;
  CutSurface mesh_surface_;
  Shape shape_;
};
}  // namespace

absl::Status FindParts(const BodyOptions& options, const FramedBody& found, const ThreadPool& pool,
                       const FitObserver& observer, Body& body) {
  return Anatomist(options, found, pool, observer, body).Run();
}

}  // namespace capfit::body
