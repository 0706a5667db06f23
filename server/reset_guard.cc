#include "server/reset_guard.h"

#include <grpcpp/support/server_interceptor.h>
#include <netdb.h>
#include <spdlog/spdlog.h>
#include <sys/socket.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "server/caller.h"

namespace capfit::server {
namespace {

// One end of a connection.
struct End {
  std::string host;
  std::string port;
  bool is_ipv6 = false;
};

using Asks = int (*)(int, sockaddr*, socklen_t*);

// The near end of a socket (getsockname) or its far one (getpeername); nothing for what is no TCP
// connection.
std::optional<End> EndOf(int file, Asks asks) {
  sockaddr_storage address = {};
  socklen_t size = sizeof address;
  auto* const any = reinterpret_cast<sockaddr*>(&address);
  if (asks(file, any, &size) != 0) return std::nullopt;
  if (address.ss_family != AF_INET && address.ss_family != AF_INET6) return std::nullopt;
  std::array<char, NI_MAXHOST> host = {};
  std::array<char, NI_MAXSERV> port = {};
  if (getnameinfo(any, size, host.data(), host.size(), port.data(), port.size(),
                  NI_NUMERICHOST | NI_NUMERICSERV) != 0) {
    return std::nullopt;
  }
  return End{host.data(), port.data(), address.ss_family == AF_INET6};
}

// As gRPC writes it.
std::string PeerOf(const End& end) {
  // IPv4 over a socket of IPv6.
  constexpr std::string_view kMapped = "::ffff:";
  if (end.host.starts_with(kMapped)) {
    return absl::StrCat("ipv4:", end.host.substr(kMapped.size()), ":", end.port);
  }
  return end.is_ipv6 ? absl::StrCat("ipv6:%5B", end.host, "%5D:", end.port)
                     : absl::StrCat("ipv4:", end.host, ":", end.port);
}

using grpc::experimental::InterceptionHookPoints;
using grpc::experimental::Interceptor;
using grpc::experimental::InterceptorBatchMethods;
using grpc::experimental::ServerRpcInfo;

// Whether a call of the method may be asked, where its end is intercepted, if it was cancelled. Of
// gRPC's own services with threads of their own (reflection, channelz) IsCancelled would end in
// this interceptor again, without end.
bool MayBeAsked(std::string_view method) {
  return method.starts_with("/capfit.v1.") || method.starts_with("/grpc.health.v1.");
}

// Not the calls' own objects: gRPC makes none of those for a call that was reset before its
// message. Who cannot be asked counts as given up: nobody has use for so many of those either.
class ResetCounter final : public Interceptor {
 public:
  ResetCounter(std::shared_ptr<ResetGuard> guard, ServerRpcInfo& call)
      : guard_(std::move(guard)), call_(call) {}
  ~ResetCounter() override {
    if (!peer_.empty()) guard_->End(peer_, has_message_);
  }
  ResetCounter(const ResetCounter&) = delete;
  ResetCounter& operator=(const ResetCounter&) = delete;

  void Intercept(InterceptorBatchMethods* methods) override {
    const auto is_at = [&](InterceptionHookPoints point) {
      return methods->QueryInterceptionHookPoint(point);
    };
    if (peer_.empty()) {
      peer_ = call_.server_context()->peer();
      guard_->Begin(peer_);
    }
    if (is_at(InterceptionHookPoints::POST_RECV_MESSAGE) && !has_message_ &&
        methods->GetRecvMessage() != nullptr) {
      has_message_ = true;
      guard_->TakeMessage(peer_);
    }
    // A call that had its answer before the reset was seen is not cancelled, but silent.
    if (is_at(InterceptionHookPoints::POST_RECV_CLOSE) &&
        (!has_message_ || !MayBeAsked(call_.method()) || call_.server_context()->IsCancelled())) {
      guard_->CountReset(peer_);
    }
    methods->Proceed();
  }

 private:
  const std::shared_ptr<ResetGuard> guard_;
  ServerRpcInfo& call_;
  std::string peer_;  // once it is known
  bool has_message_ = false;
};

class ResetCounters final : public grpc::experimental::ServerInterceptorFactoryInterface {
 public:
  explicit ResetCounters(std::shared_ptr<ResetGuard> guard) : guard_(std::move(guard)) {}
  Interceptor* CreateServerInterceptor(ServerRpcInfo* call) override {
    return new ResetCounter(guard_, *call);  // gRPC's from here on
  }

