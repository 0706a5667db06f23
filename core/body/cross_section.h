// Where a plane cuts the surface, as closed loops.
#ifndef CAPFIT_CORE_BODY_CROSS_SECTION_H_
#define CAPFIT_CORE_BODY_CROSS_SECTION_H_

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "core/base/thread_pool.h"
#include "core/mesh/body_mesh.h"

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

// Triangles that will be cut by many planes. Neighbouring triangles are looked at in groups, each
// with a box around it, so that a plane touches few of them when neighbours in the list are
// neighbours in space.
class CutSurface {
 public:
  // Both spans must outlive this. O(triangles).
  CutSurface(std::span<const Eigen::Vector3d> points, std::span<const mesh::Triangle> triangles,
             const ThreadPool& pool = ThreadPool(1));

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

  [[nodiscard]] std::span<const Eigen::Vector3d> points() const { return points_; }

 private:
  struct Box {
    Eigen::Vector3d center = Eigen::Vector3d::Zero();
    Eigen::Vector3d half = Eigen::Vector3d::Zero();
  };
  std::span<const Eigen::Vector3d> points_;
  std::span<const mesh::Triangle> triangles_;
  std::vector<Box> groups_;  // of triangles
  std::vector<Box> blocks_;  // of groups
};

}  // namespace capfit::body

#endif  // CAPFIT_CORE_BODY_CROSS_SECTION_H_
