#include "core/character/shells.h"

#include <Eigen/Geometry>  // cross
#include <algorithm>
#include <limits>
#include <numeric>
#include <span>

#include "core/base/disjoint_sets.h"
#include "core/mesh/weld_vertices.h"

namespace capfit::character {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t kNoPart = std::numeric_limits<std::size_t>::max();

class ShellFinder {
 public:
  ShellFinder(const formats::PolygonSoup& soup, std::span<const char> is_cut_off)
      : soup_(soup),
        is_cut_off_(is_cut_off),
        whole_(soup.positions.size()),
        within_part_(soup.face_vertices.size()) {
    std::vector<std::uint32_t> all(soup.positions.size());
    std::iota(all.begin(), all.end(), 0u);
    same_ = mesh::WeldEqual(soup.positions, all);
  }

  Shells Run() {
    JoinCorners();
    result_.shell_of_face.resize(soup_.face_count());
    std::vector<std::uint32_t> shell_at(soup_.face_vertices.size(), kNone);
    std::vector<std::uint32_t> surface_at(soup_.positions.size(), kNone);
    std::vector<std::size_t> facet_counts;
    ForFaces([&](std::size_t face, std::size_t part, std::span<const std::uint32_t> corners) {
      std::uint32_t& shell = shell_at[within_part_.Find(entry_[face])];
      if (shell == kNone) {
        shell = static_cast<std::uint32_t>(result_.shells.size());
        result_.shells.emplace_back().part = part;
        result_.shells.back().is_cut_off = IsCutOff(face);
        facet_counts.push_back(0);
        std::uint32_t& surface = surface_at[whole_.Find(same_[corners[0]])];
        if (surface == kNone) surface = shell;
        result_.shells[shell].surface = surface;
      }
      result_.shell_of_face[face] = shell;
      result_.shells[shell].face_count += 1;
      facet_counts[shell] += corners.size() < 3 ? 0 : corners.size() - 2;
    });
    AddFacets(facet_counts);
    return std::move(result_);
  }

 private:
  [[nodiscard]] bool IsCutOff(std::size_t face) const {
    return !is_cut_off_.empty() && is_cut_off_[face] != 0;
  }

  // face, its part, its corners; those that are cut off after all others.
  template <typename Visit>
  void ForFaces(const Visit& visit) const {
    ForFaces(false, visit);
    if (!is_cut_off_.empty()) ForFaces(true, visit);
  }

  template <typename Visit>
  void ForFaces(bool cut_off, const Visit& visit) const {
    std::size_t at = 0;
    std::size_t part = 0;
    for (std::size_t face = 0; face < soup_.face_count(); ++face) {
      while (part + 1 < soup_.parts.size() && face >= soup_.parts[part + 1].first_face) ++part;
      const std::size_t size = soup_.face_sizes.empty() ? 3 : soup_.face_sizes[face];
      if (IsCutOff(face) == cut_off) {
        visit(face, part, std::span(soup_.face_vertices).subspan(at, size));
      }
      at += size;
    }
  }

  // Within a part each place has an entry of its own, so that parts that share vertices stay apart.
  void JoinCorners() {
    std::vector<std::size_t> part_at(soup_.positions.size(), kNoPart);
    std::vector<std::uint32_t> first_at(soup_.positions.size(), kNone);
    entry_.assign(soup_.face_count(), 0);
    std::uint32_t next = 0;
    ForFaces([&](std::size_t face, std::size_t part, std::span<const std::uint32_t> corners) {
      std::uint32_t first = kNone;
      for (const std::uint32_t corner : corners) {
        const std::uint32_t place = same_[corner];
        const std::size_t piece = 2 * part + (IsCutOff(face) ? 1 : 0);
        if (part_at[place] != piece) {
          part_at[place] = piece;
          first_at[place] = next++;
        }
        if (first == kNone) first = first_at[place];
        within_part_.Join(first, first_at[place]);
        if (!IsCutOff(face)) whole_.Join(same_[corners[0]], place);
      }
      entry_[face] = first;
    });
  }

  void AddFacets(const std::vector<std::size_t>& counts) {
    result_.first_facet.assign(counts.size() + 1, 0);
    std::partial_sum(counts.begin(), counts.end(), result_.first_facet.begin() + 1);
    result_.facets.resize(result_.first_facet.back());
    std::vector<std::size_t> next(result_.first_facet.begin(), result_.first_facet.end() - 1);
    ForFaces([&](std::size_t face, std::size_t, std::span<const std::uint32_t> corners) {
      const std::uint32_t shell = result_.shell_of_face[face];
      Shell& entry = result_.shells[shell];
      for (const std::uint32_t corner : corners) {
        entry.box_min = entry.box_min.cwiseMin(soup_.positions[corner]);
        entry.box_max = entry.box_max.cwiseMax(soup_.positions[corner]);
      }
      for (std::size_t k = 2; k < corners.size(); ++k) {
        Facet& facet = result_.facets[next[shell]++];
        facet.corner[0] = soup_.positions[corners[0]];
        facet.corner[1] = soup_.positions[corners[k - 1]];
        facet.corner[2] = soup_.positions[corners[k]];
        entry.area += facet.AreaVector().norm();
      }
    });
  }

  const formats::PolygonSoup& soup_;
  std::span<const char> is_cut_off_;
  std::vector<std::uint32_t> same_;
  DisjointSets whole_;
  DisjointSets within_part_;
  std::vector<std::uint32_t> entry_;  // of each face: a member of its set within the part
  Shells result_;
};

}  // namespace

Eigen::Vector3d Facet::AreaVector() const {
  return 0.5 * (corner[1] - corner[0]).cross(corner[2] - corner[0]);
}

double Facet::LongestEdge() const {
  return std::max({(corner[1] - corner[0]).norm(), (corner[2] - corner[1]).norm(),
                   (corner[0] - corner[2]).norm()});
}

Eigen::Matrix3d Facet::SecondMoment(const Eigen::Vector3d& from) const {
  const Eigen::Vector3d middle = Middle() - from;
  Eigen::Matrix3d sum = 9.0 * middle * middle.transpose();
  for (const Eigen::Vector3d& c : corner) sum += (c - from) * (c - from).transpose();
  return sum / 12.0;
}

Shells FindShells(const formats::PolygonSoup& soup, std::span<const char> is_cut_off) {
  return ShellFinder(soup, is_cut_off).Run();
}

}  // namespace capfit::character
