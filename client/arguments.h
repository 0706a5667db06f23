// What is done with the arguments before CLI11 parses them, and with its complaints.
#ifndef CAPFIT_CLIENT_ARGUMENTS_H_
#define CAPFIT_CLIENT_ARGUMENTS_H_

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace capfit::client {

// The arguments with the words of each list in one: "--parts torso arms body.obj" becomes "--parts
// torso,arms body.obj". A list is an option with a delimiter; it goes on for as long as its checks
// take the next argument, so a file named like a word of the list needs a folder ("./arms").
[[nodiscard]] std::vector<std::string> JoinLists(const CLI::App& app,
                                                 std::vector<std::string> arguments);

// What is wrong with the command or a long flag, with the one that may have been meant:
// "'aproximate' is no command; did you mean approximate?"; "" where all are known.
[[nodiscard]] std::string UnknownName(const CLI::App& app,
                                      const std::vector<std::string>& arguments);

// CLI11's complaint about these arguments in the words of the help.
[[nodiscard]] std::string Complaint(const CLI::App& app, const std::vector<std::string>& arguments,
                                    const CLI::ParseError& error);

// The subcommand that the arguments name; nothing where they name none.
[[nodiscard]] const CLI::App* CommandOf(const CLI::App& app,
                                        const std::vector<std::string>& arguments);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_ARGUMENTS_H_
