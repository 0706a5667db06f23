#include "core/capsule/mirrored_set.h"

#include <algorithm>
#include <utility>

namespace capfit::capsule {

MirroredSet::MirroredSet(PrimitiveSet set, bool is_mirrored)
    : set_(std::move(set)), is_mirrored_(is_mirrored) {
  for (CapsuleEnds& ends : set_.capsules) std::sort(ends.begin(), ends.end());
  FindImages();
  CopyToImages();
}

void MirroredSet::FindImages() {
  Images found;
  if (is_mirrored_) found = ImagesOf(set_);
  const auto or_itself = [](const std::vector<int>& images, std::size_t count) {
    std::vector<int> result(count);
    for (std::size_t i = 0; i < count; ++i) {
      result[i] = i < images.size() && images[i] >= 0 ? images[i] : static_cast<int>(i);
    }
    return result;
  };
  sphere_images_ = or_itself(found.spheres, set_.spheres.size());
  capsule_images_ = or_itself(found.capsules, set_.capsules.size());
}

int MirroredSet::IndexOfCapsule(int a, int b) const {
  const CapsuleEnds ends{std::min(a, b), std::max(a, b)};
  const auto found = std::find(set_.capsules.begin(), set_.capsules.end(), ends);
  return found == set_.capsules.end() ? -1 : static_cast<int>(found - set_.capsules.begin());
}

std::vector<int> MirroredSet::NeighboursOf(int v) const {
  std::vector<int> neighbours;
  for (const auto& [a, b] : set_.capsules) {
    if (a == v) neighbours.push_back(b);
    if (b == v) neighbours.push_back(a);
  }
  return neighbours;
}

bool MirroredSet::IsOwnImage(const CapsuleEnds& ends) const {
  const auto [a, b] = ends;
  return HasImage(a) && HasImage(b) && std::min(ImageOf(a), ImageOf(b)) == std::min(a, b) &&
         std::max(ImageOf(a), ImageOf(b)) == std::max(a, b);
}

int MirroredSet::AddAlone(const geometry::Sphere& sphere, body::Part part) {
  set_.spheres.push_back(sphere);
  set_.origins.push_back({part, -1, -1});
  FindImages();
  return sphere_count() - 1;
}

int MirroredSet::AddSphere(const geometry::Sphere& sphere, bool on_plane, body::Part part) {
  const int index = AddAlone(sphere, part);
  if (is_mirrored_ && on_plane) {
    set_.spheres.back().center_m.x() = 0.0;
    set_.origins.back().mirror = index;
  } else if (is_mirrored_) {
    set_.origins.back().mirror = index + 1;
    set_.spheres.push_back(MirrorImage(sphere));
    set_.origins.push_back({body::MirrorPart(part), -1, index});
  }
  FindImages();
  return index;
}

void MirroredSet::AddCapsule(int a, int b) {
  const auto add = [this](int i, int j) {
    if (i != j && !HasCapsule(i, j)) set_.capsules.push_back({std::min(i, j), std::max(i, j)});
  };
  add(a, b);
  if (HasImage(a) && HasImage(b)) add(ImageOf(a), ImageOf(b));
  FindImages();
}

void MirroredSet::RemoveCapsule(int e) {
  const int image = ImageOfCapsule(e);
  const auto [low, high] = std::minmax(e, image);
  set_.capsules.erase(set_.capsules.begin() + high);
  if (low != high) set_.capsules.erase(set_.capsules.begin() + low);
  FindImages();
}

std::vector<int> MirroredSet::RemoveSpheres(const std::vector<char>& removed) {
  std::vector<char> kept(set_.spheres.size(), 1);
  for (int v = 0; v < sphere_count(); ++v) {
    if (removed[v]) kept[v] = kept[ImageOf(v)] = 0;
  }
  std::vector<char> kept_capsules;
  for (const auto& [a, b] : set_.capsules) kept_capsules.push_back(kept[a] && kept[b]);
  return KeepOnly(kept, kept_capsules);
}

std::vector<int> MirroredSet::KeepOnly(const std::vector<char>& spheres,
                                       const std::vector<char>& capsules) {
  const PrimitiveSet old = std::exchange(set_, {});
  std::vector<int> index(old.spheres.size(), -1);
  for (std::size_t v = 0; v < index.size(); ++v) {
    if (!spheres[v]) continue;
    index[v] = sphere_count();
    set_.spheres.push_back(old.spheres[v]);
    set_.origins.push_back(old.origins[v]);
  }
  for (SphereOrigin& origin : set_.origins) {
    if (origin.mirror >= 0) origin.mirror = index[origin.mirror];
  }
  for (std::size_t e = 0; e < capsules.size(); ++e) {
    if (!capsules[e]) continue;
    set_.capsules.push_back({index[old.capsules[e][0]], index[old.capsules[e][1]]});
  }
  FindImages();
  return index;
}

int MirroredSet::Cut(int e) {
  const CapsuleEnds whole = ends(e);
  const auto [a, b] = whole;
  const bool is_pair = ImageOfCapsule(e) != e;
  const geometry::Sphere middle{0.5 * (sphere(a).center_m + sphere(b).center_m),
                                0.5 * (sphere(a).radius_m + sphere(b).radius_m)};
  const body::Part part = set_.origins[b].part;
  RemoveCapsule(e);
  const int added = is_pair || IsOwnImage(whole) ? AddSphere(middle, IsOwnImage(whole), part)
                                                 : AddAlone(middle, part);
  AddCapsule(a, added);
  AddCapsule(added, b);
  return added;
}

int MirroredSet::PartFromPlane(int v, double aside_m) {
  const int image = sphere_count();
  std::erase_if(set_.capsules, [v](const CapsuleEnds& e) { return e[0] == v || e[1] == v; });
  set_.spheres.push_back(sphere(v));
  set_.origins.push_back(set_.origins[v]);
  sphere(v).center_m.x() += aside_m;
  sphere(image).center_m.x() -= aside_m;
  set_.origins[v].mirror = image;
  set_.origins[image].mirror = v;
  FindImages();
  return image;
}

std::vector<int> MirroredSet::JoinOnPlane(int v) {
  const int image = ImageOf(v);
  for (const int n : NeighboursOf(image)) {
    if (n != v && !HasCapsule(n, v)) set_.capsules.push_back({std::min(n, v), std::max(n, v)});
  }
  sphere(v).center_m.x() = 0.0;
  set_.origins[v].mirror = v;
  std::vector<char> kept(set_.spheres.size(), 1);
  kept[image] = 0;
  std::vector<char> kept_capsules;
  for (const auto& [a, b] : set_.capsules) kept_capsules.push_back(a != image && b != image);
  return KeepOnly(kept, kept_capsules);
}

void MirroredSet::CopyToImages() {
  if (!is_mirrored_) return;
  for (int v = 0; v < sphere_count(); ++v) {
    if (IsOnPlane(v)) sphere(v).center_m.x() = 0.0;
    if (ImageOf(v) > v) sphere(ImageOf(v)) = MirrorImage(sphere(v));
  }
}

}  // namespace capfit::capsule
