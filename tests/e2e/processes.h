// Starts the programs as their users do.
#ifndef CAPFIT_TESTS_E2E_PROCESSES_H_
#define CAPFIT_TESTS_E2E_PROCESSES_H_

#include <sys/types.h>

#include <string>
#include <vector>

#include "tests/support/scratch.h"

namespace capfit::e2e {

using test_support::Scratch;

// How a program ended, and what it said.
struct Outcome {
  int exit_code = -1;
  std::string out;
  std::string err;
};

// Runs a program to its end, its standard input from a file.
[[nodiscard]] Outcome RunProgram(const std::string& program,
                                 const std::vector<std::string>& arguments,
                                 const std::string& in_path = "/dev/null");
// Runs build/<preset>/client/capfit to its end.
[[nodiscard]] Outcome RunCapfit(const std::vector<std::string>& arguments,
                                const std::string& in_path = "/dev/null");

// build/<preset>/server/capfit-server on a free port of the loopback, ready when constructed.
class ServerProcess {
 public:
  // `log`: the file for its standard error; "": one of its own, which Log() reads.
  explicit ServerProcess(const std::vector<std::string>& flags = {}, const std::string& log = "");
  // Stops it, if nobody has.
  ~ServerProcess();
  ServerProcess(const ServerProcess&) = delete;
  ServerProcess& operator=(const ServerProcess&) = delete;

  [[nodiscard]] const std::string& address() const { return address_; }
  void Signal(int signal) const;
  [[nodiscard]] pid_t pid() const { return pid_; }
  // Its resident memory now.
  [[nodiscard]] double ResidentMib() const;
  // What it has logged so far.
  [[nodiscard]] std::string Log() const;
  // Waits for the end; the exit code, or minus the signal that killed it.
  [[nodiscard]] int Wait();

 private:
  Scratch scratch_;
  pid_t pid_ = -1;
  std::string address_;
};

// Whole files.
[[nodiscard]] std::string ReadText(const std::string& path);
void WriteText(const std::string& path, const std::string& text);

}  // namespace capfit::e2e

#endif  // CAPFIT_TESTS_E2E_PROCESSES_H_
