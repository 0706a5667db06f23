// A real Redis server of a test's own.
#ifndef CAPFIT_TESTS_SERVER_REDIS_PROCESS_H_
#define CAPFIT_TESTS_SERVER_REDIS_PROCESS_H_

#include <sys/types.h>

#include <string>
#include <vector>

#include "server/redis_connection.h"
#include "tests/support/scratch.h"

namespace capfit::server {

// redis-server on a port of the loopback that was free, without files; answers when constructed.
class RedisProcess {
 public:
  // False where the program is missing.
  [[nodiscard]] static bool IsInstalled();

  // `flags`: as of redis-server. `port` 0: any that is free.
  explicit RedisProcess(const std::vector<std::string>& flags = {}, int port = 0,
                        const std::string& password = "");
  ~RedisProcess();
  RedisProcess(const RedisProcess&) = delete;
  RedisProcess& operator=(const RedisProcess&) = delete;

  [[nodiscard]] int port() const { return place_.port; }
  [[nodiscard]] std::string address() const { return "127.0.0.1:" + std::to_string(port()); }
  // SIGSTOP, SIGCONT.
  void Signal(int signal) const;
  // SIGKILL, and waits until it is gone.
  void Kill();

  // The text of the answer, over a connection of its own; "error: ..." for errors.
  std::string Ask(const std::vector<std::string>& words) const;
  // The only key that it holds.
  [[nodiscard]] std::string OnlyKey() const { return Ask({"RANDOMKEY"}); }

 private:
  const test_support::Scratch scratch_;
  RedisPlace place_;
  pid_t pid_ = -1;
};

}  // namespace capfit::server

#endif  // CAPFIT_TESTS_SERVER_REDIS_PROCESS_H_
