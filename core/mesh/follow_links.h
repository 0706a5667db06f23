// Disjoint sets: each element has a link to another of its set, the last to itself.
#ifndef CAPFIT_CORE_MESH_FOLLOW_LINKS_H_
#define CAPFIT_CORE_MESH_FOLLOW_LINKS_H_

#include <cstdint>
#include <vector>

namespace capfit::mesh {

// Follows the links to where they end, and shortens them on the way.
inline std::uint32_t FollowLinks(std::vector<std::uint32_t>& link, std::uint32_t v) {
  while (link[v] != v) v = link[v] = link[link[v]];
  return v;
}

}  // namespace capfit::mesh

#endif  // CAPFIT_CORE_MESH_FOLLOW_LINKS_H_
