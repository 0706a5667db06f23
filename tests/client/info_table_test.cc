#include "client/info_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace capfit::client {
namespace {

using testing::HasSubstr;

TEST(InfoTable, TellsLimitsFormatsEnginesAndFeaturesInWords) {
  v1::GetServerInfoResponse info;
  info.set_version("1.2.3");
  info.mutable_limits()->set_max_upload_bytes(64 << 20);
  info.mutable_limits()->set_max_message_bytes(3 << 19);
  info.mutable_limits()->set_max_vertices(2'000'000);
  info.add_formats(v1::MESH_FILE_FORMAT_OBJ);
  info.add_formats(v1::MESH_FILE_FORMAT_GLB);
  v1::Engine& engine = *info.add_engines();
  engine.set_name("nvcloth");
  engine.set_max_spheres(32);
  engine.set_profile(v1::CAPSULE_PROFILE_TANGENT_HULL);
  for (const char* const feature : {"call.unary", "quality.paper", "quality.tight", "odd"}) {
    info.add_features(feature);
  }
  const std::string table = InfoTable(info);
  EXPECT_THAT(table, HasSubstr("capfit-server 1.2.3\n"));
  EXPECT_THAT(table, HasSubstr("one mesh                   64 MiB\n"));
  EXPECT_THAT(table, HasSubstr("one message               1.5 MiB\n"));
  EXPECT_THAT(table, HasSubstr("vertices                  2000000\n"));
  EXPECT_THAT(table, HasSubstr("mesh files: obj, glb\n"));
  EXPECT_THAT(table, HasSubstr("nvcloth                32         -       -  tangent_hull\n"));
  EXPECT_THAT(table, HasSubstr("  quality    paper, tight\n"));
  EXPECT_THAT(table, HasSubstr("  other      odd\n"));
}

}  // namespace
}  // namespace capfit::client
