// Servers that share results through a real Redis, which is lost, stalled, full and lied through.
#include "server/shared_cache.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <string>

#include "absl/strings/str_cat.h"
#include "tests/server/certificates.h"
#include "tests/server/fake_fit.h"
#include "tests/server/redis_process.h"
#include "tests/server/service_call.h"

namespace capfit::server {
namespace {

using testing::HasSubstr;

class SharedCacheTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!RedisProcess::IsInstalled())
      GTEST_SKIP() << "SKIPPED: no redis-server: apt-get install redis-server";
  }

  // Most tests are about what Redis answers, however long a busy machine takes for it.
  static constexpr double kPatientSeconds = 30.0;

  // A replica that keeps nothing itself, connected to `address` unless told otherwise.
  std::unique_ptr<Server> StartReplica(const std::string& address, bool is_connected = true,
                                       const std::string& password_file = "",
                                       double answer_seconds = kPatientSeconds) {
    ServerConfig config;
    config.cache_bytes = 0;
    config.cache_redis = address;
    config.cache_redis_password_file = password_file;
    config.cache_redis_seconds = answer_seconds;
    FitBackend backend = InstantBackend(2000);
    backend.fit = [this, fit = backend.fit](const auto& soup, const auto& options, const auto& pool,
                                            FitObserver& observer) {
      ++fits_;
      absl::StatusOr<pipeline::FitResult> result = fit(soup, options, pool, observer);
      result->seconds = soup.positions[0].x();  // another body, another result
      return result;
    };
    auto server = StartServer(backend, config);
    if (is_connected) {
      EXPECT_TRUE(WaitFor([&] { return Has(*server, "capfit_shared_cache_up 1"); }));
    }
    return server;
  }

  static bool Has(const Server& server, const std::string& line) {
    return server.MetricsText().find("\n" + line + "\n") != std::string::npos;
  }

  static std::string ErrorsOf(const std::string& kind, int count) {
    return absl::StrCat("capfit_cache_errors_total{kind=\"", kind, "\"} ", count);
  }

  // The answer to body number `body`, without progress.
  static std::string AnswerOf(Server& server, int body = 0) {
    Call call(LoopbackChannel(server));
    v1::ApproximateBodyRequest chunk = Chunk();
    chunk.mutable_chunk()->mutable_arrays()->set_positions(0, static_cast<float>(body));
    call.Send({Header("id"), chunk});
    const grpc::Status status = call.Finish();
    EXPECT_TRUE(status.ok()) << status.error_message();
    std::string bytes;
    for (const v1::ApproximateBodyResponse& response : call.responses) {
      if (!response.has_progress()) bytes += response.SerializeAsString();
    }
    return bytes;
  }

  std::atomic<int> fits_{0};
};

TEST_F(SharedCacheTest, WhatOneReplicaFittedTheOtherAnswersWithTheSameBits) {
  const RedisProcess redis;
  const auto first = StartReplica(redis.address());
  const auto second = StartReplica(redis.address());
  const std::string answer = AnswerOf(*first);
  EXPECT_EQ(fits_, 1);
  EXPECT_TRUE(AnswerOf(*second) == answer);
  EXPECT_EQ(fits_, 1);
  EXPECT_TRUE(Has(*second, "capfit_cache_hits_total{tier=\"redis\"} 1"));
  AnswerOf(*second, 7);
  EXPECT_EQ(fits_, 2);
}

TEST_F(SharedCacheTest, LiesAreDroppedCountedAndWrittenOver) {
  const RedisProcess redis;
  const auto server = StartReplica(redis.address());
  const std::string other = AnswerOf(*server, 7);
  const std::string of_other_body = redis.Ask({"GET", redis.OnlyKey()});
  ASSERT_GT(of_other_body.size(), 1000U);
  redis.Ask({"FLUSHALL"});
  const std::string right = AnswerOf(*server);
  const std::string key = redis.OnlyKey();
  const std::string value = redis.Ask({"GET", key});
  std::string changed = value;
  changed[changed.size() / 2] ^= 1;
  int lies = 0;
  for (const std::string& lie :
       {of_other_body, changed, value.substr(0, value.size() / 2), std::string("garbage"),
        std::string(9 * 1024 * 1024, 'x'), value + "and more"}) {
    EXPECT_EQ(redis.Ask({"SET", key, lie}), "OK");
    const int fits_before = fits_;
    EXPECT_TRUE(AnswerOf(*server) == right);
    EXPECT_EQ(fits_, fits_before + 1) << "the lie was not believed";
    EXPECT_TRUE(Has(*server, ErrorsOf("wrong", ++lies)));
    EXPECT_TRUE(redis.Ask({"GET", key}) == value) << "the truth is back";
  }
  // Of another type: Redis itself complains.
  redis.Ask({"DEL", key});
  redis.Ask({"RPUSH", key, "a", "list"});
  EXPECT_TRUE(AnswerOf(*server) == right);
  EXPECT_TRUE(Has(*server, ErrorsOf("refused", 1)));
  EXPECT_TRUE(other != right);
}

