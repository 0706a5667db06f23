#include "core/export/gltf_document.h"

#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <utility>

#include "absl/strings/escaping.h"
#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/base/version.h"
#include "core/formats/file_error.h"
#include "core/formats/gltf_chunks.h"
#include "core/formats/gltf_file.h"
#include "core/formats/gltf_json.h"
#include "core/formats/text_scanner.h"

namespace capfit::exports {
namespace {

using formats::FileError;
using nlohmann::json;

// Writing JSON takes a frame of the stack for each level; real files have some ten.
constexpr int kDeepest = 200;

// How far a scale may differ from the other two before it is not the same: some float roundings.
constexpr double kAlikeScales = 1e-6;

// What lies flatter than this beside its longest side has no way back.
constexpr double kFlat = 1e-6;

bool IsTooDeep(std::string_view text) {
  int depth = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"') {
      for (++i; i < text.size() && text[i] != '"';) i += text[i] == '\\' ? 2 : 1;
    } else if (text[i] == '{' || text[i] == '[') {
      if (++depth > kDeepest) return true;
    } else if (text[i] == '}' || text[i] == ']') {
      --depth;
    }
  }
  return false;
}

json NumbersOf(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

json NodeOf(const Eigen::Vector3d& translation, const Eigen::Matrix3d& turn,
            const Eigen::Vector3d& scale) {
  json node = json::object();
  if (!translation.isZero(0.0)) node["translation"] = NumbersOf(translation);
  const Eigen::Quaterniond q = Eigen::Quaterniond(turn).normalized();
  if (!turn.isIdentity(0.0)) node["rotation"] = {q.x(), q.y(), q.z(), q.w()};
  if (scale != Eigen::Vector3d::Ones()) node["scale"] = NumbersOf(scale);
  return node;
}

// Turns a third axis about, so that the matrix mirrors nothing; the scale along it makes up for it.
void MakeProper(Eigen::Matrix3d& turn, Eigen::Vector3d& scale) {
  if (turn.determinant() > 0.0) return;
  turn.col(2) = -turn.col(2).eval();
  scale.z() = -scale.z();
}

// Nodes, outermost first, that together are the affine map with this linear part and translation.
std::vector<json> NodesOf(const Eigen::Matrix3d& linear, const Eigen::Vector3d& translation) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(linear, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d scale = svd.singularValues();
  if (scale.x() - scale.z() <= kAlikeScales * scale.x()) {
    const double mirror = linear.determinant() < 0.0 ? -1.0 : 1.0;
    double length = mirror * std::cbrt(std::abs(linear.determinant()));
    if (std::abs(length - 1.0) <= kAlikeScales) length = 1.0;
    const Eigen::Matrix3d turn = mirror * svd.matrixU() * svd.matrixV().transpose();
    return {NodeOf(translation, turn, Eigen::Vector3d::Constant(length))};
  }
  Eigen::Matrix3d outer = svd.matrixU();
  Eigen::Matrix3d inner = svd.matrixV();
  MakeProper(outer, scale);
  MakeProper(inner, scale);
  return {NodeOf(translation, outer, scale),
          NodeOf(Eigen::Vector3d::Zero(), inner.transpose(), Eigen::Vector3d::Ones())};
}

absl::Status NotA(const char* what, const std::string& member) {
  return FileError(ErrorReason::kMalformedFile, {}, absl::StrCat(member, " is no ", what));
}

}  // namespace

GltfDocument::GltfDocument() {
  json_ = {{"asset", {{"version", "2.0"}, {"generator", "capfit " + std::string(Version())}}},
           {"scene", 0},
           {"scenes", json::array({json::object()})}};
}

absl::StatusOr<GltfDocument> GltfDocument::Open(std::span<const std::byte> bytes) {
  GltfDocument document;
  CAPFIT_ASSIGN_OR_RETURN(const formats::GltfFile file, formats::GltfFile::Open(bytes));
  CAPFIT_ASSIGN_OR_RETURN(document.nodes_, formats::ReadGltfNodes(file.description()));
  CAPFIT_ASSIGN_OR_RETURN(const formats::GltfChunks chunks, formats::SplitGltf(bytes));
  if (IsTooDeep(chunks.description)) {
    return formats::FileTooLarge({}, kDeepest + 1, "levels of JSON", kDeepest);
  }
  document.json_ =
      json::parse(chunks.description.begin(), chunks.description.end(), nullptr, false);
  document.binary_ = formats::AsText(chunks.binary);
  for (const auto other : chunks.others) document.others_.emplace_back(formats::AsText(other));
  CAPFIT_RETURN_IF_ERROR(document.CheckLists());
  document.TakeBuffer();
  return document;
}

// An index beyond the nodes refers to nothing, until there are more of them.
absl::Status GltfDocument::CheckNodes(const json& indices, const char* owner) const {
  const std::size_t count = nodes_.parent.size();
  for (const json& index : indices) {
    if (index.is_number_unsigned() && index.get<std::uint64_t>() < count) continue;
    const std::string place = absl::StrCat("an entry of ", owner);
    if (!index.is_number_integer()) return NotA("index", absl::StrCat("a node in ", place));
    return formats::FileOutOfRange(formats::AtElement(place), "a node", index.dump(),
                                   formats::IndexRange(count));
  }
  return absl::OkStatus();
}

