// Which parts and shells of a file are the character, and which are only beside it.
#ifndef CAPFIT_CORE_CHARACTER_FIND_CHARACTER_H_
#define CAPFIT_CORE_CHARACTER_FIND_CHARACTER_H_

#include <Eigen/Core>
#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "core/base/thread_pool.h"
#include "core/base/warning.h"
#include "core/body/anatomy.h"
#include "core/character/part_words.h"
#include "core/formats/polygon_soup.h"

namespace capfit::character {

struct CharacterOptions {
  // Names of parts or materials, in any case, with * and ? as in file names. They decide before
  // everything else; excluding wins. One that no part has is refused: INVALID_ARGUMENT with the
  // field "options.include_parts[i]".
  std::vector<std::string> include;
  std::vector<std::string> exclude;
  bool hair = false;   // hair is enclosed too
  bool skirt = false;  // skirts and what else hangs between the legs
};

// Shells of one part that had the same fate.
struct CharacterPart {
  std::string name;  // the part's; empty where the file has none
  std::string material;
  PartKind kind = PartKind::kBody;
  bool is_included = false;
  std::string reason;  // why, in a few words
  std::size_t shell_count = 0;
  std::size_t face_count = 0;
  double area_share = 0.0;  // of all shells
};

struct Character {
  std::vector<CharacterPart> parts;  // in the file's order
  std::vector<char> is_left_out;     // for each face whether it is not the character's
  // Surfaces among what is included: one, and the mesh can be taken as it is.
  std::size_t surface_count = 0;
  // Whether the joints told something: then a second look with better ones is of no use.
  bool has_joints = false;
  std::vector<Warning> warnings;  // PARTS_LEFT_OUT with their names
};

// Judged by geometry first, names second. With `joints` (those of a rig, or of a body found in a
// first look; positions in the mesh's frame): what goes around limbs, trunk or head is the
// character, and so is what is worn close to it; what goes around the space between the legs too is
// a skirt; what moves with the head alone and does not go around it is hair, or inner if small;
// other things are accessories. Without joints names and sizes decide, and what is left is taken.
// What lies apart is a fragment; two human-sized groups are refused (FAILED_PRECONDITION,
// TWO_BODIES, naming both). `soup` is checked (formats::CheckSoup). `is_floor`: faces known to be a
// floor or a stand, one mark for each face; empty: none. O(n).
[[nodiscard]] absl::StatusOr<Character> FindCharacter(
    const formats::PolygonSoup& soup, const CharacterOptions& options,
    const std::map<body::LandmarkId, Eigen::Vector3d>& joints, const ThreadPool& pool,
    std::span<const char> is_floor = {});

}  // namespace capfit::character

#endif  // CAPFIT_CORE_CHARACTER_FIND_CHARACTER_H_
