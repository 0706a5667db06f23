#include "core/base/available_cores.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

namespace capfit {
namespace {

namespace fs = std::filesystem;

// A machine's files, as far as quotas stand in them.
class QuotaOfCoresTest : public testing::Test {
 protected:
  void SetUp() override {
    root_ = fs::path(testing::TempDir()) /
            testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::remove_all(root_);
  }
  void TearDown() override { fs::remove_all(root_); }

  void Write(const std::string& path, const std::string& text) const {
    fs::create_directories((root_ / path).parent_path());
    std::ofstream(root_ / path) << text;
  }
  [[nodiscard]] double Quota() const { return QuotaOfCores(root_); }

 private:
  fs::path root_;
};

TEST_F(QuotaOfCoresTest, NoneWithoutControlGroups) { EXPECT_EQ(Quota(), 0.0); }

TEST_F(QuotaOfCoresTest, OfAContainerIsAtTheTopOfItsTree) {
  Write("proc/self/cgroup", "0::/\n");
  Write("sys/fs/cgroup/cpu.max", "150000 100000\n");
  EXPECT_EQ(Quota(), 1.5);
  Write("sys/fs/cgroup/cpu.max", "max 100000\n");
  EXPECT_EQ(Quota(), 0.0);
}

TEST_F(QuotaOfCoresTest, TheLeastOfAGroupAndThoseAboveIt) {
  Write("proc/self/cgroup", "0::/pods/one/server\n");
  Write("sys/fs/cgroup/pods/one/server/cpu.max", "400000 100000\n");
  EXPECT_EQ(Quota(), 4.0);
  Write("sys/fs/cgroup/pods/one/cpu.max", "100000 50000\n");
  EXPECT_EQ(Quota(), 2.0);
  Write("sys/fs/cgroup/pods/cpu.max", "max 100000\n");
  EXPECT_EQ(Quota(), 2.0);
  Write("sys/fs/cgroup/other/cpu.max", "1000 100000\n");
  EXPECT_EQ(Quota(), 2.0) << "not of a group that it is not in";
}

TEST_F(QuotaOfCoresTest, OfVersionOneToo) {
  Write("proc/self/cgroup", "9:memory:/docker/f00\n3:cpu,cpuacct:/docker/f00\n0::/docker/f00\n");
  Write("sys/fs/cgroup/cpu,cpuacct/cpu.cfs_quota_us", "300000\n");
  Write("sys/fs/cgroup/cpu,cpuacct/cpu.cfs_period_us", "100000\n");
  EXPECT_EQ(Quota(), 3.0);
  Write("sys/fs/cgroup/cpu,cpuacct/cpu.cfs_quota_us", "-1\n");
  EXPECT_EQ(Quota(), 0.0) << "-1 is no limit";
  Write("sys/fs/cgroup/cpu/docker/f00/cpu.cfs_quota_us", "50000\n");
  Write("sys/fs/cgroup/cpu/docker/f00/cpu.cfs_period_us", "100000\n");
  EXPECT_EQ(Quota(), 0.5);
}

TEST_F(QuotaOfCoresTest, WhatCannotBeReadIsNoQuota) {
  Write("proc/self/cgroup", "nothing\n0:\n0::/\n");
  for (const char* const text : {"", "\n", "5\n", "0 100000\n", "100000 0\n", "x y\n", "1 2 3\n"}) {
    Write("sys/fs/cgroup/cpu.max", text);
    EXPECT_EQ(Quota(), 0.0) << text;
  }
}

TEST(AvailableCoresTest, IsWhatThisProcessHas) {
  const int cores = AvailableCores();
  EXPECT_GE(cores, 1);
  const double quota = QuotaOfCores();
  if (quota > 0.0) {
    EXPECT_LT(cores, quota + 1.0);
  }
}

}  // namespace
}  // namespace capfit
