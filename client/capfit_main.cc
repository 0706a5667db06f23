// The command line `capfit`.
#include <string>
#include <vector>

#include "client/command_line.h"

int main(int argc, char** argv) {
  return capfit::client::RunCommandLine(std::vector<std::string>(argv + 1, argv + argc));
}
