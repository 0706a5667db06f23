#include "tests/server/redis_process.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <thread>

extern char** environ;

namespace capfit::server {
namespace {

constexpr char kProgram[] = "/usr/bin/redis-server";

int FreePort() {
  const int listener = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address = {};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  EXPECT_EQ(bind(listener, reinterpret_cast<sockaddr*>(&address), size), 0);
  EXPECT_EQ(getsockname(listener, reinterpret_cast<sockaddr*>(&address), &size), 0);
  close(listener);
  return ntohs(address.sin_port);
}

}  // namespace

bool RedisProcess::IsInstalled() { return access(kProgram, X_OK) == 0; }

RedisProcess::RedisProcess(const std::vector<std::string>& flags, int port,
                           const std::string& password) {
  place_ = {"127.0.0.1", port == 0 ? FreePort() : port, password};
  std::vector<std::string> words = {kProgram, "--port",         std::to_string(place_.port),
                                    "--bind", "127.0.0.1",      "--save",
                                    "",       "--appendonly",   "no",
                                    "--dir",  scratch_.folder()};
  words.insert(words.end(), flags.begin(), flags.end());
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  EXPECT_EQ(posix_spawn(&pid_, kProgram, &actions, nullptr, arguments.data(), environ), 0);
  posix_spawn_file_actions_destroy(&actions);
  for (int i = 0; i < 400 && !RedisConnection::Open(place_).ok(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}

RedisProcess::~RedisProcess() { Kill(); }

void RedisProcess::Signal(int signal) const { kill(pid_, signal); }

void RedisProcess::Kill() {
  if (pid_ < 0) return;
  Signal(SIGKILL);
  waitpid(pid_, nullptr, 0);
  pid_ = -1;
}

// Asks again where a busy machine makes Redis late: a server gives it up then, a test does not.
std::string RedisProcess::Ask(const std::vector<std::string>& words) const {
  absl::StatusOr<std::string> answer = absl::UnknownError("never asked");
  for (int attempt = 0; attempt < 20; ++attempt) {
    absl::StatusOr<RedisConnection> connection = RedisConnection::Open(place_);
    answer = connection.ok() ? connection->Ask(words) : connection.status();
    if (!absl::IsDeadlineExceeded(answer.status())) break;
  }
  return answer.ok() ? *answer : "error: " + std::string(answer.status().message());
}

}  // namespace capfit::server
