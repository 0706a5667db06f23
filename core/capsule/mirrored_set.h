// The set while its topology changes: every edit comes with its image.
#ifndef CAPFIT_CORE_CAPSULE_MIRRORED_SET_H_
#define CAPFIT_CORE_CAPSULE_MIRRORED_SET_H_

#include <vector>

#include "core/capsule/primitive_set.h"

namespace capfit::capsule {

// A PrimitiveSet with its images at hand and the edits that keep it sound: distinct capsules, first
// end < second, and where mirrored, pairs that are exact images bit for bit. Indices are those of
// the PrimitiveSet. Of each pair the one with the lower index is the representative: who moves
// spheres moves that one and calls CopyToImages.
class MirroredSet {
 public:
  // Empty. `is_mirrored`: what is added comes with an image.
  MirroredSet() = default;
  explicit MirroredSet(bool is_mirrored) : is_mirrored_(is_mirrored) {}
  // Of a finished set. Mirrored: spheres without an image stay on their own, the others become
  // exact. Not mirrored: nothing is anything's image, whatever the origins say; they are kept.
  MirroredSet(PrimitiveSet set, bool is_mirrored);

  [[nodiscard]] const PrimitiveSet& set() const { return set_; }
  [[nodiscard]] bool is_mirrored() const { return is_mirrored_; }
  [[nodiscard]] PrimitiveCount count() const { return set_.count(); }
  [[nodiscard]] int sphere_count() const { return count().spheres; }
  [[nodiscard]] int capsule_count() const { return count().capsules; }
  [[nodiscard]] int primitive_count() const { return count().total(); }
  [[nodiscard]] const std::vector<geometry::Sphere>& spheres() const { return set_.spheres; }
  [[nodiscard]] const std::vector<CapsuleEnds>& capsules() const { return set_.capsules; }
  [[nodiscard]] const geometry::Sphere& sphere(int v) const { return set_.spheres[v]; }
  [[nodiscard]] geometry::Sphere& sphere(int v) { return set_.spheres[v]; }
  [[nodiscard]] body::Part part(int v) const { return set_.origins[v].part; }
  [[nodiscard]] const CapsuleEnds& ends(int e) const { return set_.capsules[e]; }

  // The image of sphere `v` or capsule `e`; itself on the mid-plane and where there is none.
  [[nodiscard]] int ImageOf(int v) const { return sphere_images_[v]; }
  [[nodiscard]] int ImageOfCapsule(int e) const { return capsule_images_[e]; }
  [[nodiscard]] bool IsRepresentative(int v) const { return ImageOf(v) >= v; }
  [[nodiscard]] bool IsCapsuleRepresentative(int e) const { return ImageOfCapsule(e) >= e; }
  // On the mid-plane and bound to stay there.
  [[nodiscard]] bool IsOnPlane(int v) const { return is_mirrored_ && set_.origins[v].mirror == v; }
  // Of the capsule between two spheres, either way round; -1: there is none.
  [[nodiscard]] int IndexOfCapsule(int a, int b) const;
  [[nodiscard]] bool HasCapsule(int a, int b) const { return IndexOfCapsule(a, b) >= 0; }
  [[nodiscard]] std::vector<int> NeighboursOf(int v) const;  // by capsules, in their order

  // Adds a sphere and, off the plane of a mirrored set, its image right after it; on the plane x is
  // made 0. Returns the sphere's index.
  int AddSphere(const geometry::Sphere& sphere, bool on_plane,
                body::Part part = body::Part::kTorso);
  // Adds the capsule and its image, where they are not there yet; a == b adds nothing.
  void AddCapsule(int a, int b);
  // Removes the capsule and its image.
  void RemoveCapsule(int e);
  // Removes the marked spheres, their images and their capsules. Returns the new index of each old
  // sphere, -1 for the removed.
  std::vector<int> RemoveSpheres(const std::vector<char>& removed);
  // Keeps only what is marked: images together, no capsule without its ends. Returns as above.
  std::vector<int> KeepOnly(const std::vector<char>& spheres, const std::vector<char>& capsules);
  // Puts a sphere in the middle of the capsule, and one in the middle of its image: changes no
  // shape. The new sphere belongs where the second end does. Returns its index.
  int Cut(int e);
  // Makes sphere `v`, which must be on the plane, and a new last one a mirrored pair, `aside_m` to
  // either side, and unties it. Returns the new one's index.
  int PartFromPlane(int v, double aside_m);
  // The opposite: puts sphere `v`, one of a pair, on the plane, removes its image and ties to `v`
  // what hung on that. Returns as RemoveSpheres.
  std::vector<int> JoinOnPlane(int v);

  // New places and radii of all spheres, by the same indices; images must be exact.
  void MoveTo(const std::vector<geometry::Sphere>& spheres) { set_.spheres = spheres; }
  // Copies the representatives onto their images.
  void CopyToImages();

 private:
  [[nodiscard]] bool HasImage(int v) const { return ImageOf(v) != v || IsOnPlane(v); }
  [[nodiscard]] bool IsOwnImage(const CapsuleEnds& ends) const;
  int AddAlone(const geometry::Sphere& sphere, body::Part part);
  void FindImages();

  PrimitiveSet set_;
  bool is_mirrored_ = false;
  std::vector<int> sphere_images_;  // as ImageOf
  std::vector<int> capsule_images_;
};

}  // namespace capfit::capsule

#endif  // CAPFIT_CORE_CAPSULE_MIRRORED_SET_H_
