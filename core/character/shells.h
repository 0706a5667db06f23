// The shells of a soup: faces of one part that hang together.
#ifndef CAPFIT_CORE_CHARACTER_SHELLS_H_
#define CAPFIT_CORE_CHARACTER_SHELLS_H_

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/formats/polygon_soup.h"

namespace capfit::character {

struct Shell {
  std::size_t part = 0;     // index into the soup's parts; 0 where it has none
  bool is_cut_off = false;  // of faces that were marked as such
  std::size_t face_count = 0;
  double area = 0.0;  // in the square of the mesh's unit
  Eigen::Vector3d box_min = Eigen::Vector3d::Constant(1e300);
  Eigen::Vector3d box_max = Eigen::Vector3d::Constant(-1e300);
  // The same for shells of several parts that share vertices, as where one surface was cut by
  // materials; the index of the first such shell.
  std::uint32_t surface = 0;
};

// A triangle as winding numbers and distances see it.
struct Facet {
  Eigen::Vector3d corner[3];

  [[nodiscard]] Eigen::Vector3d Middle() const { return (corner[0] + corner[1] + corner[2]) / 3.0; }
  [[nodiscard]] Eigen::Vector3d AreaVector() const;
  [[nodiscard]] double LongestEdge() const;
  // The mean of (x - from) (x - from)^T over all its points x.
  [[nodiscard]] Eigen::Matrix3d SecondMoment(const Eigen::Vector3d& from) const;
};

struct Shells {
  std::vector<Shell> shells;                 // by their first face
  std::vector<std::uint32_t> shell_of_face;  // faces without three corners belong to some shell too
  // The faces as fans of triangles, shell after shell; those of shell s begin at first_facet[s],
  // and first_facet has one entry more than there are shells.
  std::vector<Facet> facets;
  std::vector<std::size_t> first_facet;
};

// `soup` is checked (formats::CheckSoup). Vertices at the same place, bit by bit, count as one:
// files split them at texture seams. `is_cut_off`: faces that hang together with no others but
// their like, one mark for each face; empty: none. O(corners).
[[nodiscard]] Shells FindShells(const formats::PolygonSoup& soup,
                                std::span<const char> is_cut_off = {});

}  // namespace capfit::character

#endif  // CAPFIT_CORE_CHARACTER_SHELLS_H_
