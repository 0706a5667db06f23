#include "core/formats/gltf_json.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace capfit::formats {
namespace {

using nlohmann::json;

constexpr std::array<std::string_view, 8> kWanted = {
    "scene", "scenes", "nodes", "meshes", "buffers", "accessors", "bufferViews", "skins"};

// Takes the parser's events and builds what is wanted.
class WantedValues final : public json::json_sax_t {
 public:
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
    skips_next_ = open_.size() == 1
                      ? std::find(kWanted.begin(), kWanted.end(), name) == kWanted.end()
                      : name == "extras";
    key_ = std::move(name);
    return true;
  }
  bool parse_error(std::size_t, const std::string&, const json::exception&) override {
    return false;
  }

 private:
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

  json root_;
  std::vector<json*> open_;
  std::string key_;
  bool skips_next_ = false;
  std::size_t skipped_depth_ = 0;  // open lists and objects within what is skipped
};

}  // namespace

std::optional<json> ParseGltfJson(std::string_view text) {
  WantedValues values;
  if (!json::sax_parse(text.begin(), text.end(), &values)) return std::nullopt;
  json root = values.Take();
  if (!root.is_object()) return std::nullopt;
  return root;
}

}  // namespace capfit::formats