absl::Status GltfDocument::CheckLists() const {
  if (!json_.is_object()) return NotA("JSON object", "the description");
  for (const char* key : {"nodes", "scenes", "meshes", "materials", "accessors", "bufferViews",
                          "buffers", "extensionsUsed"}) {
    if (json_.contains(key) && !json_[key].is_array()) return NotA("list", key);
  }
  if (json_.contains("extensions") && !json_["extensions"].is_object()) {
    return NotA("object", "extensions");
  }
  for (const auto& [list, member] : {std::pair("nodes", "children"), {"scenes", "nodes"}}) {
    for (const json& entry : formats::ArrayAt(json_, list)) {
      if (!entry.is_object()) return NotA("object", absl::StrCat("an entry of ", list));
      if (entry.contains(member) && !entry[member].is_array()) return NotA("list", member);
      CAPFIT_RETURN_IF_ERROR(CheckNodes(formats::ArrayAt(entry, member), list));
    }
  }
  for (const json& buffer : formats::ArrayAt(json_, "buffers")) {
    if (!buffer.is_object()) return NotA("object", "an entry of buffers");
  }
  return absl::OkStatus();
}

// A first buffer that stands in the text goes where GLB files keep it.
void GltfDocument::TakeBuffer() {
  if (!binary_.empty() || formats::ArrayAt(json_, "buffers").empty()) return;
  json& buffer = json_["buffers"][0];
  const json& uri = formats::ValueAt(buffer, "uri");
  if (!uri.is_string()) return;
  const auto base64 = formats::Base64Of(uri.get_ref<const std::string&>());
  if (!base64.has_value()) return;
  std::string unpacked;
  if (!absl::Base64Unescape({base64->data(), base64->size()}, &unpacked)) return;
  binary_ = std::move(unpacked);
  buffer.erase("uri");
  buffer["byteLength"] = binary_.size();
}

std::size_t GltfDocument::Add(const char* key, json value) {
  json& list = json_[key];
  list.push_back(std::move(value));
  return list.size() - 1;
}

std::size_t GltfDocument::AddNode(json node, std::optional<std::size_t> parent) {
  json& scenes = json_["scenes"];
  if (scenes.empty()) {
    json roots = json::array();
    for (const std::size_t n : nodes_.order) {
      if (nodes_.parent[n] == formats::GltfNodes::kNone) roots.push_back(n);
    }
    scenes.push_back(roots.empty() ? json::object() : json{{"nodes", roots}});
    json_["scene"] = 0;
  }
  const std::size_t index = Add("nodes", std::move(node));
  if (parent.has_value()) {
    json_["nodes"][*parent]["children"].push_back(index);
  } else {
    scenes[formats::IndexAt(json_, "scene", scenes.size()).value_or(0)]["nodes"].push_back(index);
  }
  return index;
}

Eigen::Affine3d GltfDocument::ToWorld(std::size_t node) const {
  const auto placed = placed_.find(node);
  if (placed != placed_.end()) return placed->second;
  Eigen::Affine3d to_world = Eigen::Affine3d::Identity();
  if (node < nodes_.to_world.size()) to_world.matrix() = nodes_.to_world[node];
  return to_world;
}

bool GltfDocument::HasInverse(std::size_t node) const {
  const Eigen::Affine3d to_world = ToWorld(node);
  if (!to_world.matrix().allFinite()) return false;
  const Eigen::Vector3d sizes =
      Eigen::JacobiSVD<Eigen::Matrix3d>(to_world.linear(), 0).singularValues();
  return sizes.z() > kFlat * sizes.x();
}

std::size_t GltfDocument::AddPlacedNode(const std::string& name, const Eigen::Isometry3d& world,
                                        std::size_t parent) {
  const Eigen::Affine3d local = ToWorld(parent).inverse() * world;
  std::vector<json> nodes = NodesOf(local.linear(), local.translation());
  nodes.back()["name"] = name;
  for (json& node : nodes) parent = AddNode(std::move(node), parent);
  placed_.emplace(parent, world);
  return parent;
}

json& GltfDocument::Extension(json& owner, const char* name) {
  json& used = json_["extensionsUsed"];
  if (std::find(used.begin(), used.end(), json(name)) == used.end()) used.push_back(name);
  json& extension = owner["extensions"][name];
  if (!extension.is_object()) extension = json::object();
  return extension;
}

// The buffer that grows: the binary chunk, which is the first one without an address. Where the
// first has one of its own (or stands in for packed data), a last one in the text.
std::size_t GltfDocument::OwnBuffer() {
  json& buffers = json_["buffers"];
  if (buffers.empty()) buffers.push_back({{"byteLength", 0}});
  const bool is_binary = !buffers[0].contains("uri") && !buffers[0].contains("extensions");
  if (is_binary) return 0;
  return buffers.size();
}

std::size_t GltfDocument::AddView(std::string_view bytes, int target) {
  json& buffers = json_["buffers"];
  const std::size_t own = OwnBuffer();
  std::size_t offset = 0;
  if (own == 0) {
    binary_.resize((binary_.size() + 3) / 4 * 4, '\0');
    offset = binary_.size();
    binary_.append(bytes);
    buffers[0]["byteLength"] = binary_.size();
  } else {
    buffers.push_back({{"byteLength", bytes.size()},
                       {"uri", "data:application/octet-stream;base64," +
                                   absl::Base64Escape({bytes.data(), bytes.size()})}});
  }
  json view = {{"buffer", own}, {"byteLength", bytes.size()}, {"target", target}};
  if (offset > 0) view["byteOffset"] = offset;
  return Add("bufferViews", std::move(view));
}

absl::StatusOr<std::string> GltfDocument::Bytes() const {
  const std::string text = json_.dump(-1, ' ', false, json::error_handler_t::replace);
  formats::GltfChunks chunks;
  chunks.description = text;
  chunks.binary = std::as_bytes(std::span(binary_));
  for (const std::string& other : others_) {
    chunks.others.push_back(std::as_bytes(std::span(other)));
  }
  return formats::JoinGltf(chunks);
}

}  // namespace capfit::exports
