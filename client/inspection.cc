#include "client/inspection.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_join.h"
#include "client/option_words.h"
#include "client/text_width.h"
#include "core/base/plain_text.h"
#include "core/body/skeleton_names.h"
#include "core/formats/soup_checks.h"
#include "core/pipeline/effective_options.h"
#include "core/pipeline/take_body.h"

namespace capfit::client {
namespace {

using body::LandmarkId;

// How a limb points, in the body's frame.
void AddPose(const body::Body& body, const char* limb, LandmarkId from, LandmarkId to,
             Inspection& inspection) {
  if (!body.landmark(from) || !body.landmark(to)) return;
  const Eigen::Vector3d along =
      (body.landmark(to)->position_m - body.landmark(from)->position_m).normalized();
  const double down = std::clamp(-along.y(), -1.0, 1.0);
  inspection.pose.push_back({limb, std::acos(down) * 180.0 / std::numbers::pi});
}

void AddBody(const pipeline::TakenBody& taken, const pipeline::FitOptions& options,
             Inspection& inspection) {
  const pipeline::FitOptions held =
      pipeline::EffectiveOptions(options, taken.body.body_from_caller);
  inspection.unit = held.unit;
  inspection.up = held.up;
  inspection.height_m = taken.body.height_m;
  inspection.is_solid = taken.body.shells.has_value();
  AddPose(taken.body, "left_arm", LandmarkId::kLeftShoulder, LandmarkId::kLeftWrist, inspection);
  AddPose(taken.body, "right_arm", LandmarkId::kRightShoulder, LandmarkId::kRightWrist, inspection);
  AddPose(taken.body, "left_leg", LandmarkId::kLeftHip, LandmarkId::kLeftAnkle, inspection);
  AddPose(taken.body, "right_leg", LandmarkId::kRightHip, LandmarkId::kRightAnkle, inspection);
}

// The parts as a first look tells them, where no body was found.
std::vector<character::CharacterPart> PartsAtFirstSight(const formats::PolygonSoup& soup,
                                                        const pipeline::FitOptions& options,
                                                        const ThreadPool& pool) {
  if (!formats::CheckSoup(soup, {}).ok()) return {};
  const auto found =
      character::FindCharacter(soup, options.character, body::ReadRig(soup.joints).landmarks, pool);
  return found.ok() ? found->parts : std::vector<character::CharacterPart>();
}

std::string Percent(double share) { return absl::StrFormat("%.1f %%", 100.0 * share); }

// Columns as wide as their longest cell; numbers to the right.
std::string Aligned(const std::vector<std::vector<std::string>>& rows,
                    const std::vector<bool>& is_number) {
  std::vector<std::size_t> width(is_number.size(), 0);
  for (const auto& row : rows) {
    for (std::size_t c = 0; c < row.size(); ++c) width[c] = std::max(width[c], TextWidth(row[c]));
  }
  std::string table;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t c = 0; c < row.size(); ++c) {
      const std::string space(width[c] - TextWidth(row[c]), ' ');
      absl::StrAppend(&line, c > 0 ? "  " : "", is_number[c] ? space : "", row[c],
                      is_number[c] ? "" : space);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    absl::StrAppend(&table, line, "\n");
  }
  return table;
}

std::string PartsRows(const std::vector<character::CharacterPart>& parts) {
  std::vector<std::vector<std::string>> rows = {
      {"part", "material", "taken for", "fitted", "shells", "faces", "area", "why"}};
  for (const character::CharacterPart& part : parts) {
    rows.push_back({part.name.empty() ? "-" : PlainText(part.name),
                    part.material.empty() ? "-" : PlainText(part.material),
                    std::string(character::PartKindName(part.kind)),
                    part.is_included ? "yes" : "no", absl::StrCat(part.shell_count),
                    absl::StrCat(part.face_count), Percent(part.area_share), part.reason});
  }
  return Aligned(rows, {false, false, false, false, true, true, true, false});
}

std::string PoseLine(const std::vector<LimbPose>& pose) {
  std::vector<std::string> limbs;
  for (const LimbPose& limb : pose) {
    std::string name = limb.limb;
    std::replace(name.begin(), name.end(), '_', ' ');
    limbs.push_back(absl::StrFormat("%s %.0f", name, limb.from_down_deg));
  }
  return absl::StrCat("pose: ", absl::StrJoin(limbs, ", "), " degrees from straight down\n");
}

}  // namespace

