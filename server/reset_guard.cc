#include "server/reset_guard.h"

#include <grpcpp/support/server_interceptor.h>
#include <netdb.h>
#include <spdlog/spdlog.h>
#include <sys/socket.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <utility>
#include <vector>

#include "server/caller.h"

namespace capfit::server {
namespace {

// The other end of a socket, as gRPC writes it; "" for what is no TCP connection.
std::string PeerOf(int file) {
  sockaddr_storage address = {};
  socklen_t size = sizeof address;
  auto* const any = reinterpret_cast<sockaddr*>(&address);
  if (getpeername(file, any, &size) != 0) return "";
  if (address.ss_family != AF_INET && address.ss_family != AF_INET6) return "";
  std::array<char, NI_MAXHOST> host = {};
  std::array<char, NI_MAXSERV> port = {};
  if (getnameinfo(any, size, host.data(), host.size(), port.data(), port.size(),
                  NI_NUMERICHOST | NI_NUMERICSERV) != 0) {
    return "";
  }
  const std::string text = host.data();
  // IPv4 over a socket of IPv6.
  constexpr char kMapped[] = "::ffff:";
  if (text.rfind(kMapped, 0) == 0) {
    return "ipv4:" + text.substr(sizeof(kMapped) - 1) + ":" + port.data();
  }
  return address.ss_family == AF_INET ? "ipv4:" + text + ":" + port.data()
                                      : "ipv6:%5B" + text + "%5D:" + port.data();
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

  void Intercept(InterceptorBatchMethods* methods) override {
    if (methods->QueryInterceptionHookPoint(InterceptionHookPoints::POST_RECV_CLOSE) &&
        (!MayBeAsked(call_.method()) || call_.server_context()->IsCancelled())) {
      guard_->CountReset(call_.server_context()->peer());
    }
    methods->Proceed();
  }

 private:
  const std::shared_ptr<ResetGuard> guard_;
  ServerRpcInfo& call_;
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

bool CutConnection(const std::string& peer) {
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd", error)) {
    const int file = std::atoi(entry.path().filename().c_str());
    if (PeerOf(file) != peer) continue;
    // To connect to nothing resets a connection and drops what it has received; shutdown would let
    // gRPC read all of that first.
    const sockaddr nothing = {AF_UNSPEC, {}};
    return connect(file, &nothing, sizeof nothing) == 0;
  }
  return false;
}

bool ResetGuard::IsTooMany(const std::string& peer) {
  const std::lock_guard lock(mutex_);
  const Clock::time_point now = Clock::now();
  if (now - window_begin_ > kResetWindow) {
    window_begin_ = now;
    resets_.clear();
    cut_.clear();
  }
  return ++resets_[HostOfPeer(peer)] > kMostResets && cut_.insert(peer).second;
}

void ResetGuard::CountReset(const std::string& peer) {
  if (!IsTooMany(peer) || !CutConnection(peer)) return;
  spdlog::warn("cut off peer={}: its host gave up more than {} calls within {} s", peer,
               kMostResets, kResetWindow.count());
}

}  // namespace capfit::server
