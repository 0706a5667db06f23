// How the lines of the log look.
#ifndef CAPFIT_SERVER_LOG_FORMAT_H_
#define CAPFIT_SERVER_LOG_FORMAT_H_

#include "server/call_record.h"

namespace capfit::server {

// For the default logger. Text keeps spdlog's own form. With kJson every line is one JSON object of
// `time` (ISO 8601, UTC), `level`, and either `call`, the object of CallLine, or `message`, a
// text.
void SetLogFormat(LogFormat format);

}  // namespace capfit::server

#endif  // CAPFIT_SERVER_LOG_FORMAT_H_
