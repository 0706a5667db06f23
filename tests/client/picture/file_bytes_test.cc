#include "client/picture/file_bytes.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <iostream>
#include <sstream>

#include "tests/support/scratch.h"

namespace capfit::client {
namespace {

class FileBytesTest : public testing::Test {
 protected:
  [[nodiscard]] std::string Path(const std::string& name) const { return scratch_.Path(name); }

  const test_support::Scratch scratch_;
};

TEST_F(FileBytesTest, AMinusIsStandardInputOnce) {
  std::istringstream input(std::string("v 1\0 2\n", 7));
  std::streambuf* const before = std::cin.rdbuf(input.rdbuf());
  EXPECT_EQ(ReadFileBytes("-").value_or("none"), std::string("v 1\0 2\n", 7));
  const absl::Status again = ReadFileBytes("-").status();
  std::cin.rdbuf(before);
  EXPECT_EQ(again.code(), absl::StatusCode::kNotFound);
}

TEST_F(FileBytesTest, AMinusIsStandardOutput) {
  testing::internal::CaptureStdout();
  EXPECT_TRUE(WriteFileBytes("-", std::string("a\0b", 3)).ok());
  EXPECT_EQ(testing::internal::GetCapturedStdout(), std::string("a\0b", 3));
  EXPECT_TRUE(CheckWritable("-").ok());
}

TEST_F(FileBytesTest, CheckingLeavesNothingBehindAndNothingEmpty) {
  EXPECT_TRUE(CheckWritable(Path("new.json")).ok());
  EXPECT_FALSE(std::filesystem::exists(Path("new.json")));
  ASSERT_TRUE(WriteFileBytes(Path("old.json"), "kept").ok());
  EXPECT_TRUE(CheckWritable(Path("old.json")).ok());
  EXPECT_EQ(ReadFileBytes(Path("old.json")).value_or("none"), "kept");
  EXPECT_TRUE(CheckWritable("/dev/null").ok());
}

TEST_F(FileBytesTest, WhatCannotBeWrittenIsNamed) {
  for (const std::string& path : {Path("no/such/folder/r.json"), scratch_.folder()}) {
    for (const absl::Status& status : {CheckWritable(path), WriteFileBytes(path, "x")}) {
      EXPECT_EQ(status.code(), absl::StatusCode::kNotFound) << path;
      EXPECT_NE(status.message().find("cannot write " + path), std::string::npos) << status;
    }
  }
  EXPECT_FALSE(WriteFileBytes("/dev/full", std::string(1 << 20, 'x')).ok());
}

}  // namespace
}  // namespace capfit::client
