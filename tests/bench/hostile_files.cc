#include <cstdint>
#include <cstring>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "tests/bench/hostile_cases.h"

namespace capfit::bench {
namespace {

using formats::MeshFormat;

constexpr std::size_t kFileBytes = std::size_t{127} << 20;

template <typename Value>
std::string Bytes(Value value) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return bytes;
}

std::string Repeated(const std::string& text, std::size_t count) {
  std::string repeated;
  repeated.reserve(text.size() * count);
  for (std::size_t i = 0; i < count; ++i) repeated += text;
  return repeated;
}
std::string Filled(const std::string& begin, const std::string& text) {
  return begin + Repeated(text, (kFileBytes - begin.size()) / text.size());
}

HostileInput Obj(std::string bytes) { return {std::move(bytes), MeshFormat::kObj, {}}; }

HostileInput NegativeIndices() {
  std::string text;
  for (int i = 0; i < 900'000; ++i) {
    absl::StrAppend(&text, "v ", i % 1000, " ", i / 1000, " 0\n");
    if (i > 1001) text += "f -1 -2 -1001 -1000\n";
  }
  return Obj(std::move(text));
}

HostileInput Ply(const std::string& header, std::string body) {
  return {absl::StrCat("ply\nformat ", header, "end_header\n", body), MeshFormat::kPly, {}};
}

// A list of a length that takes the rest of the file, and one more.
HostileInput LongLists() {
  std::string body = "0 0 0\n";
  return Ply(
      "ascii 1.0\nelement vertex 1\nproperty double x\nproperty double y\nproperty double z\n"
      "element other 20000000\nproperty list uint int l\n",
      Filled(body, "0 0 1 9 "));
}

HostileInput CountsAtTheLimit() {
  return Ply(
      "binary_little_endian 1.0\nelement vertex 2000000\nproperty char x\nproperty char y\n"
      "property char z\nelement face 2000000\nproperty list uchar uchar vertex_indices\n",
      std::string(6'000'000, '\1') + Repeated(std::string("\2\1\1", 3), 2'000'000));
}

HostileInput LyingCounts() {
  return Ply(
      "binary_little_endian 1.0\nelement vertex 1999999\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1999999\nproperty list uint uint vertex_indices\n",
      std::string(60'000'000, '\xff'));
}

HostileInput TextStl() {
  std::string text = "solid s\n";
  while (text.size() + 200 < kFileBytes) {
    const std::string x = absl::StrCat(text.size() % 1000, ".", text.size());
    absl::StrAppend(&text, "facet normal 0 0 1\nouter loop\nvertex 0 0 ", x, "\nvertex 1 0 ", x,
                    "\nvertex 0 1 ", x, "\nendloop\nendfacet\n");
  }
  return {text + "endsolid s\n", MeshFormat::kStl, {}};
}

HostileInput NanStl() {
  const std::uint32_t count = 2'000'000;
  return {std::string(80, ' ') + Bytes(count) + std::string(std::size_t{50} * count, '\xff'),
          MeshFormat::kStl,
          {}};
}

HostileInput Glb(std::string json, std::string binary = {}) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  binary.resize((binary.size() + 3) / 4 * 4, '\0');
  const auto word = [](std::size_t value) { return Bytes(static_cast<std::uint32_t>(value)); };
  return {absl::StrCat("glTF", word(2), word(28 + json.size() + binary.size()), word(json.size()),
                       "JSON", json, word(binary.size()), std::string("BIN\0", 4), binary),
          MeshFormat::kGlb,
          {}};
}

constexpr const char* kArrays =
    R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},)"
    R"({"bufferView":1,"componentType":5126,"count":4096,"type":"MAT4"}],)"
    R"("bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":262144}],)"
    R"("buffers":[{"byteLength":262180}])";

std::string NodesOf(const std::string& node, std::size_t count) {
  return absl::StrCat(R"("nodes":[)", Repeated(absl::StrCat(node, ","), count), "{}]");
}

