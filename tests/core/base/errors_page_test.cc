// docs/errors.md lists what the sources say, no more and no less.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "core/base/error_reason.h"

namespace capfit {
namespace {

// Words in capitals that are neither warnings nor reasons: names of others.
constexpr std::array<std::string_view, 5> kNoWarnings = {"GLIBC_TUNABLES", "JOINTS_0", "JOINTS_1",
                                                         "WEIGHTS_0", "WEIGHTS_1"};

std::filesystem::path Source(const std::string& path) {
  return std::filesystem::path(CAPFIT_SOURCE_DIR) / path;
}

std::string TextOf(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  EXPECT_TRUE(in.good()) << path;
  return {std::istreambuf_iterator<char>(in), {}};
}

// All that `pattern` finds, in order: the groups of each match, with blanks between.
std::vector<std::string> FindAll(const std::string& text, const std::string& pattern) {
  const std::regex regex(pattern);
  std::vector<std::string> found;
  for (std::sregex_iterator match(text.begin(), text.end(), regex), end; match != end; ++match) {
    std::string groups;
    for (std::size_t k = 1; k < match->size(); ++k) {
      absl::StrAppend(&groups, groups.empty() ? "" : " ", (*match)[k].str());
    }
    found.push_back(groups);
  }
  return found;
}

// One section of the page, from its heading to the next one.
std::string Section(const std::string& heading) {
  const std::string page = TextOf(Source("docs/errors.md"));
  const std::size_t begin = page.find("\n## " + heading + "\n");
  EXPECT_NE(begin, std::string::npos) << heading;
  return page.substr(begin + 1, page.find("\n## ", begin + 1) - begin);
}

// Warnings are the words in capitals, with an underscore, that stand alone in a literal, however
// they are handed on.
void CollectWarnings(const std::string& folder, std::set<std::string>& codes) {
  for (const auto& entry : std::filesystem::recursive_directory_iterator(Source(folder))) {
    if (entry.path().extension() != ".cc" || entry.path().filename() == "error_reason.cc") continue;
    for (std::string& code : FindAll(TextOf(entry.path()), "\"([A-Z][A-Z0-9]*(?:_[A-Z0-9]+)+)\"")) {
      codes.insert(std::move(code));
    }
  }
}

TEST(ErrorsPageTest, ListsAllReasonsWithTheirCodesInOrder) {
  std::vector<std::string> known;
  for (const KnownReason& reason : ErrorReasons()) {
    known.push_back(
        absl::StrCat(std::string(reason.name), " ", absl::StatusCodeToString(reason.code)));
  }
  EXPECT_EQ(FindAll(Section("Reasons"),
                    "\n\\| `([A-Z_]+)` \\| `([A-Z_]+)` \\| [^|]+ \\| [^|]+ \\| "
                    "[^|]+ \\|"),
            known);
}

TEST(ErrorsPageTest, ListsAllWarnings) {
  std::set<std::string> emitted;
  for (const char* const folder : {"core", "server", "proto/wire"})
    CollectWarnings(folder, emitted);
  for (const std::string_view word : kNoWarnings) EXPECT_EQ(emitted.erase(std::string(word)), 1U);
  const std::vector<std::string> listed =
      FindAll(Section("Warnings"), "\n\\| `([A-Z_]+)` \\| [^|]+ \\| [^|]+ \\|");
  EXPECT_THAT(listed, testing::UnorderedElementsAreArray(emitted));
}

}  // namespace
}  // namespace capfit
