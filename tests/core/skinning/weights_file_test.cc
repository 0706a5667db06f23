#include "core/skinning/weights_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <sstream>

#include "core/base/status.h"

namespace capfit::skinning {
namespace {

using testing::HasSubstr;

DenseWeights Sample() { return {2, 3, {0.5f, 0.25f, 0.25f, -1.0f, 1.5f, 0.5f}}; }

std::string Bytes(const DenseWeights& weights) {
  std::ostringstream out;
  EXPECT_TRUE(WriteWeightsData(weights, out).ok());
  return out.str();
}

absl::StatusOr<DenseWeights> Read(const std::string& bytes, std::size_t spheres = 2,
                                  std::size_t vertices = 3) {
  std::istringstream in(bytes);
  return ReadWeightsData({spheres, vertices, "x"}, in);
}

std::string Header(const std::string& from, const std::string& to) {
  std::string text = FormatWeightsHeader(Sample(), "body.weights.f32");
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(WeightsFileTest, ReturnsWhatWasWritten) {
  const auto header = ParseWeightsHeader(FormatWeightsHeader(Sample(), "body.weights.f32"));
  ASSERT_TRUE(header.ok()) << header.status();
  EXPECT_EQ(header->data_file, "body.weights.f32");
  EXPECT_EQ(header->data_bytes(), 24u);
  std::istringstream in(Bytes(Sample()));
  const auto weights = ReadWeightsData(*header, in);
  ASSERT_TRUE(weights.ok()) << weights.status();
  EXPECT_EQ(weights->sphere_count, 2u);
  EXPECT_EQ(weights->vertex_count, 3u);
  EXPECT_EQ(weights->weights, Sample().weights);
}

TEST(WeightsFileTest, NumbersAreLittleEndianRows) {
  const std::string bytes = Bytes(Sample());
  ASSERT_EQ(bytes.size(), 24u);
  EXPECT_EQ(bytes.substr(0, 8), std::string("\x00\x00\x00\x3f\x00\x00\x80\x3e", 8));  // 0.5, 0.25
  EXPECT_EQ(bytes.substr(12, 4), std::string("\x00\x00\x80\xbf", 4));                 // -1
}

TEST(WeightsFileTest, LongRowsPassThroughInChunks) {
  DenseWeights weights{3, 70'001, {}};
  for (std::size_t i = 0; i < 3 * 70'001; ++i) weights.weights.push_back(1.0f / (1.0f + i));
  const auto back = Read(Bytes(weights), 3, 70'001);
  ASSERT_TRUE(back.ok()) << back.status();
  EXPECT_EQ(back->weights, weights.weights);
}

TEST(WeightsFileTest, EmptyWeightsAreAnEmptyFile) {
  EXPECT_EQ(Bytes({0, 5, {}}), "");
  EXPECT_TRUE(Read("", 0, 5).ok());
}

TEST(WeightsFileTest, RefusesTruncatedAndOversizedData) {
  const std::string bytes = Bytes(Sample());
  for (const std::size_t size : {std::size_t{0}, std::size_t{23}, std::size_t{4}}) {
    const auto read = Read(bytes.substr(0, size));
    ASSERT_EQ(read.status().code(), absl::StatusCode::kInvalidArgument);
    EXPECT_THAT(read.status().ToString(),
                HasSubstr("hold " + std::to_string(size) + " bytes, must hold 24"));
  }
  EXPECT_THAT(Read(bytes + "x").status().ToString(), HasSubstr("must hold 24 (2 spheres x 3"));
}

TEST(WeightsFileTest, HugeCountsInTheHeaderDoNotAllocate) {
  const auto read = Read("1234", 60'000, 60'000);
  EXPECT_THAT(read.status().ToString(), HasSubstr("hold 4 bytes"));
  EXPECT_EQ(ReasonOf(read.status()), ErrorReason::kCountMismatch);
}

TEST(WeightsFileTest, RefusesNumbersThatAreNotFinite) {
  DenseWeights weights = Sample();
  weights.weights[5] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(Read(Bytes(weights)).status().ToString(), HasSubstr("weights[1][2]"));
  EXPECT_EQ(ReasonOf(Read(Bytes(weights)).status()), ErrorReason::kNotFinite);
}

TEST(WeightsFileTest, ReportsAStreamThatFails) {
  std::ostringstream out;
  out.setstate(std::ios::badbit);
  EXPECT_EQ(WriteWeightsData(Sample(), out).code(), absl::StatusCode::kDataLoss);
}

TEST(WeightsHeaderTest, NamesWhatIsWrong) {
  const auto error = [](const std::string& text) {
    return ParseWeightsHeader(text).status().ToString();
  };
  EXPECT_THAT(error("not json"), HasSubstr("one JSON object"));
  EXPECT_THAT(error("[1]"), HasSubstr("one JSON object"));
  EXPECT_THAT(error(Header("capfit-dense-weights", "other")), HasSubstr("\"other\""));
  EXPECT_THAT(error(Header("\"version\": 1", "\"version\": 2")), HasSubstr("version is 2"));
  EXPECT_THAT(error(Header("float32", "float64")), HasSubstr("must be \"float32\""));
  EXPECT_THAT(error(Header("little", "big")), HasSubstr("must be \"little\""));
  EXPECT_THAT(error(Header("\"spheres\": 2", "\"spheres\": -2")), HasSubstr("spheres is -2"));
  EXPECT_THAT(error(Header("\"spheres\": 2", "\"spheres\": \"2\"")), HasSubstr("whole number"));
  EXPECT_THAT(error(Header("\"vertices\": 3", "\"vertices\": 1e3")), HasSubstr("whole number"));
  EXPECT_THAT(error(Header("\"vertices\": 3", "\"vertices\": 4294967296")),
              HasSubstr("must be in [0, 2147483647]"));
  EXPECT_THAT(error(Header("\"spheres\": 2,\n  \"vertices\": 3",
                           "\"spheres\": 2000000000,\n  \"vertices\": 2000000000")),
              HasSubstr("more than"));
  EXPECT_THAT(error(Header("\"data\"", "\"dada\"")), HasSubstr("data is missing"));
}

TEST(WeightsHeaderTest, TellsReasons) {
  const auto reason = [](const std::string& text) {
    const auto found = ReasonOf(ParseWeightsHeader(text).status());
    return std::string(found ? ErrorReasonName(*found) : "none");
  };
  EXPECT_EQ(reason("not json"), "MALFORMED_FILE");
  EXPECT_EQ(reason(Header("\"data\"", "\"dada\"")), "MISSING");
  EXPECT_EQ(reason(Header("\"version\": 1", "\"version\": 2")), "UNSUPPORTED_FILE");
  EXPECT_EQ(reason(Header("float32", "float64")), "UNSUPPORTED_FILE");
  EXPECT_EQ(reason(Header("\"spheres\": 2", "\"spheres\": -2")), "MALFORMED_FILE");
  EXPECT_EQ(reason(Header("\"vertices\": 3", "\"vertices\": 4294967296")), "OUT_OF_RANGE");
  EXPECT_EQ(reason(Header("\"spheres\": 2,\n  \"vertices\": 3",
                          "\"spheres\": 2000000000,\n  \"vertices\": 2000000000")),
            "TOO_LARGE");
}

}  // namespace
}  // namespace capfit::skinning
