// Everything that can be set about a server.
#ifndef CAPFIT_SERVER_SERVER_CONFIG_H_
#define CAPFIT_SERVER_SERVER_CONFIG_H_

#include <string>

#include "server/mesh_upload.h"
#include "server/tls_files.h"

namespace capfit::server {

// What one connection may do; see docs/security.md for the attacks that these are for.
struct ConnectionLimits {
  int max_metadata_bytes = 16 * 1024;  // of one call; [1024, 1048576]
  int max_streams = 128;               // calls at a time; [1, 10000]
  // New replicas get traffic because clients connect anew after this; gRPC spreads it by a tenth.
  double max_age_seconds = 600.0;         // [1, 86400]
  double max_age_grace_seconds = 3600.0;  // for calls that run by then; [1, 86400]
  double keepalive_seconds = 60.0;        // between pings of a connection that is quiet; [1, 7200]
};

struct ServerConfig {
  std::string listen = "127.0.0.1:50051";  // HOST:PORT; port 0: any free one
  std::string port_file;                   // the chosen port is written here; empty: nowhere
  bool insecure_listen = false;            // see exposure.h
  TlsConfig tls;
  std::string token_file;  // see token_file.h; empty: everyone may call
  ConnectionLimits connection;
  int threads = 0;              // that compute; 0: one per core
  int max_concurrent_fits = 2;  // [1, 64]
  int max_queued_fits = 16;     // [0, 10000]: further calls that may upload and wait
  UploadLimits upload;
  int retry_pushback_ms = 500;       // [0, 600000]: sent with RESOURCE_EXHAUSTED
  double drain_delay_seconds = 0.0;  // between NOT_SERVING and refusing new calls; [0, 600]
  double drain_seconds = 30.0;       // running calls may finish within this; [0, 3600]
  std::string log_level = "info";    // trace, debug, info, warn, error, off
};

// Size of one request message: bodies of 200,000 faces as arrays, or of 64,000 as text, fit into
// one.
inline constexpr int kMaxMessageBytes = 16 * 1024 * 1024;
// What gRPC lets in, so that a message beyond the limit meets our error, which names it, rather
// than gRPC's RESOURCE_EXHAUSTED, which reads as "come again later".
inline constexpr int kMaxReceivedBytes = 2 * kMaxMessageBytes;

}  // namespace capfit::server

#endif  // CAPFIT_SERVER_SERVER_CONFIG_H_
