#include "proto/wire/result_collector.h"

#include <gtest/gtest.h>

#include <vector>

#include "server/response_sequence.h"
#include "tests/server/fake_fit.h"

namespace capfit::wire {
namespace {

using Response = v1::ApproximateBodyResponse;

std::vector<Response> Answer(std::size_t vertex_count, std::size_t max_weights) {
  server::ResponseSequence sequence(server::HandMadeResult(vertex_count), "id", max_weights);
  std::vector<Response> responses;
  Response response;
  while (sequence.Next(response)) responses.push_back(response);
  return responses;
}

absl::StatusOr<pipeline::FitResult> Collect(const std::vector<Response>& responses) {
  ResultCollector collector({});
  for (const Response& response : responses) {
    if (const absl::Status status = collector.Add(response); !status.ok()) return status;
  }
  return std::move(collector).Finish();
}

TEST(ResultCollector, GivesBackWhatTheServerHad) {
  const pipeline::FitResult sent = server::HandMadeResult(7);
  for (const std::size_t max_weights : {2U, 7U, 1000U}) {
    const auto result = Collect(Answer(7, max_weights));
    ASSERT_TRUE(result.ok()) << result.status();
    EXPECT_EQ(result->primitives.capsules, sent.primitives.capsules);
    EXPECT_EQ(result->primitives.spheres[0].center_m, sent.primitives.spheres[0].center_m);
    EXPECT_EQ(result->weights->weights, sent.weights->weights);
    ASSERT_EQ(result->vertex_gaps.size(), 7U);
    EXPECT_EQ(result->vertex_gaps[6], sent.vertex_gaps[6]);
    EXPECT_EQ(result->warnings.size(), 1U);
    EXPECT_EQ(result->landmarks.size(), 2U);
    EXPECT_EQ(result->polygons.size(), 1U);
    EXPECT_EQ(result->metrics.E_r, sent.metrics.E_r);
  }
}

TEST(ResultCollector, PassesProgressOn) {
  std::vector<double> fractions;
  ResultCollector collector([&](Stage, double done) { fractions.push_back(done); });
  Response response;
  response.mutable_progress()->set_stage(v1::STAGE_CIRCLE);
  response.mutable_progress()->set_fraction_done(0.25);
  ASSERT_TRUE(collector.Add(response).ok());
  response.mutable_progress()->set_fraction_done(0.5);
  ASSERT_TRUE(collector.Add(response).ok());
  EXPECT_EQ(fractions, (std::vector<double>{0.25, 0.5}));
}

TEST(ResultCollector, EveryLostDoubledOrSwappedMessageIsNoticedOrHarmless) {
  const std::vector<Response> answer = Answer(7, 4);
  for (std::size_t i = 0; i < answer.size(); ++i) {
    const bool is_essential =
        answer[i].has_summary() || answer[i].has_skinning() || answer[i].has_vertex_gaps();
    std::vector<Response> lost = answer;
    lost.erase(lost.begin() + static_cast<std::ptrdiff_t>(i));
    // The weights' first block tells the size, so only a wholly missing matrix goes unnoticed.
    EXPECT_EQ(Collect(lost).ok(), !is_essential) << "without message " << i;
    std::vector<Response> doubled = answer;
    doubled.insert(doubled.begin() + static_cast<std::ptrdiff_t>(i), answer[i]);
    const bool may_repeat = answer[i].has_warning() || answer[i].has_feature_polygon();
    EXPECT_EQ(Collect(doubled).ok(), may_repeat) << "message " << i << " twice";
  }
  std::vector<Response> swapped = answer;
  std::swap(swapped.front(), swapped.back());
  EXPECT_EQ(Collect(swapped).status().code(), absl::StatusCode::kInternal);
  EXPECT_FALSE(Collect({}).ok());
}

TEST(ResultCollector, PartsOfALaterContractAreIgnored) {
  std::vector<Response> answer = Answer(0, 1);
  answer.insert(answer.begin() + 1, Response());
  EXPECT_TRUE(Collect(answer).ok());
}

}  // namespace
}  // namespace capfit::wire
