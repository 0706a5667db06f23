#include "client/connection.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace capfit::client {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(Connection, OneAddressStandsAndSeveralBecomeNumbers) {
  EXPECT_EQ(*TargetOf("capfit"), "capfit:50051");
  EXPECT_EQ(*TargetOf("dns:///capfit:7"), "dns:///capfit:7");
  EXPECT_EQ(*TargetOf("127.0.0.1:7,localhost"), "ipv4:127.0.0.1:7,127.0.0.1:50051");
  EXPECT_EQ(*TargetOf("[::1]:7,::1"), "ipv6:[::1]:7,[::1]:50051");
}

TEST(Connection, WhatIsNoAddressIsNamed) {
  EXPECT_THAT(std::string(TargetOf("127.0.0.1,host:port").status().message()),
              HasSubstr("host:port"));
  EXPECT_THAT(std::string(TargetOf("127.0.0.1,[::1]").status().message()), HasSubstr("IPv6"));
  EXPECT_TRUE(absl::IsUnavailable(TargetOf("127.0.0.1,no-such-host.invalid").status()));
}

TEST(Connection, OnlySeveralServersAreAskedForTheirHealth) {
  EXPECT_THAT(ServiceConfig("capfit:7"), Not(HasSubstr("healthCheckConfig")));
  EXPECT_THAT(ServiceConfig("dns:///capfit:7"), HasSubstr("healthCheckConfig"));
  EXPECT_THAT(ServiceConfig("ipv4:1.2.3.4:7,1.2.3.5:7"), HasSubstr("healthCheckConfig"));
  EXPECT_THAT(ServiceConfig("ipv4:1.2.3.4:7,1.2.3.5:7"), HasSubstr("round_robin"));
}

}  // namespace
}  // namespace capfit::client
