// Against clients that begin calls only to reset them, as fast as they can write.
#ifndef CAPFIT_SERVER_RESET_GUARD_H_
#define CAPFIT_SERVER_RESET_GUARD_H_

#include <grpcpp/server_builder.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>

#include "server/watchdog.h"

namespace capfit::server {

// A host may give up so many calls in kResetWindow. No honest client comes near: it would have to
// give up a hundred a second.
inline constexpr int kMostResets = 1000;
inline constexpr std::chrono::seconds kResetWindow{10};

// And may have so many calls open at once whose first message is not there yet. Of a unary call
// that is its whole mesh, but a server takes far fewer uploads at a time (--max-held-mb).
inline constexpr int kMostSilent = 2000;
// From then on the connections of such a host are looked for so often, until no call has been given
// up for kQuiet; in the same window one more is enough to begin again.
inline constexpr std::chrono::milliseconds kCutEvery{20};
inline constexpr std::chrono::milliseconds kQuiet{300};

// gRPC 1.51 reads and opens streams faster than it can close them, and closes them in the order in
// which they came: a connection that resets each stream at once makes it hold 20 KB for each, 2 GB
// after 100,000. The limit of streams does not help, since a stream that is reset counts no more.
// So calls that are given up, and those that are silent, are counted by host. Beyond that all of
// the host's connections are cut, because what they have sent may wait to be seen behind what
// others sent before, and so are those that it makes anew; spared are only those on which a call is
// open that has sent a message, and no call was given up. A client whose idle connection is cut
// connects anew. Callers behind a proxy are one host.
//
// Safe from any thread. To be made as a shared_ptr.
class ResetGuard : public std::enable_shared_from_this<ResetGuard> {
 public:
  // The watchdog's thread looks for connections; it must outlive the calls of the server.
  explicit ResetGuard(Watchdog& watchdog) : watchdog_(watchdog) {}
  // Nothing is cut before the server's port is known.
  void Guard(int port) { port_ = port; }
  // A call has begun; has sent its first message; is over. `peer`: as gRPC writes it. Looking for
  // connections takes some microseconds for each open file of this process.
  void Begin(const std::string& peer);
  void TakeMessage(const std::string& peer);
  void End(const std::string& peer, bool has_message);
  // It was given up by its client, or ended before it had sent a message.
  void CountReset(const std::string& peer);

 private:
  using Clock = std::chrono::steady_clock;
  // What one host did in this window.
  struct Host {
    int resets = 0;
    std::set<std::string> peers;  // on which calls were given up
  };
  struct ToCut {
    std::set<std::string> hosts;
    std::set<std::string> spared;  // peers
  };
  // With mutex_ held: of the window that has begun by now.
  [[nodiscard]] Host& HostOf(const std::string& name);
  [[nodiscard]] bool CountOut(const std::string& name);
  static void Drop(std::map<std::string, int>& calls, const std::string& name);
  // Cuts what is there, and again in a while.
  void LookAgain();
  [[nodiscard]] ToCut WhatToCut();

  Watchdog& watchdog_;
  std::atomic<int> port_{0};
  mutable std::mutex mutex_;
  Clock::time_point window_begin_;
  std::map<std::string, Host> hosts_;
  Clock::time_point last_reset_;
  std::set<std::string> counted_out_;         // hosts that are being cut off
  std::map<std::string, int> silent_calls_;   // that have sent no message, by host
  std::map<std::string, int> calls_at_work_;  // that have sent one, by peer
};

// Counts the calls of all services of a server that are given up or never send a message; of
// reflection, channelz and methods that there are not all calls. So who refuses a stream should
// read its first message before.
void CountResets(const std::shared_ptr<ResetGuard>& guard, grpc::ServerBuilder& builder);

// Ends the TCP connections of this process that came to its `port` and whose other end
// ("ipv4:192.0.2.7:4711") is one to cut, without reading what has come; how many there were. The
// sockets' owner sees them as reset.
int CutConnections(int port, const std::function<bool(const std::string& peer)>& is_to_cut);

}  // namespace capfit::server

#endif  // CAPFIT_SERVER_RESET_GUARD_H_
