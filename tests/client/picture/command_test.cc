#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "client/picture/file_bytes.h"
#include "client/picture/gaps_file.h"
#include "client/picture/mannequin_command.h"
#include "client/picture/render_command.h"
#include "core/formats/read_mesh.h"
#include "tests/support/scratch.h"

namespace capfit::client {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class CommandTest : public testing::Test {
 protected:
  [[nodiscard]] std::string Path(const std::string& name) const { return scratch_.Path(name); }

  // The exit code of the subcommand; CLI11's own errors count as 100 and more.
  static int Run(std::vector<std::string> words) {
    CLI::App app("capfit");
    int exit_code = -1;
    AddMannequinCommand(app, exit_code);
    AddRenderCommand(app, exit_code);
    std::reverse(words.begin(), words.end());
    try {
      app.parse(words);
    } catch (const CLI::ParseError& error) {
      return error.get_exit_code();
    }
    return exit_code;
  }
  static formats::PolygonSoup ReadSoup(const std::string& path) {
    const std::string bytes = *ReadFileBytes(path);
    auto soup =
        formats::ReadMesh(std::as_bytes(std::span(bytes)), formats::FormatFromFileName(path));
    EXPECT_TRUE(soup.ok()) << soup.status();
    return soup.ok() ? *soup : formats::PolygonSoup();
  }
  void WriteResult() const {
    ASSERT_TRUE(WriteFileBytes(Path("r.json"), R"({"spheres": [[0, 0.9, 0, 0.2], [0, 1.3, 0, 0.2]],
                                                  "capsules": [[0, 1]]})")
                    .ok());
  }

  const test_support::Scratch scratch_;
};

TEST_F(CommandTest, ObjAndPlyHoldTheSameMannequin) {
  ASSERT_EQ(Run({"mannequin", "-o", Path("b.obj"), "--faces", "3000", "--sex", "male"}), 0);
  ASSERT_EQ(Run({"mannequin", "-o", Path("b.PLY"), "--faces", "3000", "--sex", "male"}), 0);
  const formats::PolygonSoup obj = ReadSoup(Path("b.obj"));
  const formats::PolygonSoup ply = ReadSoup(Path("b.PLY"));
  ASSERT_EQ(obj.positions.size(), ply.positions.size());
  EXPECT_EQ(obj.face_vertices, ply.face_vertices);
  EXPECT_EQ(obj.face_sizes, ply.face_sizes);
  for (std::size_t i = 0; i < obj.positions.size(); ++i) {
    ASSERT_LT((obj.positions[i] - ply.positions[i]).norm(), 1e-7);
  }
}

TEST_F(CommandTest, PartsAndTrianglesAreHonoured) {
  ASSERT_EQ(Run({"mannequin", "-o", Path("b.obj"), "--faces", "4000", "--triangles", "--parts",
                 "torso,arms,legs"}),
            0);
  const formats::PolygonSoup soup = ReadSoup(Path("b.obj"));
  EXPECT_EQ(soup.face_vertices.size() % 3, 0u);
  for (const Eigen::Vector3d& p : soup.positions) EXPECT_LT(p.y(), 1.6);
}

TEST_F(CommandTest, RefusesWhatItCannotDo) {
  testing::internal::CaptureStderr();
  EXPECT_EQ(Run({"mannequin", "-o", Path("b.stl")}), 2);
  EXPECT_EQ(Run({"mannequin", "-o", Path("b.obj"), "--height-m", "3"}), 2);
  EXPECT_EQ(Run({"mannequin", "-o", Path("b.obj"), "--parts", "torso,head"}), 2);
  EXPECT_EQ(Run({"mannequin", "-o", Path("no/such/folder/b.obj")}), 1);
  EXPECT_GE(Run({"mannequin", "-o", Path("b.obj"), "--sex", "robot"}), 100);
  EXPECT_GE(Run({"mannequin"}), 100);
  const std::string errors = testing::internal::GetCapturedStderr();
  EXPECT_THAT(errors, HasSubstr("must end in .obj or .ply"));
  EXPECT_THAT(errors, HasSubstr("--height-m is 3, must be in [0.8, 2.3]"));
  EXPECT_THAT(errors, HasSubstr("--parts must name arms"));
  EXPECT_THAT(errors, HasSubstr("cannot write"));
}

