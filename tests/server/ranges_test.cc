// Every range that the contract's comments state, held against a real server with the real
// pipeline: what lies within is taken, what lies beyond is refused by field, value and limit.
#include <gmock/gmock.h>
#include <google/protobuf/message.h>
#include <grpcpp/client_context.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "capfit/v1/service.grpc.pb.h"
#include "core/base/status.h"
#include "core/mannequin/mannequin.h"
#include "proto/wire/status_conversion.h"
#include "server/server.h"
#include "tests/server/documented_ranges.h"

namespace capfit::server {
namespace {

using Request = v1::ApproximateBodyUnaryRequest;
using Response = v1::ApproximateBodyUnaryResponse;

const std::string kProtos = CAPFIT_PROTO_FOLDER;

// A sound mesh that is no body: what passes all checks of the request ends as NOT_A_BODY.
Request Tetrahedron() {
  Request request;
  v1::MeshArrays& arrays = *request.mutable_mesh()->mutable_arrays();
  for (const float x : {0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F}) {
    arrays.add_positions(x);
  }
  for (const std::uint32_t i : {0U, 2U, 1U, 0U, 1U, 3U, 0U, 3U, 2U, 1U, 2U, 3U}) {
    arrays.add_triangle_indices(i);
  }
  return request;
}

// The same with faces by size and corners.
Request Polygons(std::uint32_t first_size) {
  Request request = Tetrahedron();
  v1::MeshArrays& arrays = *request.mutable_mesh()->mutable_arrays();
  arrays.mutable_face_indices()->Swap(arrays.mutable_triangle_indices());
  for (const std::uint32_t size : {first_size, 3U, 3U, 3U}) arrays.add_face_sizes(size);
  arrays.mutable_face_indices()->Resize(static_cast<int>(first_size) + 9, 0);
  return request;
}

class RangesTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    ServerConfig config;
    config.listen = "127.0.0.1:0";
    server_ = Server::Start(config, {pipeline::ValidateOptions, pipeline::Fit}).value().release();
  }
  static void TearDownTestSuite() { delete server_; }

  static absl::StatusOr<Response> Ask(const Request& request) {
    grpc::ClientContext context;
    Response response;
    const auto stub = v1::BodyApproximationService::NewStub(server_->InProcessChannel());
    const grpc::Status status = stub->ApproximateBodyUnary(&context, request, &response);
    if (!status.ok()) return wire::FromGrpcStatus(status);
    return response;
  }
  // One streamed call of a header alone.
  static absl::Status Send(const v1::MeshHeader& mesh) {
    grpc::ClientContext context;
    const auto stub = v1::BodyApproximationService::NewStub(server_->InProcessChannel());
    const auto stream = stub->ApproximateBody(&context);
    v1::ApproximateBodyRequest first;
    *first.mutable_header()->mutable_mesh() = mesh;
    stream->Write(first);
    stream->WritesDone();
    return wire::FromGrpcStatus(stream->Finish());
  }

  static Server* server_;
};
Server* RangesTest::server_ = nullptr;

// One row of the table: a field, its documented range, values at and beyond the ends.
struct Row {
  std::string field;  // "Message.field" in the proto
  std::string range;  // as its comment has it
  std::string path;   // as errors name it
  std::function<absl::Status(double)> send;
  std::vector<double> within;
  std::vector<double> beyond;
};

