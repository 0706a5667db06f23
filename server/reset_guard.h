// Against clients that begin calls only to reset them, as fast as they can write.
#ifndef CAPFIT_SERVER_RESET_GUARD_H_
#define CAPFIT_SERVER_RESET_GUARD_H_

#include <grpcpp/server_builder.h>

#include <chrono>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>

namespace capfit::server {

// A host may give up so many calls in kResetWindow. No honest client comes near: it would have to
// give up a hundred a second.
inline constexpr int kMostResets = 1000;
inline constexpr std::chrono::seconds kResetWindow{10};

// gRPC 1.51 reads and opens streams faster than it can close them: a single connection that resets
// each stream at once makes it hold 20 KB for each, 2 GB after 100,000. The limit of streams does
// not help, since a stream that is reset counts no more. So calls that are given up are counted by
// host; beyond kMostResets every connection is cut on which another comes, until the window is
// over. Callers behind a proxy are one host.
//
// Safe from any thread.
class ResetGuard {
 public:
  // A call was given up by its client. `peer`: as gRPC writes it. Cutting takes about a microsecond
  // for each open file of this process, once for each connection.
  void CountReset(const std::string& peer);

 private:
  using Clock = std::chrono::steady_clock;
  // Whether the connection is to be cut now.
  [[nodiscard]] bool IsTooMany(const std::string& peer);

  std::mutex mutex_;
  Clock::time_point window_begin_;
  std::map<std::string, int> resets_;  // by host, in this window
  std::set<std::string> cut_;          // peers, in this window
};

// Counts the calls of all services of a server that are given up; of reflection, channelz and
// methods that there are not all calls.
void CountResets(const std::shared_ptr<ResetGuard>& guard, grpc::ServerBuilder& builder);

// Ends the TCP connection of this process whose other end is `peer` ("ipv4:192.0.2.7:4711"),
// without reading what has come; false where there is none. The socket's owner sees it as reset.
bool CutConnection(const std::string& peer);

}  // namespace capfit::server

#endif  // CAPFIT_SERVER_RESET_GUARD_H_
