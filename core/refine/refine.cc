#include "core/refine/refine.h"

#include <cstddef>
#include <limits>
#include <utility>

#include "core/base/status.h"
#include "core/base/work_meter.h"
#include "core/refine/best_fit/find_best_fit.h"
#include "core/refine/enclosing/find_enclosing.h"

namespace capfit::refine {
namespace {

using Vec3 = Eigen::Vector3d;

body::Part PartAt(const body::Body& body, const Vec3& point_m) {
  double least = std::numeric_limits<double>::max();
  std::size_t nearest = 0;
  const auto vertices = body.mesh.vertices();
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const double distance = (vertices[v] - point_m).squaredNorm();
    if (distance < least) least = distance, nearest = v;
  }
  return body::PartOf(body.vertex_segments[nearest]);
}

// The two of a pair belong to the two parts of a pair, and what lies in the middle to the trunk.
void MirrorParts(const body::PartSelection& parts, capsule::PrimitiveSet& set) {
  for (std::size_t v = 0; v < set.origins.size(); ++v) {
    body::Part& part = set.origins[v].part;
    const int image = set.origins[v].mirror;
    if (std::cmp_greater(image, v)) set.origins[image].part = body::MirrorPart(part);
    if (std::cmp_equal(image, v) && body::MirrorPart(part) != part && parts.torso) {
      part = body::Part::kTorso;
    }
  }
}

}  // namespace

capsule::PrimitiveSet RefineSet(const body::Body& body, const tighten::CoverTarget& target,
                                const RefineOptions& options, const ThreadPool& pool,
                                FitObserver& observer) {
  WorkMeter meter(observer);
  const capsule::MirroredSet graph = options.enclose
                                         ? FindEnclosing(body, target, options, pool, meter)
                                         : FindBestFit(body, options, pool, meter);
  meter.Expect(1.0, 1);
  capsule::PrimitiveSet set = graph.set();
  pool.ForEach(graph.spheres().size(), [&](std::size_t v) {
    // An image's part is the image of a part.
    if (observer.IsCancelled() || !graph.IsRepresentative(static_cast<int>(v))) return;
    set.origins[v].part = PartAt(body, graph.spheres()[v].center_m);
  });
  if (graph.is_mirrored()) MirrorParts(options.parts, set);
  return set;
}

capsule::PrimitiveSet SettleSet(const body::Body& body, const RefineOptions& options,
                                const ThreadPool& pool, FitObserver& observer,
                                capsule::PrimitiveSet set) {
  if (set.spheres.empty()) return set;
  WorkMeter meter(observer);
  return SettleBestFit(body, options, pool, meter, std::move(set)).set();
}

absl::StatusOr<capsule::PrimitiveSet> FitToLayout(const body::Body& body,
                                                  const tighten::CoverTarget& target,
                                                  const KeptLayout& layout,
                                                  const RefineOptions& options,
                                                  const ThreadPool& pool, FitObserver& observer) {
  CAPFIT_ASSIGN_OR_RETURN(capsule::MirroredSet graph, HangLayout(layout, body));
  WorkMeter meter(observer);
  if (options.enclose) {
    SettleHungEnclosing(target, options, pool, meter, graph);
  } else {
    SettleHungBestFit(body, options, pool, meter, graph);
  }
  return graph.set();
}

}  // namespace capfit::refine
