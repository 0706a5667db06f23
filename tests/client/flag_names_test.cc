#include "client/flag_names.h"

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <set>
#include <string>

#include "capfit/v1/options.pb.h"
#include "client/approximate_command.h"
#include "client/info_command.h"
#include "client/picture/mannequin_command.h"
#include "client/picture/render_command.h"
#include "core/base/status.h"

namespace capfit::client {
namespace {

using google::protobuf::Descriptor;

std::string Shown(const std::string& field, const std::string& problem) {
  return InFlags(InvalidField(ErrorReason::kOutOfRange, field, problem));
}

TEST(FlagNames, PathsAreShownAsFlags) {
  EXPECT_EQ(Shown("options.budget.max_primitives", "is 3, must be in [15, 1000]"),
            "--max-primitives is 3, must be in [15, 1000]");
  EXPECT_EQ(Shown("options.landmarks[2].name", "is no name"), "--landmarks[2].name is no name");
  EXPECT_EQ(Shown("options.landmarks.left_wrist", "is 3 m away"),
            "--landmarks.left_wrist is 3 m away");
  EXPECT_EQ(Shown("mesh.unit", "contradicts mesh.up_axis"), "--unit contradicts --up");
  EXPECT_EQ(Shown("mesh.file", "line 7 is cut"), "BODY line 7 is cut");
  EXPECT_EQ(Shown("height_m", "is 3"), "--height-m is 3");
  EXPECT_EQ(Shown("frames[3]", "has 7 bytes"), "--frames[3] has 7 bytes");
}

TEST(FlagNames, WhatOnlyLooksLikeAPathStays) {
  EXPECT_EQ(Shown("options.seedling", "is odd"), "options.seedling is odd");
  EXPECT_EQ(Shown("other", "has height and width"), "other has height and width");
  EXPECT_EQ(Shown("heights", "are odd"), "heights are odd");
  EXPECT_EQ(InFlags(absl::InternalError("faces are odd")), "faces are odd");
}

// Every field below `message`, at whose end another message that is a list or a choice stops.
void AddPaths(const Descriptor& message, const std::string& path, std::set<std::string>& paths) {
  for (int i = 0; i < message.field_count(); ++i) {
    const auto& field = *message.field(i);
    const std::string name = path + "." + field.name();
    if (field.message_type() != nullptr && !field.is_repeated()) {
      AddPaths(*field.message_type(), name, paths);
    } else {
      paths.insert(name);
    }
  }
}

TEST(FlagNames, EveryOptionOfTheContractHasAFlagThatThereIs) {
  CLI::App app;
  int exit_code = 0;
  AddApproximateCommand(app, exit_code);
  AddMannequinCommand(app, exit_code);
  AddRenderCommand(app, exit_code);
  std::set<std::string> flags = {"BODY"};
  for (const CLI::App* const command : app.get_subcommands({})) {
    for (const CLI::Option* const option : command->get_options()) {
      for (const std::string& name : option->get_lnames()) flags.insert("--" + name);
    }
  }
  std::set<std::string> wanted;
  AddPaths(*v1::FitOptions::descriptor(), "options", wanted);
  for (const FlagName& name : FlagNames()) {
    EXPECT_TRUE(flags.contains(std::string(name.flag))) << name.flag;
    wanted.erase(std::string(name.path));
  }
  EXPECT_TRUE(wanted.empty()) << "no flag for " << *wanted.begin();
}

}  // namespace
}  // namespace capfit::client
