#include "core/formats/gltf_json.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"

namespace capfit::formats {
namespace {

using nlohmann::json;

constexpr std::array<std::string_view, 12> kWanted = {
    "asset",     "scene",       "scenes", "nodes",     "meshes",     "buffers",
    "accessors", "bufferViews", "skins",  "materials", "extensions", "extensionsRequired"};

constexpr std::size_t kLongestName = 256;

bool IsOneOf(std::string_view name, std::string_view a, std::string_view b) {
  return name == a || name == b;
}

// Takes the parser's events and builds what is wanted.
class WantedValues final : public json::json_sax_t {
 public:
  explicit WantedValues(GltfContent content) : content_(content) {}
  json Take() { return std::move(root_); }

  bool null() override { return Add(nullptr); }
  bool boolean(bool value) override { return Add(value); }
  bool number_integer(number_integer_t value) override { return Add(value); }
  bool number_unsigned(number_unsigned_t value) override { return Add(value); }
  bool number_float(number_float_t value, const string_t&) override { return Add(value); }
  bool string(string_t& value) override { return Add(std::move(value)); }
  bool binary(binary_t&) override { return true; }  // no part of JSON text

  bool start_object(std::size_t) override { return Open(json::object()); }
  bool start_array(std::size_t) override { return Open(json::array()); }
  bool end_object() override { return Close(); }
  bool end_array() override { return Close(); }
  bool key(string_t& name) override {
    if (skipped_depth_ > 0) return true;
    skips_next_ = !IsWanted(name);
    if (open_.size() == 1) section_ = name;
    key_ = std::move(name);
    return true;
  }
  bool parse_error(std::size_t, const std::string&, const json::exception&) override {
    return false;
  }

 private:
  // Of a member of the object that is open.
  [[nodiscard]] bool IsWanted(std::string_view name) const {
    const std::size_t depth = open_.size();
    if (depth == 1 && content_ == GltfContent::kAnimated && name == "animations") return true;
    if (depth == 1) return std::find(kWanted.begin(), kWanted.end(), name) != kWanted.end();
    if (section_ == "materials") return depth == 3 && name == "name";
    if (section_ == "extensions") {
      if (depth == 2) return IsOneOf(name, "VRM", "VRMC_vrm");
      if (depth == 3) return name == "humanoid";
      if (depth == 4) return name == "humanBones";
    }
    return name != "extras";
  }

  bool Add(json value) {
    if (skipped_depth_ > 0 || std::exchange(skips_next_, false)) return true;
    Place(std::move(value));
    return true;
  }

  bool Open(json empty) {
    if (skipped_depth_ > 0 || std::exchange(skips_next_, false)) {
      ++skipped_depth_;
    } else {
      open_.push_back(Place(std::move(empty)));
    }
    return true;
  }

  bool Close() {
    if (skipped_depth_ > 0) {
      --skipped_depth_;
    } else {
      open_.pop_back();
    }
    return true;
  }

  // Where the value now is. (An open list or object grows only when those in it are closed, so what
  // `open_` points to stays where it is.)
  json* Place(json value) {
    if (open_.empty()) {
      root_ = std::move(value);
      return &root_;
    }
    json& parent = *open_.back();
    if (parent.is_array()) {
      parent.push_back(std::move(value));
      return &parent.back();
    }
    json& member = parent[key_];
    member = std::move(value);
    return &member;
  }

  GltfContent content_;
  json root_;
  std::vector<json*> open_;
  std::string key_;
  std::string section_;  // the member of the root that is open
  bool skips_next_ = false;
  std::size_t skipped_depth_ = 0;  // open lists and objects within what is skipped
};

}  // namespace

std::optional<json> ParseGltfJson(std::string_view text, GltfContent content) {
  WantedValues values(content);
  if (!json::sax_parse(text.begin(), text.end(), &values)) return std::nullopt;
  json root = values.Take();
  if (!root.is_object()) return std::nullopt;
  return root;
}

const json& ValueAt(const json& parent, const char* key) {
  static const json& kNull = *new json();  // never destroyed: safe at exit
  if (!parent.is_object()) return kNull;
  const auto found = parent.find(key);
  return found != parent.end() ? *found : kNull;
}

const json& ArrayAt(const json& parent, const char* key) {
  static const json& kEmpty = *new json(json::array());
  const json& value = ValueAt(parent, key);
  return value.is_array() ? value : kEmpty;
}

std::optional<std::size_t> IndexAt(const json& parent, const char* key, std::size_t limit) {
  const json& value = ValueAt(parent, key);
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() >= limit) return std::nullopt;
  return value.get<std::size_t>();
}

absl::Status BadIndexAt(const FilePlace& place, const json& parent, const char* key,
                        std::size_t limit) {
  if (!parent.is_object() || !parent.contains(key)) {
    return FileError(ErrorReason::kMalformedFile, place, absl::StrCat(key, " is missing"));
  }
  const json& value = parent[key];
  if (value.is_number_integer()) return FileOutOfRange(place, key, value.dump(), IndexRange(limit));
  return FileError(ErrorReason::kMalformedFile, place, absl::StrCat(key, " is no index"));
}

std::vector<std::size_t> IndicesAt(const json& parent, const char* key, std::size_t limit) {
  std::vector<std::size_t> indices;
  for (const json& entry : ArrayAt(parent, key)) {
    if (entry.is_number_unsigned() && entry.get<std::uint64_t>() < limit) {
      indices.push_back(entry.get<std::size_t>());
    }
  }
  return indices;
}

std::optional<std::size_t> SizeAt(const json& parent, const char* key, std::size_t fallback) {
  if (!parent.is_object() || !parent.contains(key)) return fallback;
  return IndexAt(parent, key, kMostFileBytes);
}

std::string NameAt(const json& parent, const char* key) {
  const json& value = ValueAt(parent, key);
  if (!value.is_string()) return {};
  const auto& text = value.get_ref<const std::string&>();
  return text.size() <= kLongestName ? text : std::string();
}

const json& ExtensionAt(const json& parent, const char* name) {
  return ValueAt(ValueAt(parent, "extensions"), name);
}

}  // namespace capfit::formats