std::vector<Row> Rows(const std::function<absl::Status(const Request&)>& call,
                      const std::function<absl::Status(const v1::MeshHeader&)>& header) {
  const auto option = [call](const std::function<void(v1::FitOptions&, double)>& set) {
    return [call, set](double value) {
      Request request = Tetrahedron();
      set(*request.mutable_options(), value);
      return call(request);
    };
  };
  const auto arrays = [call](const std::function<void(v1::MeshArrays&, double)>& set) {
    return [call, set](double value) {
      Request request = Tetrahedron();
      set(*request.mutable_mesh()->mutable_arrays(), value);
      return call(request);
    };
  };
  const UploadLimits limits;
  const auto most_vertices = static_cast<double>(limits.mesh.max_vertices);
  const auto most_faces = static_cast<double>(limits.mesh.max_faces);
  const auto most_bytes = static_cast<double>(limits.max_bytes);
  return {
      {"Budget.max_primitives",
       "[15, 1000]",
       "options.budget.max_primitives",
       option([](v1::FitOptions& o, double v) {
         o.mutable_budget()->set_max_primitives(static_cast<int>(v));
       }),
       {15, 64, 1000},
       {-1, 0, 14, 1001}},
      {"ExportRequest.max_overshoot_m",
       "[0.0002, 0.5]",
       "exports[0].max_overshoot_m",
       [call](double value) {
         Request request = Tetrahedron();
         request.add_exports()->set_format("csv");
         request.mutable_exports(0)->set_max_overshoot_m(value);
         return call(request);
       },
       {0.0002, 0.005, 0.5},
       {-1, 0, 0.0001, 0.6, std::numeric_limits<double>::quiet_NaN()}},
      {"SphereAndCapsuleLimit.max_spheres",
       "[10, 500]",
       "options.budget.spheres_and_capsules.max_spheres",
       option([](v1::FitOptions& o, double v) {
         o.mutable_budget()->mutable_spheres_and_capsules()->set_max_spheres(static_cast<int>(v));
       }),
       {10, 500},
       {-1, 0, 9, 501}},
      {"SphereAndCapsuleLimit.max_capsules",
       "[5, 1000]",
       "options.budget.spheres_and_capsules.max_capsules",
       option([](v1::FitOptions& o, double v) {
         o.mutable_budget()->mutable_spheres_and_capsules()->set_max_capsules(static_cast<int>(v));
       }),
       {5, 1000},
       {-1, 0, 4, 1001}},
      {"Budget.max_polygon_error",
       "[0.001, 2]",
       "options.budget.max_polygon_error",
       option([](v1::FitOptions& o, double v) { o.mutable_budget()->set_max_polygon_error(v); }),
       {0.001, 2},
       {-1, 0, 0.000999, 2.001, std::numeric_limits<double>::quiet_NaN()}},
      {"FitOptions.tolerance_m",
       "[0, 0.1]",
       "options.tolerance_m",
       option([](v1::FitOptions& o, double v) { o.set_tolerance_m(v); }),
       {0, 0.1},
       {-0.001, 0.101, std::numeric_limits<double>::quiet_NaN()}},
      {"MeshArrays.positions",
       "[-1e12, 1e12]",
       "mesh.arrays.positions[4]",
       arrays([](v1::MeshArrays& a, double v) { a.set_positions(4, static_cast<float>(v)); }),
       {-1, 1},
       {-1.1e12, 1.1e12, std::numeric_limits<double>::quiet_NaN(),
        std::numeric_limits<double>::infinity()}},
      {"MeshArrays.positions_double",
       "[-1e12, 1e12]",
       "mesh.arrays.positions_double[4]",
       arrays([](v1::MeshArrays& a, double v) {
         a.mutable_positions_double()->Assign(a.positions().begin(), a.positions().end());
         a.clear_positions();
         a.set_positions_double(4, v);
       }),
       {-1, 1},
       {-1.1e12, 1.1e12, std::numeric_limits<double>::quiet_NaN()}},
      {"MeshArrays.triangle_indices",
       "[0, vertex count)",
       "mesh.arrays.triangle_indices[5]",
       arrays([](v1::MeshArrays& a, double v) {
         a.set_triangle_indices(5, static_cast<std::uint32_t>(v));
       }),
       {3},
       {4, 4294967295.0}},
      {"MeshArrays.face_sizes",
       "[3, max_corners_per_face of GetServerInfo]",
       "mesh.arrays.face_sizes[0]",
       [call](double v) { return call(Polygons(static_cast<std::uint32_t>(v))); },
       {3},
       {0, 1, 2, 1001}},
      {"MeshArrays.face_indices",
       "[0, vertex count)",
       "mesh.arrays.face_indices[2]",
       [call](double v) {
         Request request = Polygons(3);
         request.mutable_mesh()->mutable_arrays()->set_face_indices(2,
                                                                    static_cast<std::uint32_t>(v));
         return call(request);
       },
       {1},
       {4, 4294967295.0}},
      {"FileEncoding.byte_count",
       "[0, max_upload_bytes of GetServerInfo]",
       "mesh.file.byte_count",
       [header](double v) {
         v1::MeshHeader mesh;
         mesh.mutable_file()->set_byte_count(static_cast<std::int64_t>(v));
         return header(mesh);
       },
       {0, most_bytes},
       {-1, most_bytes + 1}},
      {"ArrayEncoding.vertex_count",
       "[0, max_vertices of GetServerInfo]",
       "mesh.arrays.vertex_count",
       [header](double v) {
         v1::MeshHeader mesh;
         mesh.mutable_arrays()->set_vertex_count(static_cast<int>(v));
         return header(mesh);
       },
       {0, most_vertices},
       {-1, most_vertices + 1}},
      {"ArrayEncoding.face_count",
       "[0, max_faces of GetServerInfo]",
       "mesh.arrays.face_count",
       [header](double v) {
         v1::MeshHeader mesh;
         mesh.mutable_arrays()->set_face_count(static_cast<int>(v));
         return header(mesh);
       },
       {0, most_faces},
       {-1, most_faces + 1}},
  };
}

TEST_F(RangesTest, WhatLiesWithinIsTakenAndWhatLiesBeyondIsRefused) {
  const auto call = [](const Request& request) { return Ask(request).status(); };
  for (const Row& row : Rows(call, Send)) {
    for (const double value : row.within) {
      const absl::Status status = row.send(value);
      EXPECT_NE(FieldOf(status), row.path) << row.field << " = " << value << ": " << status;
    }
    for (const double value : row.beyond) {
      const absl::Status status = row.send(value);
      EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument) << row.field << " = " << value;
      EXPECT_EQ(FieldOf(status), row.path) << status;
      EXPECT_THAT(ReasonOf(status),
                  testing::AnyOf(ErrorReason::kOutOfRange, ErrorReason::kNotFinite))
          << status;
      EXPECT_THAT(FactsOf(status), testing::Contains(testing::Key("limit"))) << status;
      EXPECT_THAT(FactsOf(status), testing::Contains(testing::Key("value"))) << status;
    }
  }
}

