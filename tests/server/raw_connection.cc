#include "tests/server/raw_connection.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>

namespace capfit::server {
namespace {

std::string BigEndian(std::uint32_t number, int bytes) {
  std::string text;
  for (int i = bytes - 1; i >= 0; --i) text += static_cast<char>(number >> (8 * i) & 0xff);
  return text;
}

// A header as HPACK writes it without any table; lengths below 127.
std::string HpackHeader(const std::string& name, const std::string& value) {
  return std::string(1, '\0') + static_cast<char>(name.size()) + name +
         static_cast<char>(value.size()) + value;
}

}  // namespace

RawConnection::RawConnection(int port) : socket_(socket(AF_INET, SOCK_STREAM, 0)) {
  sockaddr_in address = {};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  EXPECT_EQ(connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
}

RawConnection::~RawConnection() { close(socket_); }

void RawConnection::Send(const std::string& bytes) const {
  static_cast<void>(send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL));
}

void RawConnection::BeginHttp2() const {
  Send("PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n");
  SendFrame(FrameType::kSettings, 0, "");
}

void RawConnection::SendFrame(FrameType type, std::uint32_t stream, const std::string& payload,
                              char flags) const {
  Send(BigEndian(static_cast<std::uint32_t>(payload.size()), 3) + static_cast<char>(type) + flags +
       BigEndian(stream, 4) + payload);
}

void RawConnection::SendCall(std::uint32_t stream, const std::string& path) const {
  constexpr char kEndOfHeaders = 4;
  SendFrame(FrameType::kHeaders, stream,
            HpackHeader(":method", "POST") + HpackHeader(":scheme", "http") +
                HpackHeader(":path", path) + HpackHeader(":authority", "localhost") +
                HpackHeader("te", "trailers") + HpackHeader("content-type", "application/grpc"),
            kEndOfHeaders);
}

bool RawConnection::EndsWithin(int seconds) const {
  pollfd wait = {socket_, POLLIN, 0};
  std::array<char, 4096> bytes{};
  while (poll(&wait, 1, seconds * 1000) == 1) {
    if (recv(socket_, bytes.data(), bytes.size(), 0) <= 0) return true;
  }
  return false;
}

}  // namespace capfit::server
