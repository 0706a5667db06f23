#include "server/sealed_result.h"

#include <gtest/gtest.h>

#include "core/mannequin/mannequin.h"
#include "proto/wire/result_conversion.h"
#include "server/response_sequence.h"
#include "tests/server/fake_fit.h"

namespace capfit::server {
namespace {

const std::string kKey = "what it is the result of";
const std::string kSecret = "only replicas know";

// All that a caller gets, streamed and in one message.
std::string AnswerOf(const pipeline::FitResult& result) {
  std::string bytes = wire::ResultToWire(result, "id").SerializeAsString();
  ResponseSequence sequence(result, "id");
  v1::ApproximateBodyResponse response;
  while (sequence.Next(response)) bytes += response.SerializeAsString();
  return bytes;
}

class Uncancelled final : public FitObserver {
 public:
  void OnStage(Stage /*stage*/, double /*fraction_done*/) override {}
  [[nodiscard]] bool IsCancelled() const override { return false; }
};

pipeline::FitResult FitOf(const pipeline::FitOptions& options) {
  mannequin::MannequinOptions mannequin;
  mannequin.faces = 2000;
  const auto soup = mannequin::MakeMannequin(mannequin);
  EXPECT_TRUE(soup.ok());
  Uncancelled observer;
  auto result = pipeline::Fit(*soup, options, ThreadPool(2), observer);
  EXPECT_TRUE(result.ok()) << result.status();
  return *std::move(result);
}

TEST(SealedResult, GivesBackAllThatACallerGets) {
  pipeline::FitOptions rich;
  rich.skinning = pipeline::SkinningMode::kDense;
  rich.want_polygons = true;
  rich.want_vertex_gaps = true;
  rich.max_primitives = 40;
  pipeline::FitOptions engine;
  engine.engine = "unity_cloth";
  engine.skinning = pipeline::SkinningMode::kSparse;
  for (const pipeline::FitResult& result :
       {HandMadeResult(7), HandMadeResult(0), FitOf(rich), FitOf(engine)}) {
    const auto sealed = Seal(result, kKey, kSecret);
    ASSERT_TRUE(sealed);
    const auto back = Unseal(*sealed, kKey, kSecret);
    ASSERT_TRUE(back);
    EXPECT_TRUE(AnswerOf(*back) == AnswerOf(result));
  }
}

TEST(SealedResult, NothingElseIsTaken) {
  const std::string sealed = *Seal(HandMadeResult(3), kKey, kSecret);
  EXPECT_FALSE(Unseal(sealed, "another body", kSecret));
  EXPECT_FALSE(Unseal(sealed, kKey, ""));
  EXPECT_FALSE(Unseal(sealed + "x", kKey, kSecret));
  for (std::size_t size = 0; size < sealed.size(); size += 7) {
    EXPECT_FALSE(Unseal(sealed.substr(0, size), kKey, kSecret)) << size;
  }
  for (std::size_t i = 0; i < sealed.size(); i += 5) {
    std::string changed = sealed;
    changed[i] = static_cast<char>(changed[i] ^ 1);
    EXPECT_FALSE(Unseal(changed, kKey, kSecret)) << i;
  }
}

}  // namespace
}  // namespace capfit::server
