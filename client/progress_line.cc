#include "client/progress_line.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <string>

namespace capfit::client {
namespace {

constexpr int kBarWidth = 30;

std::string Bar(double fraction) {
  const int filled = static_cast<int>(std::clamp(fraction, 0.0, 1.0) * kBarWidth);
  return std::string(static_cast<std::size_t>(filled), '#') +
         std::string(static_cast<std::size_t>(kBarWidth - filled), '.');
}

}  // namespace

bool StderrIsTerminal() { return isatty(STDERR_FILENO) == 1; }

ProgressLine::ProgressLine(bool is_shown) : is_shown_(is_shown), is_terminal_(StderrIsTerminal()) {}

ProgressLine::~ProgressLine() {
  if (is_shown_ && is_terminal_) std::fputs("\r\x1b[K", stderr);
}

void ProgressLine::OnStage(Stage stage, double fraction_done) {
  if (!is_shown_) return;
  const std::string name(StageName(stage));
  const double percent = 100.0 * std::clamp(fraction_done, 0.0, 1.0);
  if (is_terminal_) {
    std::fprintf(stderr, "\r\x1b[K[%s] %3.0f %%  %s", Bar(fraction_done).c_str(), percent,
                 name.c_str());
  } else if (static_cast<int>(stage) != last_stage_) {
    std::fprintf(stderr, "%3.0f %%  %s\n", percent, name.c_str());
  }
  last_stage_ = static_cast<int>(stage);
  std::fflush(stderr);
}

}  // namespace capfit::client