HostileInput ManyDraws() {
  return Glb(absl::StrCat("{", NodesOf(R"({"mesh":0})", 90'000), R"(,"meshes":[{"primitives":[)",
                          Repeated(R"({"mode":0},)", 90'000), R"({"mode":0}]}]})"));
}

HostileInput ManySkins() {
  return Glb(absl::StrCat("{", NodesOf(R"({"mesh":0,"skin":0})", 90'000),
                          R"(,"meshes":[{}],"skins":[{"inverseBindMatrices":1,"joints":[)",
                          Repeated("0,", 4095), "0]}],", kArrays, "}"),
             std::string(262'180, '\0'));
}

HostileInput ManyNodes() { return Glb(absl::StrCat("{", NodesOf("{}", 2'700'000), "}")); }

HostileInput LongNames() {
  return Glb(absl::StrCat(R"({"nodes":[{"name":")", std::string(4 << 20, 'n'),
                          R"(","mesh":0,"skin":0}],"meshes":[{}],)",
                          R"("skins":[{"inverseBindMatrices":1,"joints":[)", Repeated("0,", 4095),
                          "0]}],", kArrays, "}"),
             std::string(262'180, '\0'));
}

// A chain of 100,000 nodes, all of them joints as far as joints go.
HostileInput DeepTree() {
  std::string nodes = R"("nodes":[{"mesh":0,"skin":0,"children":[1]})";
  for (int n = 1; n < 99'999; ++n) absl::StrAppend(&nodes, R"(,{"children":[)", n + 1, "]}");
  std::string joints = "99999";
  for (int j = 1; j < 4096; ++j) absl::StrAppend(&joints, ",", 99'999 - j);
  return Glb(absl::StrCat("{", nodes, R"(,{}],"scenes":[{"nodes":[0]}],"meshes":[{"primitives":)",
                          R"([{"attributes":{"POSITION":0}}]}],"skins":[{"joints":[)", joints,
                          "]}],", kArrays, "}"),
             std::string(262'180, '\0'));
}

HostileInput ManyPrimitives() {
  return Glb(absl::StrCat(R"({"nodes":[{"mesh":0}],"meshes":[{"primitives":[)",
                          Repeated(R"({"attributes":{"POSITION":0}},)", 99'999),
                          R"({"attributes":{"POSITION":0}}]}],)", kArrays, "}"),
             std::string(262'180, '\0'));
}

// Many meshes of one primitive, so that none repeats another.
HostileInput ManyMeshes() {
  return Glb(
      absl::StrCat("{", NodesOf(R"({"mesh":0})", 99'000),
                   R"(,"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)", kArrays, "}"),
      std::string(262'180, '\0'));
}

HostileInput ManySkinsOfManyJoints() {
  std::string skins;
  std::string nodes;
  for (int s = 0; s < 400; ++s) {
    absl::StrAppend(&nodes, R"({"mesh":0,"skin":)", s, "},");
    absl::StrAppend(&skins, s == 0 ? "" : ",", R"({"joints":[)", Repeated("0,", 4095), "0]}");
  }
  return Glb(absl::StrCat(R"({"nodes":[)", nodes, R"({}],"meshes":[{}],"skins":[)", skins, "],",
                          kArrays, "}"),
             std::string(262'180, '\0'));
}

HostileInput ManyMorphs() {
  return Glb(absl::StrCat(R"({"nodes":[{"mesh":0}],"meshes":[{"weights":[)",
                          Repeated("1,", 200'000),
                          R"(1],"primitives":[{"attributes":{"POSITION":2},"targets":[)",
                          Repeated(R"({"POSITION":2},)", 200'000),
                          R"({"POSITION":2}]}]}],"accessors":[{},{},{"componentType":5126,)",
                          R"("count":2000000,"type":"VEC3"}]})"));
}

HostileInput ManySparse() {
  std::string primitives;
  std::string accessors;
  for (int a = 0; a < 5000; ++a) {
    absl::StrAppend(&primitives, a == 0 ? "" : ",", R"({"attributes":{"POSITION":)", a, "}}");
    absl::StrAppend(
        &accessors, a == 0 ? "" : ",",
        R"({"componentType":5126,"count":1900000,"type":"VEC3","sparse":{"count":1,)",
        R"("indices":{"bufferView":0,"componentType":5125},"values":{"bufferView":0}}})");
  }
  return Glb(absl::StrCat(R"({"nodes":[{"mesh":0}],"meshes":[{"primitives":[)", primitives,
                          R"(]}],"accessors":[)", accessors,
                          R"(],"bufferViews":[{"buffer":0,"byteLength":36}],)",
                          R"("buffers":[{"byteLength":36}]})"),
             std::string(36, '\0'));
}

// Views that unpack to 64 times as many bytes, again and again.
HostileInput PackedZeros() {
  std::string primitives;
  std::string accessors;
  std::string views;
  for (int a = 0; a < 2000; ++a) {
    absl::StrAppend(&primitives, a == 0 ? "" : ",", R"({"attributes":{"POSITION":)", a, "}}");
    absl::StrAppend(&accessors, a == 0 ? "" : ",", R"({"bufferView":)", a,
                    R"(,"componentType":5126,"count":900,"type":"VEC3"})");
    absl::StrAppend(&views, a == 0 ? "" : ",",
                    R"({"buffer":0,"byteLength":36,"extensions":{"EXT_meshopt_compression":)",
                    R"({"buffer":0,"byteLength":1000033,"mode":"ATTRIBUTES","count":4000000,)",
                    R"("byteStride":16}}})");
  }
  return Glb(absl::StrCat(R"({"nodes":[{"mesh":0}],"meshes":[{"primitives":[)", primitives,
                          R"(]}],"accessors":[)", accessors, R"(],"bufferViews":[)", views,
                          R"(],"buffers":[{"byteLength":1048576}]})"),
             "\xa0" + std::string((1 << 20) - 1, '\0'));
}

HostileInput NestedJson() {
  const std::size_t depth = 4'000'000;
  return Glb(absl::StrCat(R"({"nodes":)", std::string(depth, '['), std::string(depth, ']'), "}"));
}

HostileInput SmallJsonValues() {
  return Glb(absl::StrCat(R"({"nodes":[)", Repeated("[],", 2'700'000), "1]}"));
}

}  // namespace

std::vector<HostileCase> HostileFiles() {
  return {{"OBJ: one line of 127 MB", [] { return Obj(Filled("v 0 0 0\n# ", "word ")); }},
          {"OBJ: continued line of 127 MB", [] { return Obj(Filled("v 0 0 0\nf ", "1 \\\n")); }},
          {"OBJ: a million faces of 64 corners",
           [] { return Obj(Filled("v 0 0 0\n", absl::StrCat("f ", Repeated("1 ", 64), "\n"))); }},
          {"OBJ: a face of 127 MB", [] { return Obj(Filled("v 0 0 0\nf ", "1 ")); }},
          {"OBJ: a number of 127 MB", [] { return Obj(Filled("v 0.", "1")); }},
          {"OBJ: negative indices", NegativeIndices},
          {"PLY: lists without end", LongLists},
          {"PLY: counts at the limit, faces of two corners", CountsAtTheLimit},
          {"PLY: 0xff where numbers should be", LyingCounts},
          {"STL: text of 127 MB", TextStl},
          {"STL: NaN only", NanStl},
          {"OFF: comments only",
           [] {
             return HostileInput{Filled("OFF\n", "#\n"), MeshFormat::kOff, {}};
           }},
          {"unknown format, 127 MB of line ends",
           [] {
             return HostileInput{Filled("", "\n"), MeshFormat::kUnknown, {}};
           }},
          {"GLB: 90,000 nodes draw 90,000 primitives", ManyDraws},
          {"GLB: 90,000 nodes with 4096 joints", ManySkins},
          {"GLB: 2,700,000 nodes", ManyNodes},
          {"GLB: joints 100,000 deep", DeepTree},
          {"GLB: 100,000 primitives", ManyPrimitives},
          {"GLB: 99,000 meshes", ManyMeshes},
          {"GLB: 400 skins of 4096 joints", ManySkinsOfManyJoints},
          {"GLB: 200,000 morph targets", ManyMorphs},
          {"GLB: 5,000 sparse accessors of 1,900,000", ManySparse},
          {"GLB: 2,000 views packed 64 to 1", PackedZeros},
          {"GLB: a name of 4 MB, 4096 times", LongNames},
          {"GLB: nested 4,000,000 deep", NestedJson},
          {"GLB: 2,700,000 lists", SmallJsonValues}};
}

}  // namespace capfit::bench
