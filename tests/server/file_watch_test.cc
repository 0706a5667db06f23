#include "server/file_watch.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include "tests/support/scratch.h"

namespace capfit::server {
namespace {

class FileWatchTest : public testing::Test {
 protected:
  void Write(const std::string& name, const std::string& text) const {
    std::ofstream(Path(name)) << text;
  }
  [[nodiscard]] std::string Path(const std::string& name) const { return scratch_.Path(name); }
  // It looks once a second at most.
  static bool SaysSo(FileWatch& watch) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1050));
    return watch.HasChanged();
  }

  const test_support::Scratch scratch_;
};

TEST_F(FileWatchTest, SeesEachChangeOnce) {
  Write("a", "one");
  FileWatch watch({Path("a"), ""});
  EXPECT_FALSE(SaysSo(watch));
  Write("a", "two, longer");
  EXPECT_TRUE(SaysSo(watch));
  EXPECT_FALSE(SaysSo(watch));
  std::filesystem::remove(Path("a"));
  EXPECT_TRUE(SaysSo(watch));
  Write("a", "back");
  EXPECT_TRUE(SaysSo(watch));
}

TEST_F(FileWatchTest, SeesARenamedFileOfTheSameSizeAndALinkThatLeadsElsewhere) {
  Write("a", "one");
  Write("b", "two");
  std::filesystem::remove(Path("link"));
  std::filesystem::create_symlink(Path("a"), Path("link"));
  FileWatch by_link({Path("link")});
  FileWatch by_name({Path("a")});
  std::filesystem::create_symlink(Path("b"), Path("link.new"));
  std::rename(Path("link.new").c_str(), Path("link").c_str());
  EXPECT_TRUE(SaysSo(by_link));
  EXPECT_FALSE(by_name.HasChanged());
  std::rename(Path("b").c_str(), Path("a").c_str());
  EXPECT_TRUE(SaysSo(by_name));
}

}  // namespace
}  // namespace capfit::server
