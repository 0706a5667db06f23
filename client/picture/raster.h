// What is seen at each point of a picture: a z-buffer for triangles and for tapered capsules.
#ifndef CAPFIT_CLIENT_PICTURE_RASTER_H_
#define CAPFIT_CLIENT_PICTURE_RASTER_H_

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "client/picture/view.h"
#include "core/geometry/tapered_capsule.h"
#include "core/mesh/body_mesh.h"

namespace capfit::client {

// The nearest thing at one sample: which, and how near.
struct Hit {
  float depth = -std::numeric_limits<float>::infinity();
  std::int32_t id = -1;  // -1: nothing
};

// width x height samples, row by row; sample (i, j) is at the pixel coordinates (i + 0.5, j + 0.5).
class Raster {
 public:
  Raster(int width, int height)
      : width_(width),
        height_(height),
        hits_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] const Hit& at(int i, int j) const { return hits_[Index(i, j)]; }

  // Draws the triangles; the id is the triangle's number.
  void DrawMesh(std::span<const Eigen::Vector3d> vertices,
                std::span<const mesh::Triangle> triangles, const View& view);
  // Draws the capsules by a ray for each sample, exact; the id is the capsule's number.
  void DrawCapsules(std::span<const geometry::TaperedCapsule> capsules, const View& view);

 private:
  [[nodiscard]] std::size_t Index(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(i);
  }
  void Put(int i, int j, double depth, std::size_t id) {
    Hit& hit = hits_[Index(i, j)];
    if (static_cast<float>(depth) > hit.depth) {
      hit = {static_cast<float>(depth), static_cast<std::int32_t>(id)};
    }
  }
  void DrawTriangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                    std::size_t id);
  void DrawCapsule(const geometry::TaperedCapsule& capsule, const View& view, std::size_t id);

  int width_;
  int height_;
  std::vector<Hit> hits_;
};

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_PICTURE_RASTER_H_