Inspection Inspect(const formats::PolygonSoup& soup, const pipeline::FitOptions& options,
                   const ThreadPool& pool) {
  Inspection inspection;
  inspection.vertices = soup.positions.size();
  inspection.faces = soup.face_count();
  inspection.joints = soup.joints.size();
  for (const auto& [id, position] : body::ReadRig(soup.joints).landmarks) {
    inspection.known_joints.emplace_back(body::LandmarkName(id));
  }
  NullObserver observer;
  const absl::StatusOr<pipeline::TakenBody> taken =
      pipeline::TakeBody(soup, options, pool, observer, inspection.warnings);
  if (!taken.ok()) {
    inspection.status = taken.status();
    inspection.parts = PartsAtFirstSight(soup, options, pool);
    return inspection;
  }
  AddBody(*taken, options, inspection);
  inspection.parts = taken->parts;
  if (inspection.parts.empty()) {
    const bool is_named = soup.parts.size() == 1;
    inspection.parts.push_back({is_named ? soup.parts[0].name : "",
                                is_named ? soup.parts[0].material : "", character::PartKind::kBody,
                                true, "one surface", 1, soup.face_count(), 1.0});
  }
  return inspection;
}

std::string InspectionTable(const Inspection& inspection) {
  std::string text =
      absl::StrCat("mesh: ", inspection.faces, " faces, ", inspection.vertices, " vertices\n");
  absl::StrAppend(&text, "skeleton: ");
  if (inspection.joints == 0) {
    absl::StrAppend(&text, "none\n");
  } else {
    absl::StrAppend(&text, inspection.joints, " joints, ", inspection.known_joints.size(),
                    " of them known: ", absl::StrJoin(inspection.known_joints, ", "), "\n");
  }
  if (inspection.unit) {
    const bool has_axis = *inspection.up != body::UpAxis::kAuto;
    absl::StrAppend(&text, "body: ", absl::StrFormat("%.3f", inspection.height_m), " m tall, in ",
                    WordOf(UnitWords(), *inspection.unit), ", ",
                    has_axis ? WordOf(UpWords(), *inspection.up) : "no axis", " up\n");
    absl::StrAppend(&text, PoseLine(inspection.pose));
    absl::StrAppend(
        &text, "fitted: ",
        inspection.is_solid ? "a solid around all parts below that say yes" : "one surface", "\n");
  }
  absl::StrAppend(&text, "\n", PartsRows(inspection.parts));
  for (const Warning& warning : inspection.warnings) {
    absl::StrAppend(&text, "\n", warning.code, ": ", warning.message);
  }
  return absl::StrCat(text, inspection.warnings.empty() ? "" : "\n");
}

std::string InspectionJson(const Inspection& inspection) {
  using nlohmann::ordered_json;
  ordered_json root = {{"vertex_count", inspection.vertices},
                       {"face_count", inspection.faces},
                       {"joint_count", inspection.joints},
                       {"known_joints", inspection.known_joints}};
  if (inspection.unit) {
    root["unit"] = WordOf(UnitWords(), *inspection.unit);
    const bool has_axis = *inspection.up != body::UpAxis::kAuto;
    root["up_axis"] =
        has_axis ? ordered_json(WordOf(UpWords(), *inspection.up)) : ordered_json(nullptr);
    root["height_m"] = inspection.height_m;
    root["is_solid"] = inspection.is_solid;
    for (const LimbPose& limb : inspection.pose) {
      root["from_down_deg"][limb.limb] = limb.from_down_deg;
    }
  }
  root["parts"] = ordered_json::array();
  for (const character::CharacterPart& part : inspection.parts) {
    root["parts"].push_back({{"name", part.name},
                             {"material", part.material},
                             {"kind", std::string(character::PartKindName(part.kind))},
                             {"is_included", part.is_included},
                             {"reason", part.reason},
                             {"shell_count", part.shell_count},
                             {"face_count", part.face_count},
                             {"area_share", part.area_share}});
  }
  root["warnings"] = ordered_json::array();
  for (const Warning& warning : inspection.warnings) {
    root["warnings"].push_back(
        {{"code", warning.code}, {"message", warning.message}, {"count", warning.count}});
  }
  if (!inspection.status.ok()) root["error"] = std::string(inspection.status.message());
  return root.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace capfit::client
