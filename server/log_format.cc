#include "server/log_format.h"

#include <spdlog/pattern_formatter.h>
#include <spdlog/spdlog.h>

#include <memory>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"

namespace capfit::server {
namespace {

// The flag %*: what was logged, as a member of an object. Only lines of calls begin with a brace.
class Member final : public spdlog::custom_flag_formatter {
 public:
  void format(const spdlog::details::log_msg& message, const std::tm& /*time*/,
              spdlog::memory_buf_t& out) override {
    const std::string text(message.payload.data(), message.payload.size());
    const std::string member = text.rfind('{', 0) == 0
                                   ? absl::StrCat("\"call\":", text)
                                   : absl::StrCat("\"message\":", QuotedText(text));
    out.append(member.data(), member.data() + member.size());
  }
  [[nodiscard]] std::unique_ptr<custom_flag_formatter> clone() const override {
    return std::make_unique<Member>();
  }
};

}  // namespace

void SetLogFormat(LogFormat format) {
  if (format == LogFormat::kText) return;
  auto lines = std::make_unique<spdlog::pattern_formatter>(spdlog::pattern_time_type::utc);
  lines->add_flag<Member>('*').set_pattern(R"({"time":"%Y-%m-%dT%H:%M:%S.%eZ","level":"%l",%*})");
  spdlog::set_formatter(std::move(lines));
}

}  // namespace capfit::server
