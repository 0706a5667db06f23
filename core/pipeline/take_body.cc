#include "core/pipeline/take_body.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>

#include "core/base/status.h"
#include "core/body/attach_shells.h"
#include "core/body/find_body.h"
#include "core/body/skeleton_names.h"
#include "core/formats/soup_checks.h"
#include "core/mesh/prepare_mesh.h"
#include "core/mesh/triangulate_faces.h"
#include "core/solid/make_solid.h"
#include "core/solid/scan_parts.h"

namespace capfit::pipeline {
namespace {

using Joints = std::map<body::LandmarkId, Eigen::Vector3d>;

// A surface that leaves more of the file's area than this behind is perhaps not all of the body.
constexpr double kCrumbs = 0.02;

// The mesh to understand, and, where it is a solid, the shells that it was made around.
struct TakenMesh {
  mesh::BodyMesh mesh;
  std::vector<mesh::Triangle> shells;  // indices into the soup's positions; empty: none
  std::vector<Warning> warnings;
};

class BodyTaker {
 public:
  BodyTaker(const formats::PolygonSoup& soup, const FitOptions& options, const ThreadPool& pool,
            FitObserver& observer, std::vector<Warning>& warnings)
      : soup_(soup), options_(options), pool_(pool), observer_(observer), warnings_(warnings) {}

  absl::StatusOr<TakenBody> Run() {
    observer_.OnStage(Stage::kMesh, 0.0);
    // One part is checked where it is mended.
    if (!IsOnePart()) CAPFIT_RETURN_IF_ERROR(formats::CheckSoup(soup_, {}, pool_));
    CAPFIT_ASSIGN_OR_RETURN(const TakenMesh taken, TakeMesh());
    observer_.OnStage(Stage::kBody, 0.0);
    absl::StatusOr<TakenBody> understood = Understand(taken);
    if (!understood.ok()) {
      absl::StatusOr<TakenBody> better = TryWithoutFloor(understood.status());
      if (!better.ok()) Tell(taken);
      return better;
    }
    TakenBody found = *std::move(understood);
    if (!character_ || character_->has_joints) return Finish(std::move(found), taken);
    return LookAgain(std::move(found), taken);
  }

 private:
  [[nodiscard]] bool IsOnePart() const {
    const character::CharacterOptions& asked = options_.character;
    return soup_.parts.size() <= 1 && asked.include.empty() && asked.exclude.empty();
  }

  // A closed mesh that is no body may be one with a stand under it, as scanners close them.
  absl::StatusOr<TakenBody> TryWithoutFloor(const absl::Status& refusal) {
    if (!IsOnePart() || character_ || !MayBeShells(refusal)) return refusal;
    FindFloor();
    if (is_floor_.empty()) return refusal;
    absl::StatusOr<character::Character> parts = LookAtParts({});
    if (!parts.ok()) return refusal;
    character_ = *std::move(parts);
    const absl::StatusOr<TakenMesh> taken = TakeCharacter();
    if (!taken.ok()) return refusal;
    absl::StatusOr<TakenBody> found = Understand(*taken);
    if (!found.ok()) return refusal;
    return LookAgain(*std::move(found), *taken);
  }

  absl::StatusOr<TakenMesh> TakeMesh() {
    absl::Status refusal;
    if (IsOnePart()) {
      absl::StatusOr<mesh::PreparedMesh> prepared = mesh::PrepareMesh(soup_, {}, pool_, observer_);
      if (!prepared.ok() && !MayBeShells(prepared.status())) return prepared.status();
      if (!prepared.ok() || !IsClosed(*prepared)) FindFloor();
      const bool is_whole = prepared.ok() && prepared->left_out_share < kCrumbs;
      if (is_whole && is_floor_.empty()) return FromPrepared(*prepared);
      refusal = prepared.status();
    }
    absl::StatusOr<character::Character> found = LookAtParts(RigJoints());
    // What the mesh room says of one part is nearer to the cause.
    if (!found.ok()) return refusal.ok() ? found.status() : refusal;
    character_ = *std::move(found);
    absl::StatusOr<TakenMesh> taken = TakeCharacter();
    return taken.ok() || refusal.ok() ? std::move(taken) : refusal;
  }

  [[nodiscard]] absl::StatusOr<character::Character> LookAtParts(const Joints& joints) const {
    return character::FindCharacter(soup_, options_.character, joints, pool_, is_floor_);
  }

  // As it came: a scan with a floor is open, or made of pieces.
  [[nodiscard]] static bool IsClosed(const mesh::PreparedMesh& prepared) {
    const auto is_opening = [](const Warning& warning) {
      return warning.code == "HOLES_CLOSED" || warning.code == "PARTS_LEFT_OUT";
    };
    return std::none_of(prepared.warnings.begin(), prepared.warnings.end(), is_opening);
  }

