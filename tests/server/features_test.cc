// The vocabulary of GetServerInfo.features: documented, complete, and true.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <set>

#include "server/server_info.h"

namespace capfit::server {
namespace {

// The words in the comment on `features`, in their order.
std::vector<std::string> DocumentedWords() {
  std::ifstream in(std::string(CAPFIT_PROTO_FOLDER) + "/server_info.proto");
  const std::regex word(R"(\b(?:call|budget|fit|quality|skinning|option)\.[a-z_]+)");
  std::vector<std::string> words;
  bool is_on = false;
  for (std::string line; std::getline(in, line);) {
    is_on |= line.find("The whole vocabulary") != std::string::npos;
    if (line.find("repeated string features") != std::string::npos) break;
    if (!is_on) continue;
    for (std::sregex_iterator i(line.begin(), line.end(), word), end; i != end; ++i) {
      words.push_back(i->str());
    }
  }
  return words;
}

std::vector<std::string> Promised() {
  const v1::GetServerInfoResponse info =
      DescribeServer({}, 1, {pipeline::ValidateOptions, pipeline::Fit});
  return {info.features().begin(), info.features().end()};
}

TEST(Features, AreTheDocumentedWordsInTheirOrder) { EXPECT_EQ(Promised(), DocumentedWords()); }

// Every field of the options and every value of its enums has a word, so that a client can ask for
// anything that it may want to set.
TEST(Features, HaveAWordForEveryOption) {
  const std::map<std::string, std::vector<std::string>> words_of = {
      {"budget",
       {"budget.max_primitives", "budget.spheres_and_capsules", "budget.max_polygon_error"}},
      {"fit_mode", {"fit.enclose", "fit.best_fit"}},
      {"quality", {"quality.paper", "quality.balanced", "quality.tight"}},
      {"parts", {}},  // every server fits every part
      {"sex", {"option.sex"}},
      {"skinning", {"skinning.dense", "skinning.sparse", "skinning.bones"}},
      {"landmarks", {"option.landmarks"}},
      {"seed", {"option.seed"}},
      {"want_feature_polygons", {"option.feature_polygons"}},
      {"tolerance_m", {"option.tolerance_m"}},
      {"require_parts", {"option.require_parts"}},
      {"include_parts", {"option.mesh_parts"}},
      {"exclude_parts", {"option.mesh_parts"}},
      {"include_hair", {"option.mesh_parts"}},
      {"include_skirt", {"option.mesh_parts"}},
      {"want_vertex_gaps", {"option.vertex_gaps"}},
      {"engine", {"budget.engine"}}};
  std::set<std::string> words = {"call.unary", "call.layout", "call.exports"};
  const google::protobuf::Descriptor& options = *v1::FitOptions::descriptor();
  for (int i = 0; i < options.field_count(); ++i) {
    const auto found = words_of.find(options.field(i)->name());
    ASSERT_NE(found, words_of.end()) << options.field(i)->name() << " has no word";
    words.insert(found->second.begin(), found->second.end());
  }
  const std::vector<std::string> documented = DocumentedWords();
  EXPECT_EQ(words, std::set<std::string>(documented.begin(), documented.end()));
  EXPECT_EQ(v1::Budget::descriptor()->field_count(), 3);
  EXPECT_EQ(v1::FitMode_descriptor()->value_count(), 3);
  EXPECT_EQ(v1::Quality_descriptor()->value_count(), 4);
  EXPECT_EQ(v1::SkinningForm_descriptor()->value_count(), 5);
}

}  // namespace
}  // namespace capfit::server
