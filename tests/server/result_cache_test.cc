#include "server/result_cache.h"

#include <gtest/gtest.h>

#include <atomic>
#include <string>

#include "tests/server/fake_fit.h"
#include "tests/server/service_call.h"

namespace capfit::server {
namespace {

constexpr std::int64_t kMebibyte = 1024 * 1024;

pipeline::FitResult ResultOfBytes(std::size_t bytes) {
  pipeline::FitResult result;
  result.vertex_gaps.resize(bytes / sizeof(float));
  return result;
}

TEST(ResultCache, KeepsWhatWasUsedLastWithinItsBytes) {
  ResultCache cache(4 * kMebibyte);
  const pipeline::FitResult result = ResultOfBytes(700'000);  // with the small parts 940 KiB
  for (const char* const key : {"a", "b", "c", "d"}) cache.Keep(key, result);
  EXPECT_NE(cache.Find("a"), nullptr);
  cache.Keep("e", result);
  EXPECT_EQ(cache.Find("b"), nullptr) << "the one that nobody asked for the longest";
  for (const char* const key : {"a", "c", "d", "e"}) EXPECT_NE(cache.Find(key), nullptr);
  EXPECT_LE(cache.bytes(), 4 * kMebibyte);
}

TEST(ResultCache, NeverKeepsWhatIsTooLargeAndNothingWhenOff) {
  ResultCache cache(4 * kMebibyte);
  cache.Keep("large", ResultOfBytes(1'000'000));
  EXPECT_EQ(cache.Find("large"), nullptr);
  ResultCache off(0);
  EXPECT_FALSE(off.is_on());
  off.Keep("any", ResultOfBytes(4));
  EXPECT_EQ(off.Find("any"), nullptr);
}

// The bits of all messages but progress.
std::string AnswerTo(Server& server, const std::vector<v1::ApproximateBodyRequest>& requests) {
  Call call(server);
  call.Send(requests);
  EXPECT_TRUE(call.Finish().ok());
  std::string bytes;
  for (const v1::ApproximateBodyResponse& response : call.responses) {
    if (!response.has_progress()) bytes += response.SerializeAsString();
  }
  return bytes;
}

TEST(ResultCache, TheSameRequestGetsTheSameBitsWithoutAFit) {
  std::atomic<int> fits{0};
  FitBackend backend = InstantBackend(5);
  backend.fit = [&fits, fit = backend.fit](const auto& soup, const auto& options, const auto& pool,
                                           FitObserver& observer) {
    ++fits;
    return fit(soup, options, pool, observer);
  };
  ServerConfig config;
  config.cache_bytes = 16 * kMebibyte;
  const auto server = StartServer(backend, config);
  const std::string first = AnswerTo(*server, {Header("id"), Chunk()});
  EXPECT_EQ(AnswerTo(*server, {Header("id"), Chunk()}), first);
  EXPECT_EQ(fits, 1);
  EXPECT_NE(server->MetricsText().find("\ncapfit_cache_hits_total{tier=\"memory\"} 1\n"),
            std::string::npos);
  // Another id is no other mesh; another mesh or option is.
  EXPECT_NE(AnswerTo(*server, {Header("other"), Chunk()}), first);
  EXPECT_EQ(fits, 1);
  v1::ApproximateBodyRequest moved = Chunk();
  moved.mutable_chunk()->mutable_arrays()->set_positions(0, 0.5F);
  AnswerTo(*server, {Header("id"), moved});
  EXPECT_EQ(fits, 2);
  v1::ApproximateBodyRequest seeded = Header("id");
  seeded.mutable_header()->mutable_options()->set_seed(5);
  AnswerTo(*server, {seeded, Chunk()});
  EXPECT_EQ(fits, 3);
}

TEST(ResultCache, WhatIsWrongIsRefusedWhateverWasKept) {
  ServerConfig config;
  config.cache_bytes = 16 * kMebibyte;
  const auto server = StartServer(InstantBackend(), config);
  AnswerTo(*server, {Header(), Chunk()});
  v1::ApproximateBodyRequest claims = Header();
  claims.mutable_header()->mutable_mesh()->mutable_arrays()->set_vertex_count(4);
  v1::ApproximateBodyRequest corners = Chunk();  // without the sizes of their faces
  v1::MeshArrays& arrays = *corners.mutable_chunk()->mutable_arrays();
  arrays.mutable_triangle_indices()->Swap(arrays.mutable_face_indices());
  for (const auto& requests : {std::vector{claims, Chunk()}, std::vector{Header(), corners}}) {
    Call call(*server);
    call.Send(requests);
    EXPECT_EQ(call.Finish().error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  }
}

TEST(ResultCache, WhoWantsAFreshFitGetsOneAndLeavesNoTrace) {
  std::atomic<int> fits{0};
  FitBackend backend = InstantBackend();
  backend.fit = [&fits, fit = backend.fit](const auto& soup, const auto& options, const auto& pool,
                                           FitObserver& observer) {
    ++fits;
    return fit(soup, options, pool, observer);
  };
  const auto server = StartServer(backend);
  for (int i = 0; i < 2; ++i) {
    Call call(LoopbackChannel(*server), {{"cache-control", "no-cache"}});
    call.Send({Header(), Chunk()});
    EXPECT_TRUE(call.Finish().ok());
  }
  EXPECT_EQ(fits, 2);
  AnswerTo(*server, {Header(), Chunk()});
  EXPECT_EQ(fits, 3) << "kept neither before";
  AnswerTo(*server, {Header(), Chunk()});
  EXPECT_EQ(fits, 3) << "kept by default";
}

}  // namespace
}  // namespace capfit::server
