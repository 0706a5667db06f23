#include "server/caller.h"

#include <gtest/gtest.h>

namespace capfit::server {
namespace {

TEST(HostOfPeer, IsThePartBeforeThePort) {
  EXPECT_EQ(HostOfPeer("ipv4:192.0.2.7:4711"), "192.0.2.7");
  EXPECT_EQ(HostOfPeer("ipv6:%5B2001:db8::1%5D:4711"), "2001:db8::1");
  EXPECT_EQ(HostOfPeer("ipv6:%5B::1%5D:1"), "::1");
  EXPECT_EQ(HostOfPeer("unix:/run/capfit.sock"), "unix:/run/capfit.sock");
  EXPECT_EQ(HostOfPeer("inproc"), "inproc");
  EXPECT_EQ(HostOfPeer(""), "");
  EXPECT_EQ(HostOfPeer("ipv4:"), "ipv4:");
}

}  // namespace
}  // namespace capfit::server