TEST_F(CommandTest, RendersStillsHeatAndTheBodyAlone) {
  ASSERT_EQ(Run({"mannequin", "-o", Path("b.obj"), "--faces", "2000"}), 0);
  WriteResult();
  const std::vector<std::string> size = {"--width", "400", "--height", "400"};
  const auto render = [&](std::vector<std::string> words) {
    words.insert(words.end(), size.begin(), size.end());
    return Run(words);
  };
  EXPECT_EQ(render({"render", Path("b.obj"), Path("r.json"), "-o", Path("p.png")}), 0);
  EXPECT_THAT(*ReadFileBytes(Path("p.png")), StartsWith("\x89PNG"));
  EXPECT_EQ(render({"render", Path("b.obj"), Path("r.json"), "-o", Path("h.svg"), "--heat"}), 0);
  EXPECT_THAT(*ReadFileBytes(Path("h.svg")), HasSubstr("</svg>"));
  EXPECT_EQ(render({"render", Path("b.obj"), "-o", Path("a.png"), "--views", "Front,BACK"}), 0);
}

TEST_F(CommandTest, PolygonsAreDrawnWhereTheResultHasThem) {
  ASSERT_EQ(Run({"mannequin", "-o", Path("b.obj"), "--faces", "2000"}), 0);
  ASSERT_TRUE(WriteFileBytes(Path("p.json"), R"({"spheres": [[0, 0.9, 0, 0.2]],
      "feature_polygons": [{"name": "hip", "part": "torso", "outside_area_ratio": 0.1,
        "outline": [[-0.1, 0.9, -0.1], [0.1, 0.9, -0.1], [0.1, 0.9, 0.1], [-0.1, 0.9, 0.1]],
        "circles": [[0, 0.9, 0, 0.1]]}]})")
                  .ok());
  const auto render = [&](const std::string& result, const std::string& output,
                          std::vector<std::string> more) {
    std::vector<std::string> words = {"render",     Path("b.obj"), Path(result), "-o",
                                      Path(output), "--width",     "400",        "--polygons"};
    words.insert(words.end(), more.begin(), more.end());
    return Run(words);
  };
  EXPECT_EQ(render("p.json", "p.png", {}), 0);
  EXPECT_THAT(*ReadFileBytes(Path("p.png")), StartsWith("\x89PNG"));
  EXPECT_EQ(render("p.json", "p.svg", {"--views", "front"}), 0);
  EXPECT_THAT(*ReadFileBytes(Path("p.svg")), HasSubstr("stroke-dasharray"));
  WriteResult();
  ASSERT_TRUE(WriteFileBytes(Path("flat.json"), R"({"spheres": [[0, 0.9, 0, 0.2]],
      "feature_polygons": [{"outline": [[0, 0.9, 0], [1, 0.9, 0]], "circles": []}]})")
                  .ok());
  testing::internal::CaptureStderr();
  EXPECT_EQ(render("r.json", "p.png", {}), 2);
  EXPECT_EQ(render("flat.json", "p.png", {}), 2);
  EXPECT_EQ(render("p.json", "p.png", {"--heat"}), 2);
  const std::string errors = testing::internal::GetCapturedStderr();
  EXPECT_THAT(errors, HasSubstr("`capfit approximate --polygons` writes them"));
  EXPECT_THAT(errors, HasSubstr("feature_polygons[0].outline has 2 points"));
  EXPECT_THAT(errors, HasSubstr("not with --heat"));
}

TEST_F(CommandTest, HeatMapShowsTheGapsOfTheFile) {
  ASSERT_EQ(Run({"mannequin", "-o", Path("b.obj"), "--faces", "2000"}), 0);
  WriteResult();
  const auto render = [&](float gap) {
    const std::vector<float> gaps(ReadSoup(Path("b.obj")).positions.size(), gap);
    EXPECT_TRUE(WriteVertexGaps(gaps, 1.0, Path("r.json")).ok());
    EXPECT_EQ(Run({"render", Path("b.obj"), Path("r.json"), "-o", Path("h.png"), "--gaps",
                   Path("r.gaps.json"), "--width", "300", "--height", "300", "--views", "front"}),
              0);
    return *ReadFileBytes(Path("h.png"));
  };
  const std::string covered = render(-0.02F);
  EXPECT_EQ(covered, render(-0.02F));
  EXPECT_NE(covered, render(0.02F));
  EXPECT_NE(covered, render(std::numeric_limits<float>::quiet_NaN()));
  ASSERT_TRUE(WriteVertexGaps(std::vector<float>(7), 1.0, Path("r.json")).ok());
  testing::internal::CaptureStderr();
  EXPECT_EQ(Run({"render", Path("b.obj"), Path("r.json"), "-o", Path("h.png"), "--gaps",
                 Path("r.gaps.json")}),
            2);
  EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("--gaps has 7 vertices"));
}

