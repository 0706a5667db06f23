#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "core/base/status.h"
#include "core/export/export.h"

namespace capfit::exports {
namespace {

ColliderSet OneCapsule() {
  ColliderSet set;
  set.primitives.spheres = {{Eigen::Vector3d(0, 1, 0), 0.1}, {Eigen::Vector3d(0, 1.4, 0), 0.15}};
  set.primitives.origins.resize(2);
  set.primitives.capsules = {{0, 1}};
  set.sphere_names = {"waist_1", "chest_1"};
  set.source = "somebody";
  set.version = "1.2.3";
  return set;
}

TEST(ExportFormats, HaveNamesOfTheirOwnAndALineEach) {
  std::set<std::string> names;
  for (const ExportFormat& format : ExportFormats()) {
    EXPECT_TRUE(names.insert(std::string(format.name)).second) << std::string(format.name);
    EXPECT_FALSE(format.summary.empty());
    EXPECT_EQ(FindExportFormat(format.name), &format);
    EXPECT_THAT(ExportFormatNames(), testing::HasSubstr(std::string(format.name)));
  }
  EXPECT_EQ(FindExportFormat("fbx"), nullptr);
}

TEST(ExportFormats, EachWritesFilesWithBytesAndDistinctNames) {
  std::set<std::string> files;
  for (const ExportFormat& format : ExportFormats()) {
    if (format.needs_original) continue;
    const auto exported = Export(OneCapsule(), std::string(format.name), {});
    ASSERT_TRUE(exported.ok()) << std::string(format.name) << exported.status();
    EXPECT_FALSE(exported->files.empty());
    for (const ExportFile& file : exported->files) {
      EXPECT_FALSE(file.bytes.empty()) << file.name;
      EXPECT_EQ(file.name.find('/'), std::string::npos);
      EXPECT_TRUE(files.insert(file.name).second) << file.name;
    }
  }
}

TEST(ExportFormats, SaysWhatIsWrong) {
  EXPECT_EQ(FieldOf(Export(OneCapsule(), "fbx", {}).status()), "format");
  EXPECT_EQ(FieldOf(Export(OneCapsule(), "vrm", {}).status()), "original");
  EXPECT_EQ(FieldOf(Export(OneCapsule(), "mujoco", {}, {.max_overshoot_m = 2.0}).status()),
            "max_overshoot_m");
  ColliderSet set = OneCapsule();
  set.sphere_names.pop_back();
  EXPECT_EQ(FieldOf(Export(set, "csv", {}).status()), "sphere_names");
}

}  // namespace
}  // namespace capfit::exports