TEST_F(RangesTest, TheTableHasEveryRangeOfTheRequest) {
  std::map<std::string, std::string> table;
  const auto no_call = [](const auto&) { return absl::OkStatus(); };
  for (const Row& row : Rows(no_call, no_call)) table[row.field] = row.range;
  EXPECT_EQ(table, DocumentedRanges({kProtos + "/mesh.proto", kProtos + "/options.proto",
                                     kProtos + "/service.proto"}));
}

TEST_F(RangesTest, ARequestIdHas128BytesAtMost) {
  Request request = Tetrahedron();
  request.set_request_id(std::string(128, 'x'));
  EXPECT_NE(FieldOf(Ask(request).status()), "request_id");
  request.set_request_id(std::string(129, 'x'));
  EXPECT_EQ(FieldOf(Ask(request).status()), "request_id");
}

double NumberOf(const google::protobuf::Message& message,
                const google::protobuf::FieldDescriptor& field) {
  const google::protobuf::Reflection& reflection = *message.GetReflection();
  switch (field.cpp_type()) {
    case google::protobuf::FieldDescriptor::CPPTYPE_DOUBLE:
      return reflection.GetDouble(message, &field);
    case google::protobuf::FieldDescriptor::CPPTYPE_INT32:
      return reflection.GetInt32(message, &field);
    case google::protobuf::FieldDescriptor::CPPTYPE_INT64:
      return static_cast<double>(reflection.GetInt64(message, &field));
    default:
      ADD_FAILURE() << field.full_name() << " has a range and is no number";
      return 0.0;
  }
}

// Checks all numbers in `message` and below; counts how often each range was looked at.
void CheckRanges(const google::protobuf::Message& message,
                 const std::map<std::string, std::string>& ranges,
                 std::map<std::string, int>& seen) {
  const google::protobuf::Descriptor& type = *message.GetDescriptor();
  const google::protobuf::Reflection& reflection = *message.GetReflection();
  for (int i = 0; i < type.field_count(); ++i) {
    const google::protobuf::FieldDescriptor& field = *type.field(i);
    const auto range = ranges.find(type.name() + "." + field.name());
    if (range != ranges.end() && range->second.find("count") == std::string::npos) {
      EXPECT_TRUE(LiesIn(NumberOf(message, field), range->second))
          << field.full_name() << " is " << NumberOf(message, field) << ", promised "
          << range->second;
      ++seen[range->first];
    }
    if (field.cpp_type() != google::protobuf::FieldDescriptor::CPPTYPE_MESSAGE) continue;
    if (!field.is_repeated()) {
      if (reflection.HasField(message, &field)) {
        CheckRanges(reflection.GetMessage(message, &field), ranges, seen);
      }
      continue;
    }
    for (int k = 0; k < reflection.FieldSize(message, &field); ++k) {
      CheckRanges(reflection.GetRepeatedMessage(message, &field, k), ranges, seen);
    }
  }
}

TEST_F(RangesTest, RealAnswersKeepTheRangesOfTheResult) {
  const absl::StatusOr<formats::PolygonSoup> body = mannequin::MakeMannequin({});
  ASSERT_TRUE(body.ok());
  Request request;
  v1::MeshArrays& arrays = *request.mutable_mesh()->mutable_arrays();
  for (const Eigen::Vector3d& p : body->positions) {
    for (int axis = 0; axis < 3; ++axis) arrays.add_positions_double(p[axis]);
  }
  arrays.mutable_face_sizes()->Assign(body->face_sizes.begin(), body->face_sizes.end());
  auto& corners = body->face_sizes.empty() ? *arrays.mutable_triangle_indices()
                                           : *arrays.mutable_face_indices();
  corners.Assign(body->face_vertices.begin(), body->face_vertices.end());
  request.mutable_options()->set_want_feature_polygons(true);
  request.mutable_options()->set_want_vertex_gaps(true);
  const absl::StatusOr<Response> response = Ask(request);
  ASSERT_TRUE(response.ok()) << response.status();
  const std::map<std::string, std::string> ranges = DocumentedRanges({kProtos + "/result.proto"});
  std::map<std::string, int> seen;
  CheckRanges(*response, ranges, seen);
  for (const char* const field :
       {"Sphere.radius", "Circle.radius", "FeaturePolygon.outside_area_ratio",
        "Metrics.volume_error", "PartMetrics.volume_m3", "StageTime.seconds", "Similarity.scale"}) {
    EXPECT_GT(seen[field], 0) << field;
  }
  EXPECT_LE(response->primitives().spheres_size(), 500);
  EXPECT_EQ(response->vertex_gaps_size(), static_cast<int>(body->positions.size()));
}

}  // namespace
}  // namespace capfit::server
