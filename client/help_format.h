// How help is laid out.
#ifndef CAPFIT_CLIENT_HELP_FORMAT_H_
#define CAPFIT_CLIENT_HELP_FORMAT_H_

#include <CLI/CLI.hpp>
#include <string>

namespace capfit::client {

// CLI11's own layout with descriptions broken at 100 columns, choices as "paper|tight", and without
// what the descriptions say themselves: ranges and exclusions.
class HelpFormat final : public CLI::Formatter {
 public:
  [[nodiscard]] std::string make_option_opts(const CLI::Option* option) const override;
  [[nodiscard]] std::string make_option_desc(const CLI::Option* option) const override;
};

// What an option takes, as help shows it: "paper|tight", "FILE", "INT".
[[nodiscard]] std::string ShownType(const CLI::Option& option);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_HELP_FORMAT_H_