TEST_F(SharedCacheTest, AKilledRedisFailsNoCallAndIsUsedAgainWhenItIsBack) {
  auto redis = std::make_unique<RedisProcess>();
  const int port = redis->port();
  const auto server = StartReplica(redis->address());
  const std::string right = AnswerOf(*server);
  redis->Kill();
  for (int i = 0; i < 20; ++i) EXPECT_TRUE(AnswerOf(*server) == right);
  EXPECT_EQ(fits_, 21);
  EXPECT_TRUE(Has(*server, "capfit_shared_cache_up 0"));
  EXPECT_TRUE(Has(*server, ErrorsOf("lost", 1)));
  redis = std::make_unique<RedisProcess>(std::vector<std::string>{}, port);
  EXPECT_TRUE(WaitFor([&] { return Has(*server, "capfit_shared_cache_up 1"); }));
  AnswerOf(*server);
  const int fits_before = fits_;
  EXPECT_TRUE(AnswerOf(*server) == right);
  EXPECT_EQ(fits_, fits_before);
}

TEST_F(SharedCacheTest, AStalledRedisCostsOneWaitAndNoCall) {
  const RedisProcess redis;
  const auto server = StartReplica(redis.address(), true, "", ServerConfig().cache_redis_seconds);
  redis.Signal(SIGSTOP);
  for (int i = 0; i < 20; ++i) AnswerOf(*server);
  redis.Signal(SIGCONT);
  EXPECT_EQ(fits_, 20);
  // Later calls found no connection, so they did not wait: one was late, not twenty.
  EXPECT_TRUE(Has(*server, ErrorsOf("late", 1)));
  EXPECT_TRUE(WaitFor([&] { return Has(*server, "capfit_shared_cache_up 1"); }));
}

TEST_F(SharedCacheTest, AFullRedisStillGivesWhatItHas) {
  const RedisProcess redis({"--maxmemory-policy", "noeviction"});
  const auto server = StartReplica(redis.address());
  const std::string right = AnswerOf(*server);
  EXPECT_EQ(redis.Ask({"CONFIG", "SET", "maxmemory", "1"}), "OK");
  for (int body = 1; body < 5; ++body) AnswerOf(*server, body);
  EXPECT_EQ(fits_, 5);
  EXPECT_TRUE(Has(*server, ErrorsOf("refused", 1))) << "asked once, then left alone with results";
  EXPECT_TRUE(AnswerOf(*server) == right);
  EXPECT_EQ(fits_, 5);
}

TEST_F(SharedCacheTest, APasswordIsSentAndAWrongOneIsSaid) {
  const RedisProcess redis({"--requirepass", "open-sesame"}, 0, "open-sesame");
  const std::string right = WriteTestFile("redis_password", "open-sesame\n");
  const auto server = StartReplica(redis.address(), true, right);
  AnswerOf(*server);
  AnswerOf(*server);
  EXPECT_EQ(fits_, 1);
  const auto without = StartReplica(redis.address(), false);
  EXPECT_TRUE(WaitFor([&] { return Has(*without, ErrorsOf("connect", 1)); }));
  AnswerOf(*without);
  EXPECT_EQ(fits_, 2);
}

TEST_F(SharedCacheTest, NobodyThereFailsNoCall) {
  const auto server = StartReplica("127.0.0.1:1", false);
  AnswerOf(*server);
  EXPECT_TRUE(WaitFor([&] { return Has(*server, ErrorsOf("connect", 1)); }));
}

TEST(SharedCache, WrongSettingsAreNamed) {
  for (const auto& [address, problem] : std::vector<std::pair<std::string, std::string>>{
           {"redis:70000", "--cache-redis 'redis:70000' has port 70000"},
           {"a b", "--cache-redis 'a b' is no address"}}) {
    ServerConfig config;
    config.cache_redis = address;
    EXPECT_THAT(std::string(RedisOf(config).status().message()), HasSubstr(problem));
  }
  ServerConfig config;
  config.cache_redis = "[::1]";
  ASSERT_TRUE(RedisOf(config).ok());
  EXPECT_EQ(RedisOf(config)->host, "::1");
  EXPECT_EQ(RedisOf(config)->port, 6379);
  EXPECT_EQ(RedisOf(config)->answer_time, kRedisAnswerTime);
  config.cache_redis_seconds = 2.5;
  EXPECT_EQ(RedisOf(config)->answer_time, std::chrono::milliseconds(2500));
  config.cache_redis_password_file = "/nowhere";
  EXPECT_THAT(std::string(RedisOf(config).status().message()),
              HasSubstr("/nowhere cannot be read"));
}

}  // namespace
}  // namespace capfit::server