  // Marks the faces of a floor or a stand; who has a skeleton was not scanned.
  void FindFloor() {
    if (!soup_.joints.empty()) return;
    std::vector<mesh::Triangle> triangles;
    std::vector<std::size_t> face_of_triangle;
    std::size_t at = 0;
    for (std::size_t face = 0; face < soup_.face_count(); ++face) {
      const std::size_t size = soup_.face_sizes.empty() ? 3 : soup_.face_sizes[face];
      const std::uint32_t* const v = soup_.face_vertices.data() + at;
      for (std::size_t k = 2; k < size; ++k) {
        if (v[0] == v[k - 1] || v[0] == v[k] || v[k - 1] == v[k]) continue;
        triangles.push_back({v[0], v[k - 1], v[k]});
        face_of_triangle.push_back(face);
      }
      at += size;
    }
    const solid::ScanParts parts = solid::FindScanParts(soup_.positions, triangles, observer_);
    if (!parts.floor) return;
    is_floor_.assign(soup_.face_count(), 0);
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      if (parts.of_triangle[t] == solid::ScanPart::kFloor) is_floor_[face_of_triangle[t]] = 1;
    }
  }

  [[nodiscard]] static bool MayBeShells(const absl::Status& refusal) {
    return refusal.code() == absl::StatusCode::kFailedPrecondition;
  }

  [[nodiscard]] Joints RigJoints() const {
    return options_.landmarks.empty() ? body::ReadRig(soup_.joints).landmarks : options_.landmarks;
  }

  static TakenMesh FromPrepared(mesh::PreparedMesh& prepared) {
    return {std::move(prepared.mesh), {}, std::move(prepared.warnings)};
  }

  // What belongs to the character: mended, if it is one surface, else a solid around it.
  absl::StatusOr<TakenMesh> TakeCharacter() {
    absl::Status refusal;
    if (character_->surface_count == 1) {
      absl::StatusOr<mesh::PreparedMesh> prepared =
          mesh::PrepareMesh(soup_, {}, pool_, observer_, character_->is_left_out);
      if (prepared.ok()) return FromPrepared(*prepared);
      refusal = prepared.status();
      if (!MayBeShells(refusal)) return refusal;
    }
    std::vector<mesh::Triangle> triangles =
        mesh::TriangulateFaces(formats::WithFaces(soup_, character_->is_left_out, 0),
                               soup_.positions)
            .triangles;
    absl::StatusOr<solid::Solid> made =
        solid::MakeSolid(soup_.positions, triangles, {}, pool_, observer_);
    if (!made.ok()) return refusal.ok() ? made.status() : refusal;
    return TakenMesh{std::move(made->mesh), std::move(triangles), std::move(made->warnings)};
  }

  absl::StatusOr<TakenBody> Understand(const TakenMesh& taken) {
    body::BodyOptions body_options;
    body_options.unit = options_.unit;
    body_options.up = options_.up;
    body_options.landmarks = options_.landmarks;
    body_options.skeleton = soup_.joints;
    body_options.required = options_.require_parts;
    CAPFIT_ASSIGN_OR_RETURN(body::Body body,
                            body::FindBody(taken.mesh, body_options, pool_, observer_));
    return TakenBody{std::move(body), {}, taken.mesh.box_min(), taken.mesh.box_max()};
  }

  void Tell(const TakenMesh& taken) {
    if (character_) Append(character_->warnings, warnings_);
    Append(taken.warnings, warnings_);
  }

  TakenBody Finish(TakenBody found, const TakenMesh& taken) {
    Tell(taken);
    Append(found.body.warnings, warnings_);
    if (character_) found.parts = character_->parts;
    if (!taken.shells.empty()) {
      body::AttachShells(soup_.positions, taken.shells, pool_, found.body);
    }
    return found;
  }

  // Without a skeleton only names and sizes were known; now landmarks are.
  absl::StatusOr<TakenBody> LookAgain(TakenBody found, const TakenMesh& taken) {
    absl::StatusOr<character::Character> again = LookAtParts(JointsOf(found.body));
    if (!again.ok()) return Finish(std::move(found), taken);
    const bool is_same = again->is_left_out == character_->is_left_out;
    std::swap(*character_, *again);
    if (is_same) return Finish(std::move(found), taken);
    const absl::StatusOr<TakenMesh> better = TakeCharacter();
    if (better.ok()) {
      absl::StatusOr<TakenBody> anew = Understand(*better);
      if (anew.ok()) return Finish(*std::move(anew), *better);
    }
    // What the second look leaves is no body: then the first one was right.
    std::swap(*character_, *again);
    return Finish(std::move(found), taken);
  }

  [[nodiscard]] static Joints JointsOf(const body::Body& body) {
    const geometry::Similarity caller_from_body = body.body_from_caller.Inverse();
    Joints joints;
    for (int i = 0; i < body::kLandmarkCount; ++i) {
      const auto id = static_cast<body::LandmarkId>(i);
      const std::optional<body::Landmark>& landmark = body.landmark(id);
      if (landmark) joints[id] = caller_from_body.Apply(landmark->position_m);
    }
    return joints;
  }

  const formats::PolygonSoup& soup_;
  const FitOptions& options_;
  const ThreadPool& pool_;
  FitObserver& observer_;
  std::vector<Warning>& warnings_;
  std::optional<character::Character> character_;
  std::vector<char> is_floor_;  // by face; empty: there is none
};

}  // namespace

absl::StatusOr<TakenBody> TakeBody(const formats::PolygonSoup& soup, const FitOptions& options,
                                   const ThreadPool& pool, FitObserver& observer,
                                   std::vector<Warning>& warnings) {
  return BodyTaker(soup, options, pool, observer, warnings).Run();
}

}  // namespace capfit::pipeline
