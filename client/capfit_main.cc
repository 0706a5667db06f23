// The command line `capfit`.
#include <string>
#include <vector>

#include "client/command_line.h"
#include "core/base/large_pages.h"

int main(int argc, char** argv) {
  capfit::UseLargePages();
  return capfit::client::RunCommandLine(std::vector<std::string>(argv + 1, argv + argc));
}
