// Everything that can be set about a server.
#ifndef CAPFIT_SERVER_SERVER_CONFIG_H_
#define CAPFIT_SERVER_SERVER_CONFIG_H_

#include <cstdint>
#include <string>
#include <vector>

#include "server/call_record.h"
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
  int threads = 0;              // that compute; 0: AvailableCores()
  int max_concurrent_fits = 0;  // [1, 64]; 0: as many as threads, at least 2
  int max_queued_fits = 256;    // [0, 10000]: further fits that may wait
  // Of memory for uploads and answers of all calls; [16 MiB, 1 TiB].
  std::int64_t max_held_bytes = 1024LL * 1024 * 1024;
  double max_queued_seconds = 60.0;   // no fit comes in that would wait longer; [0, 86400]
  int client_percent = 75;            // [1, 100]: of both and of max_queued_fits, for one client
  double upload_idle_seconds = 20.0;  // between messages of an upload; [0.01, 86400], as below
  double max_upload_seconds = 300.0;  // of a whole upload
  double read_idle_seconds = 60.0;    // in which a reader takes a message of the answer
  double max_fit_seconds = 600.0;     // of one fit, queue not included
  UploadLimits upload;
  int retry_pushback_ms = 500;       // [0, 600000]: the least that is sent with RESOURCE_EXHAUSTED
  double drain_delay_seconds = 0.0;  // between NOT_SERVING and refusing new calls; [0, 600]
  double drain_seconds = 30.0;       // running calls may finish within this; [0, 3600]
  std::string log_level = "info";    // trace, debug, info, warn, error, off
  // Of results that are kept to be given again, at most a quarter of max_held_bytes, which they are
  // part of; 0: none.
  std::int64_t cache_bytes = 64LL * 1024 * 1024;
  std::string cache_redis;                // HOST[:PORT] of a Redis to share them through; "": none
  std::string cache_redis_password_file;  // its first line; "": no password
  double cache_redis_seconds = 0.1;       // a call waits for its answer; [0.01, 60]
  LogFormat log_format = LogFormat::kText;
  bool channelz = false;       // gRPC's own tables of connections and calls, for whoever connects
  std::string metrics_listen;  // HOST:PORT for Prometheus; port 0: any free one; empty: nowhere
  std::vector<std::string> warnings;  // about where these come from, to be logged at the start
};

// Size of one request message: bodies of 200,000 faces as arrays, or of 64,000 as text, fit into
// one.
inline constexpr int kMaxMessageBytes = 16 * 1024 * 1024;
// What gRPC lets in, so that a message beyond the limit meets our error, which names it, rather
// than gRPC's RESOURCE_EXHAUSTED, which reads as "come again later".
inline constexpr int kMaxReceivedBytes = 2 * kMaxMessageBytes;

}  // namespace capfit::server

#endif  // CAPFIT_SERVER_SERVER_CONFIG_H_
