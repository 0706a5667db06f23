#include "tests/e2e/processes.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <thread>

extern char** environ;

namespace capfit::e2e {
namespace {

pid_t Spawn(const std::string& program, const std::vector<std::string>& arguments,
            const std::string& in_path, const std::string& out_path, const std::string& err_path) {
  std::vector<char*> words = {const_cast<char*>(program.c_str())};
  for (const std::string& argument : arguments)
    words.push_back(const_cast<char*>(argument.c_str()));
  words.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, in_path.c_str(), O_RDONLY, 0);
  constexpr int kFlags = O_WRONLY | O_CREAT | O_TRUNC;
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out_path.c_str(), kFlags, 0600);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, err_path.c_str(), kFlags, 0600);
  pid_t pid = -1;
  EXPECT_EQ(posix_spawn(&pid, program.c_str(), &actions, nullptr, words.data(), environ), 0)
      << "cannot start " << program;
  posix_spawn_file_actions_destroy(&actions);
  return pid;
}

int WaitFor(pid_t pid) {
  int status = 0;
  if (pid < 0 || waitpid(pid, &status, 0) != pid) return -1000;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

}  // namespace

Outcome RunProgram(const std::string& program, const std::vector<std::string>& arguments,
                   const std::string& in_path) {
  const Scratch scratch;
  const std::string out = scratch.Path("out");
  const std::string err = scratch.Path("err");
  const int exit_code = WaitFor(Spawn(program, arguments, in_path, out, err));
  return {exit_code, ReadText(out), ReadText(err)};
}

Outcome RunCapfit(const std::vector<std::string>& arguments, const std::string& in_path) {
  return RunProgram(CAPFIT_CLIENT_PROGRAM, arguments, in_path);
}

ServerProcess::ServerProcess(const std::vector<std::string>& flags, const std::string& log) {
  const std::string port_file = scratch_.Path("port");
  std::vector<std::string> arguments = {"--listen", "127.0.0.1:0", "--port-file", port_file};
  arguments.insert(arguments.end(), flags.begin(), flags.end());
  pid_ = Spawn(CAPFIT_SERVER_PROGRAM, arguments, "/dev/null", scratch_.Path("out"),
               log.empty() ? scratch_.Path("err") : log);
  for (int i = 0; i < 600 && !std::filesystem::exists(port_file); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  std::string port = ReadText(port_file);
  while (!port.empty() && port.back() == '\n') port.pop_back();
  EXPECT_FALSE(port.empty()) << ReadText(scratch_.Path("err"));
  address_ = "127.0.0.1:" + port;
}

ServerProcess::~ServerProcess() {
  if (pid_ < 0) return;
  Signal(SIGKILL);
  static_cast<void>(Wait());
}

void ServerProcess::Signal(int signal) const { kill(pid_, signal); }

double ServerProcess::ResidentMib() const {
  std::ifstream in("/proc/" + std::to_string(pid_) + "/statm");
  double whole = 0.0;
  double resident = 0.0;
  in >> whole >> resident;
  EXPECT_GT(resident, 0.0);
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1024.0 * 1024.0);
}

std::string ServerProcess::Log() const { return ReadText(scratch_.Path("err")); }

int ServerProcess::Wait() {
  const int exit_code = WaitFor(pid_);
  pid_ = -1;
  return exit_code;
}

std::string ReadText(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

void WriteText(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

}  // namespace capfit::e2e
