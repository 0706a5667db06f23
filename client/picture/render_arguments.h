// What `capfit render` is asked, on the command line.
#ifndef CAPFIT_CLIENT_PICTURE_RENDER_ARGUMENTS_H_
#define CAPFIT_CLIENT_PICTURE_RENDER_ARGUMENTS_H_

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "CLI/CLI.hpp"
#include "absl/status/status.h"

namespace capfit::client {

struct RenderArguments {
  std::string body;
  std::string result;
  std::string output;
  std::string up = "auto";
  std::string title;
  std::vector<std::string> views = {"front", "side", "back"};
  bool heat = false;
  std::string gaps;
  double heat_limit_mm = 30.0;
  bool polygons = false;
  std::optional<double> mm_per_unit;  // default: what the gaps, the result or the body tell
  int width = 1500;
  std::optional<int> height;
  std::string frames;
  std::string centers;
  std::string radii;  // empty: those of the result
  std::vector<std::size_t> show = {0};
};

// Flags and positions, which fill `arguments`; it must outlive the command.
void AddRenderOptions(CLI::App& command, RenderArguments& arguments);

// What one flag alone cannot tell: ranges, and flags that need or exclude each other.
// INVALID_ARGUMENT naming the first that is wrong.
[[nodiscard]] absl::Status CheckRenderArguments(const RenderArguments& arguments);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_PICTURE_RENDER_ARGUMENTS_H_
