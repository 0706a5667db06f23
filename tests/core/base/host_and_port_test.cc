#include "core/base/host_and_port.h"

#include <gtest/gtest.h>

#include <utility>

#include "core/base/status.h"

namespace capfit {
namespace {

TEST(HostAndPort, APortIsPutWhereNoneIs) {
  const std::pair<const char*, const char*> cases[] = {
      {"localhost", "localhost:50051"},
      {"127.0.0.1", "127.0.0.1:50051"},
      {"fit.example.com:7", "fit.example.com:7"},
      {"localhost:0065535", "localhost:65535"},
      {"::1", "[::1]:50051"},
      {"fe80::1%eth0", "[fe80::1%eth0]:50051"},
      {"[::1]", "[::1]:50051"},
      {"[::1]:7", "[::1]:7"},
      {"unix:/run/capfit.socket", "unix:/run/capfit.socket"},
      {"dns:///fit:99999", "dns:///fit:99999"},
  };
  for (const auto& [address, whole] : cases) {
    const auto result = WithPort(address);
    ASSERT_TRUE(result.ok()) << result.status();
    EXPECT_EQ(*result, whole);
  }
}

TEST(HostAndPort, PortsThatAreNoneAreRefused) {
  for (const char* const address : {"h:0", "h:65536", "h:99999999999999999999", "h:-1", "h:http",
                                    "h:", "h:7x", "[::1]:70000"}) {
    const absl::Status status = WithPort(address).status();
    EXPECT_EQ(ReasonOf(status), ErrorReason::kOutOfRange) << address;
    EXPECT_NE(status.message().find("must be a whole number in [1, 65535]"), std::string::npos)
        << status;
  }
  for (const char* const address : {"", ":7", "[::1", "[::1]7", "a host", "h:7\n"}) {
    EXPECT_FALSE(WithPort(address).ok()) << address;
  }
}

TEST(HostAndPort, AnyFreePortMayBeAskedForWhereItIsAllowed) {
  EXPECT_EQ(WithPort("127.0.0.1:0", 0).value_or("refused"), "127.0.0.1:0");
  EXPECT_FALSE(WithPort("127.0.0.1:65536", 0).ok());
}

}  // namespace
}  // namespace capfit
