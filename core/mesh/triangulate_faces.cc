#include "core/mesh/triangulate_faces.h"

#include <Eigen/Geometry>  // cross
#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "core/mesh/triangulate_loop.h"

namespace capfit::mesh {
namespace {

// Steps of the search for the least area (n^3 / 6 for a face of n corners, some nanoseconds each)
// that one mesh may take: a million hexagons, or one face of 600 corners. What is beyond is filled
// by cutting ears.
constexpr std::size_t kMostCuttingSteps = 40'000'000;

// Where one face in this many would fold over, the quads were made by joining triangles.
constexpr std::size_t kManyFolded = 100;

class FaceTriangulator {
 public:
  FaceTriangulator(const formats::PolygonSoup& soup, std::span<const Eigen::Vector3d> positions)
      : soup_(soup), positions_(positions) {}

  TriangulatedFaces Run() {
    const std::span<const std::uint32_t> corners = soup_.face_vertices;
    if (soup_.HasTrianglesOnly()) {
      const std::span<const Triangle> faces = FacesAsTriangles(soup_);
      result_.triangles.assign(faces.begin(), faces.end());
      result_.degenerate = std::erase_if(result_.triangles, IsDegenerate);
      return std::move(result_);
    }
    result_.triangles.reserve(corners.size() / 3);
    unfolds_ = kManyFolded * CountFolded() > soup_.face_sizes.size();
    std::size_t first = 0;
    for (const std::uint32_t size : soup_.face_sizes) {
      AddFace(corners.subspan(first, size));
      first += size;
    }
    return std::move(result_);
  }

 private:
  static bool IsDegenerate(const Triangle& t) {
    return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
  }

  void AddFace(std::span<const std::uint32_t> face) {
    if (face.size() == 4) {
      AddQuad(face);
    } else if (face.size() < 4) {
      AddFan(face);
    } else {
      AddFilling(face);
    }
  }

  void AddQuad(std::span<const std::uint32_t> face) {
    AddFan(unfolds_ && OnlyFirstFolds(face) ? std::array{face[1], face[2], face[3], face[0]}
                                            : std::array{face[0], face[1], face[2], face[3]});
  }

  [[nodiscard]] std::size_t CountFolded() const {
    const std::span<const std::uint32_t> corners = soup_.face_vertices;
    std::size_t folded = 0;
    std::size_t first = 0;
    for (const std::uint32_t size : soup_.face_sizes) {
      if (size == 4 && OnlyFirstFolds(corners.subspan(first, 4))) ++folded;
      first += size;
    }
    return folded;
  }

  // Whether the diagonal from the first corner folds the quad over and the other does not.
  [[nodiscard]] bool OnlyFirstFolds(std::span<const std::uint32_t> quad) const {
    return IsFolded(quad[0], quad[1], quad[2], quad[3]) &&
           !IsFolded(quad[1], quad[2], quad[3], quad[0]);
  }

  // Whether the two triangles beside the diagonal a-c face away from each other.
  [[nodiscard]] bool IsFolded(std::uint32_t a, std::uint32_t b, std::uint32_t c,
                              std::uint32_t d) const {
    const Eigen::Vector3d diagonal = positions_[c] - positions_[a];
    const Eigen::Vector3d right = (positions_[b] - positions_[a]).cross(diagonal);
    return right.dot(diagonal.cross(positions_[d] - positions_[a])) < 0.0;
  }

  void AddFan(std::span<const std::uint32_t> face) {
    if (face.size() < 3) ++result_.degenerate;
    for (std::size_t k = 2; k < face.size(); ++k) Add({face[0], face[k - 1], face[k]});
  }

  void AddFilling(std::span<const std::uint32_t> face) {
    points_.clear();
    for (const std::uint32_t v : face) points_.push_back(positions_[v]);
    const MayJoin any = [](std::uint32_t, std::uint32_t) { return true; };
    const std::size_t steps = face.size() * face.size() * face.size() / 6;
    const bool is_small = steps <= steps_left_;
    if (is_small) steps_left_ -= steps;
    const std::optional<std::vector<Triangle>> filling =
        is_small ? FillBySmallestArea(points_, any) : FillByCuttingEars(points_, any);
    for (const Triangle& t : *filling) Add({face[t[0]], face[t[1]], face[t[2]]});
  }

  void Add(const Triangle& t) {
    if (IsDegenerate(t)) {
      ++result_.degenerate;
    } else {
      result_.triangles.push_back(t);
    }
  }

  const formats::PolygonSoup& soup_;
  std::span<const Eigen::Vector3d> positions_;
  TriangulatedFaces result_;
  std::vector<Eigen::Vector3d> points_;
  std::size_t steps_left_ = kMostCuttingSteps;
  bool unfolds_ = false;  // by the other diagonal
};

}  // namespace

std::span<const Triangle> FacesAsTriangles(const formats::PolygonSoup& soup) {
  static_assert(sizeof(Triangle) == 3 * sizeof(std::uint32_t));
  return {reinterpret_cast<const Triangle*>(soup.face_vertices.data()),
          soup.face_vertices.size() / 3};
}

TriangulatedFaces TriangulateFaces(const formats::PolygonSoup& soup,
                                   std::span<const Eigen::Vector3d> positions) {
  return FaceTriangulator(soup, positions).Run();
}

}  // namespace capfit::mesh
