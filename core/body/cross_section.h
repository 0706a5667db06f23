// Where a plane cuts the surface, as closed loops.
#ifndef CAPFIT_CORE_BODY_CROSS_SECTION_H_
#define CAPFIT_CORE_BODY_CROSS_SECTION_H_

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/base/thread_pool.h"
#include "core/mesh/body_mesh.h"
#include "core/mesh/plane_cutter.h"

namespace capfit::body {

// The plane through `origin` across `normal` (length 1).
struct CutPlane {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitY();

  [[nodiscard]] double Height(const Eigen::Vector3d& p) const { return normal.dot(p - origin); }
};

// One loop of a section. Unit and frame are those of the points cut.
struct SectionLoop {
  std::vector<Eigen::Vector3d> outline;  // in order; the last joins the first when closed
  bool is_closed = false;                // open where the triangles given end
  double girth = 0.0;                    // length of the outline
  double area = 0.0;                     // of the flat figure; negative for the rim of a hole
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();  // of the area

  // Extent of the outline along a direction.
  [[nodiscard]] double Max(const Eigen::Vector3d& direction) const;
  [[nodiscard]] double Min(const Eigen::Vector3d& direction) const;
};

// Triangles that will be cut by many planes, to loops.
class CutSurface {
 public:
  // As mesh::PlaneCutter.
  CutSurface(std::span<const Eigen::Vector3d> points, std::span<const mesh::Triangle> triangles,
             const ThreadPool& pool = ThreadPool(1))
      : cutter_(std::make_shared<const mesh::PlaneCutter>(points, triangles, pool)) {}

  // All loops of the section, the largest area first. Outlines run counter-clockwise as seen
  // against the normal.
  [[nodiscard]] std::vector<SectionLoop> Cut(const CutPlane& plane) const;

  // The same for several planes at once.
  [[nodiscard]] std::vector<std::vector<SectionLoop>> CutAll(std::span<const CutPlane> planes,
                                                             const ThreadPool& pool) const;

  // The closed loop whose centroid is nearest to the plane's origin, loops of less than
  // `min_girth` left out.
  [[nodiscard]] std::optional<SectionLoop> CutNearest(const CutPlane& plane,
                                                      double min_girth) const;

  [[nodiscard]] std::span<const Eigen::Vector3d> points() const { return cutter_->points(); }
  [[nodiscard]] std::shared_ptr<const mesh::PlaneCutter> cutter() const { return cutter_; }

 private:
  std::shared_ptr<const mesh::PlaneCutter> cutter_;
};

}  // namespace capfit::body

#endif  // CAPFIT_CORE_BODY_CROSS_SECTION_H_