 private:
  const std::shared_ptr<ResetGuard> guard_;
};

}  // namespace

void CountResets(const std::shared_ptr<ResetGuard>& guard, grpc::ServerBuilder& builder) {
  std::vector<std::unique_ptr<grpc::experimental::ServerInterceptorFactoryInterface>> counters;
  counters.push_back(std::make_unique<ResetCounters>(guard));
  builder.experimental().SetInterceptorCreators(std::move(counters));
}

int CutConnections(int port, const std::function<bool(const std::string& peer)>& is_to_cut) {
  const std::string own_port = absl::StrCat(port);
  int count = 0;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd", error)) {
    const int file = std::atoi(entry.path().filename().c_str());
    const std::optional<End> near = EndOf(file, getsockname);
    if (!near || near->port != own_port) continue;
    const std::optional<End> far = EndOf(file, getpeername);
    if (!far || !is_to_cut(PeerOf(*far))) continue;
    // To connect to nothing resets a connection and drops what it has received; shutdown would let
    // gRPC read all of that first.
    const sockaddr nothing = {AF_UNSPEC, {}};
    if (connect(file, &nothing, sizeof nothing) == 0) ++count;
  }
  return count;
}

ResetGuard::Host& ResetGuard::HostOf(const std::string& name) {
  const Clock::time_point now = Clock::now();
  if (now - window_begin_ > kResetWindow) {
    window_begin_ = now;
    hosts_.clear();
  }
  return hosts_[name];
}

void ResetGuard::CountReset(const std::string& peer) {
  const std::string name = HostOfPeer(peer);
  bool is_first = false;
  {
    const std::lock_guard lock(mutex_);
    Host& host = HostOf(name);
    host.peers.insert(peer);
    last_reset_ = Clock::now();
    is_first = ++host.resets > kMostResets && CountOut(name);
  }
  if (is_first) LookAgain();
}

void ResetGuard::Begin(const std::string& peer) {
  const std::string name = HostOfPeer(peer);
  bool is_first = false;
  {
    const std::lock_guard lock(mutex_);
    static_cast<void>(HostOf(name));  // a window that is over is forgotten
    if (++silent_calls_[name] > kMostSilent) {
      last_reset_ = Clock::now();
      is_first = CountOut(name);
    }
  }
  if (is_first) LookAgain();
}

// Whether nobody looks for connections yet.
bool ResetGuard::CountOut(const std::string& name) {
  return counted_out_.insert(name).second && counted_out_.size() == 1;
}

void ResetGuard::TakeMessage(const std::string& peer) {
  const std::lock_guard lock(mutex_);
  Drop(silent_calls_, HostOfPeer(peer));
  ++calls_at_work_[peer];
}

void ResetGuard::End(const std::string& peer, bool has_message) {
  const std::lock_guard lock(mutex_);
  if (has_message) {
    Drop(calls_at_work_, peer);
  } else {
    Drop(silent_calls_, HostOfPeer(peer));
  }
}

void ResetGuard::Drop(std::map<std::string, int>& calls, const std::string& name) {
  const auto count = calls.find(name);
  if (count != calls.end() && --count->second == 0) calls.erase(count);
}

// Copies, so that looking through the files takes no lock that a flood of calls fights for.
ResetGuard::ToCut ResetGuard::WhatToCut() {
  const std::lock_guard lock(mutex_);
  if (Clock::now() - last_reset_ > kQuiet) counted_out_.clear();
  ToCut cut{counted_out_, {}};
  for (const auto& [peer, calls] : calls_at_work_) {
    const auto host = hosts_.find(HostOfPeer(peer));
    if (host == hosts_.end() || !host->second.peers.contains(peer)) cut.spared.insert(peer);
  }
  return cut;
}

void ResetGuard::LookAgain() {
  const ToCut cut = WhatToCut();
  if (cut.hosts.empty()) return;
  const int count = CutConnections(port_, [&](const std::string& peer) {
    return cut.hosts.contains(HostOfPeer(peer)) && !cut.spared.contains(peer);
  });
  if (count > 0) {
    spdlog::warn(
        "cut off {} connections of hosts that gave up more than {} calls within {} s, or "
        "began more than {} at once without a message",
        count, kMostResets, kResetWindow.count(), kMostSilent);
  }
  watchdog_.Set(Clock::now() + kCutEvery, [guard = weak_from_this()] {
    if (const std::shared_ptr<ResetGuard> lives = guard.lock()) lives->LookAgain();
  });
}

}  // namespace capfit::server