TEST_F(CommandTest, RendersFramesOfAnAnimation) {
  ASSERT_EQ(Run({"mannequin", "-o", Path("b.obj"), "--faces", "2000"}), 0);
  WriteResult();
  const std::size_t vertices = ReadSoup(Path("b.obj")).positions.size();
  ASSERT_TRUE(WriteFileBytes(Path("f.bin"), std::string(2 * vertices * 12, '\0')).ok());
  ASSERT_TRUE(WriteFileBytes(Path("c.bin"), std::string(2 * 2 * 12, '\0')).ok());
  const auto render = [&](const std::string& show, const std::string& frames) {
    return Run({"render", Path("b.obj"), Path("r.json"), "-o", Path("p.png"), "--frames",
                Path(frames), "--centers", Path("c.bin"), "--show", show, "--width", "300",
                "--height", "300"});
  };
  EXPECT_EQ(render("0,1", "f.bin"), 0);
  testing::internal::CaptureStderr();
  EXPECT_EQ(render("2", "f.bin"), 2);
  EXPECT_EQ(render("0", "c.bin"), 2);
  EXPECT_EQ(render("0", "none.bin"), 1);
  const std::string errors = testing::internal::GetCapturedStderr();
  EXPECT_THAT(errors, HasSubstr("--show has frame 2, must be below 2"));
  EXPECT_THAT(errors, HasSubstr("must be a multiple of"));
}

TEST_F(CommandTest, RendersFramesWithRadiiOfTheirOwn) {
  ASSERT_EQ(Run({"mannequin", "-o", Path("b.obj"), "--faces", "2000"}), 0);
  WriteResult();
  const std::size_t vertices = ReadSoup(Path("b.obj")).positions.size();
  ASSERT_TRUE(WriteFileBytes(Path("f.bin"), std::string(vertices * 12, '\0')).ok());
  ASSERT_TRUE(WriteFileBytes(Path("c.bin"), std::string(2 * 12, '\0')).ok());
  const auto render = [&](const std::string& radii) {
    EXPECT_TRUE(WriteFileBytes(Path("r.radii.json"), radii).ok());
    return Run({"render", Path("b.obj"), Path("r.json"), "-o", Path("p.png"), "--frames",
                Path("f.bin"), "--centers", Path("c.bin"), "--radii", Path("r.radii.json"),
                "--show", "0", "--width", "300", "--height", "300"});
  };
  ASSERT_EQ(render(R"({"frames": [[0.2, 0.3]]})"), 0);
  const std::string small = *ReadFileBytes(Path("p.png"));
  ASSERT_EQ(render(R"({"frames": [[0.2, 0.6]]})"), 0);
  EXPECT_NE(small, *ReadFileBytes(Path("p.png")));
  testing::internal::CaptureStderr();
  EXPECT_EQ(render(R"({"frames": [[0.2, 0]]})"), 2);
  EXPECT_EQ(render(R"({"frames": [[0.2]]})"), 2);
  const std::string errors = testing::internal::GetCapturedStderr();
  EXPECT_THAT(errors, HasSubstr("radii[0][1] must be above 0"));
  EXPECT_THAT(errors, HasSubstr("must be a multiple of 8"));
}

TEST_F(CommandTest, RenderRefusesBadInput) {
  ASSERT_EQ(Run({"mannequin", "-o", Path("b.obj"), "--faces", "2000"}), 0);
  WriteResult();
  ASSERT_TRUE(WriteFileBytes(Path("bad.json"), R"({"spheres": [[0]]})").ok());
  testing::internal::CaptureStderr();
  EXPECT_EQ(Run({"render", Path("b.obj"), Path("r.json"), "-o", Path("p.jpg")}), 2);
  EXPECT_EQ(Run({"render", Path("b.obj"), Path("bad.json"), "-o", Path("p.png")}), 2);
  EXPECT_EQ(Run({"render", Path("b.obj"), "-o", Path("p.png"), "--heat"}), 2);
  EXPECT_EQ(Run({"render", Path("b.obj"), Path("r.json"), "-o", Path("p.png"), "--width", "9"}), 2);
  EXPECT_EQ(Run({"render", Path("none.obj"), Path("r.json"), "-o", Path("p.png")}), 1);
  const std::string errors = testing::internal::GetCapturedStderr();
  EXPECT_THAT(errors, HasSubstr("spheres[0]"));
  EXPECT_THAT(errors, HasSubstr("--width is 9, must be in [200, 6000]"));
}

}  // namespace
}  // namespace capfit::client
