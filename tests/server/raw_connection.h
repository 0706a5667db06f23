// A connection that says what no client would: bytes and frames of HTTP/2 as the test makes them.
#ifndef CAPFIT_TESTS_SERVER_RAW_CONNECTION_H_
#define CAPFIT_TESTS_SERVER_RAW_CONNECTION_H_

#include <cstdint>
#include <string>

namespace capfit::server {

enum class FrameType : char { kData = 0, kHeaders = 1, kResetStream = 3, kSettings = 4, kPing = 6 };

class RawConnection {
 public:
  // To a port of the loopback.
  explicit RawConnection(int port);
  ~RawConnection();
  RawConnection(const RawConnection&) = delete;
  RawConnection& operator=(const RawConnection&) = delete;

  // Nothing happens where the server has closed the connection.
  void Send(const std::string& bytes) const;
  void BeginHttp2() const;
  void SendFrame(FrameType type, std::uint32_t stream, const std::string& payload,
                 char flags = 0) const;
  // The headers of a gRPC call.
  void SendCall(std::uint32_t stream, const std::string& path) const;

  // Whether the server closes the connection within this time; for HTTP/2 also whether it says so.
  [[nodiscard]] bool EndsWithin(int seconds) const;

 private:
  const int socket_;
};

}  // namespace capfit::server

#endif  // CAPFIT_TESTS_SERVER_RAW_CONNECTION_H_
