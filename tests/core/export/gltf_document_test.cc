#include "core/export/gltf_document.h"

#include <gtest/gtest.h>

#include <cstring>

#include "absl/strings/escaping.h"
#include "tests/core/export/rigged_sample.h"

namespace capfit::exports {
namespace {

using nlohmann::json;

GltfDocument Open(const std::string& bytes) {
  auto document = GltfDocument::Open(BytesOf(bytes));
  EXPECT_TRUE(document.ok()) << document.status();
  return document.ok() ? *std::move(document) : GltfDocument();
}

// What a reader gets for a buffer view of the document's file.
std::string ViewOf(const GltfDocument& document, std::size_t index) {
  const auto bytes = document.Bytes();
  auto file = formats::GltfFile::Open(BytesOf(*bytes));
  EXPECT_TRUE(file.ok()) << file.status();
  const auto view = file->View(index);
  EXPECT_TRUE(view.ok()) << view.status();
  return {reinterpret_cast<const char*>(view->data()), view->size()};
}

TEST(GltfDocument, NewBytesFollowThoseThatAreThere) {
  GltfDocument document = Open(GlbOf(RiggedGltf(), "12345"));
  EXPECT_EQ(ViewOf(document, document.AddView("abc", 34962)), "abc");
  EXPECT_EQ(ViewOf(document, document.AddView("defgh", 34963)), "defgh");
  EXPECT_EQ(document.root()["bufferViews"][1]["byteOffset"].get<int>() % 4, 0);
  const std::string bytes = document.Bytes().value();
  const auto chunks = formats::SplitGltf(BytesOf(bytes));
  EXPECT_EQ(std::memcmp(chunks->binary.data(), "12345", 5), 0);
}

TEST(GltfDocument, TheFirstBufferOfTextBecomesTheBinaryChunk) {
  json gltf = RiggedGltf();
  gltf["buffers"] = {
      {{"byteLength", 4},
       {"uri", "data:application/octet-stream;base64," + absl::Base64Escape("wxyz")}},
      {{"byteLength", 3}, {"uri", "data:;base64," + absl::Base64Escape("uvw")}}};
  gltf["bufferViews"] = {{{"buffer", 0}, {"byteLength", 4}}, {{"buffer", 1}, {"byteLength", 3}}};
  GltfDocument document = Open(gltf.dump());
  EXPECT_FALSE(document.root()["buffers"][0].contains("uri"));
  EXPECT_EQ(ViewOf(document, 0), "wxyz");
  EXPECT_EQ(ViewOf(document, 1), "uvw");
  EXPECT_EQ(ViewOf(document, document.AddView("abc", 34962)), "abc");
}

TEST(GltfDocument, WhereTheFirstBufferIsElsewhereNewBytesGetOneOfTheirOwn) {
  json gltf = RiggedGltf();
  gltf["buffers"] = {{{"byteLength", 4}, {"uri", "textures.bin"}}};
  GltfDocument document = Open(gltf.dump());
  EXPECT_EQ(ViewOf(document, document.AddView("abc", 34962)), "abc");
  EXPECT_EQ(document.root()["buffers"][0]["uri"], "textures.bin");
}

TEST(GltfDocument, ChunksOfOtherTypesStay) {
  const std::string text = RiggedGltf().dump();
  const std::string other("\4\0\0\0ABCDwxyz", 12);
  formats::GltfChunks chunks;
  chunks.description = text;
  chunks.others = {BytesOf(other)};
  const GltfDocument document = Open(formats::JoinGltf(chunks).value());
  const std::string bytes = document.Bytes().value();
  EXPECT_EQ(bytes.substr(bytes.size() - 12), other);
}

TEST(GltfDocument, AFileWithoutScenesGetsOneOfAllItsRoots) {
  json gltf = RiggedGltf();
  gltf.erase("scenes");
  gltf.erase("scene");
  GltfDocument document = Open(GlbOf(gltf));
  const std::size_t node = document.AddNode({{"name", "new"}}, std::nullopt);
  EXPECT_EQ(document.root()["scenes"], json({{{"nodes", {0, node}}}}));
}

TEST(GltfDocument, AnEmptyOneIsAFile) {
  GltfDocument document;
  document.AddNode({{"name", "new"}}, std::nullopt);
  const json gltf = JsonOf(document.Bytes().value());
  EXPECT_EQ(gltf["asset"]["version"], "2.0");
  EXPECT_EQ(gltf["scenes"][0]["nodes"], json::array({0}));
}

}  // namespace
}  // namespace capfit::exports
