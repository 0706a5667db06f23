#include "server/settings.h"

#include <unistd.h>  // environ

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <map>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/string_view.h"
#include "absl/strings/strip.h"
#include "core/base/did_you_mean.h"
#include "core/base/status.h"

namespace capfit::server {
namespace {

constexpr char kFileFlag[] = "config";
constexpr char kPrefix[] = "CAPFIT_";

// What follows the prefix: "drain-seconds" is DRAIN_SECONDS.
std::string VariableOf(std::string flag) {
  std::transform(flag.begin(), flag.end(), flag.begin(), [](unsigned char letter) {
    return letter == '-' ? '_' : static_cast<char>(std::toupper(letter));
  });
  return flag;
}

// Values by the long name of their option.
using Values = std::map<std::string, std::vector<std::string>>;

std::string NameOf(const CLI::Option& option) {
  return option.get_lnames().empty() ? "" : option.get_lnames().front();
}

std::vector<std::string> ConfigurableNames(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* const option : app.get_options()) {
    if (option->get_configurable()) names.push_back(NameOf(*option));
  }
  return names;
}

void Parse(CLI::App& app, std::vector<std::string> words) {
  std::reverse(words.begin(), words.end());  // as CLI11 takes them
  app.parse(words);
}

void AddWords(const std::string& name, const std::vector<std::string>& values,
              std::vector<std::string>& words) {
  for (const std::string& value : values) words.push_back(absl::StrCat("--", name, "=", value));
}

// What the last parse found.
void Collect(const CLI::App& app, Values& values) {
  for (const CLI::Option* const option : app.get_options()) {
    if (option->count() > 0) values[NameOf(*option)] = option->results();
  }
}

// One setting alone, so that what is wrong about it can be told from where it stands: CLI11 begins
// its complaint with the flag.
absl::Status Take(CLI::App& app, const std::string& name, const std::vector<std::string>& given,
                  const std::string& place, Values& values) {
  std::vector<std::string> words;
  AddWords(name, given, words);
  try {
    Parse(app, words);
  } catch (const CLI::ParseError& error) {
    std::string problem = error.what();
    const std::string flag = absl::StrCat("--", name);
    if (problem.rfind(flag + ": ", 0) == 0) problem.erase(0, flag.size() + 2);
    return InvalidField(ErrorReason::kOutOfRange, place, absl::StrCat("is wrong: ", problem));
  }
  Collect(app, values);
  return absl::OkStatus();
}

bool IsEmpty(const std::vector<std::string>& given) {
  return std::all_of(given.begin(), given.end(), [](const auto& value) { return value.empty(); });
}

absl::Status TakeFile(CLI::App& app, const std::string& path, Values& values) {
  if (std::filesystem::is_directory(path)) {
    return InvalidField(ErrorReason::kMissing, path, "is a folder, must be a file");
  }
  std::vector<CLI::ConfigItem> items;
  try {
    items = CLI::ConfigTOML().from_file(path);
  } catch (const CLI::Error& error) {
    return InvalidField(ErrorReason::kMissing, path,
                        absl::StrCat("cannot be read: ", error.what()));
  }
  const std::vector<std::string> names = ConfigurableNames(app);
  for (const CLI::ConfigItem& item : items) {
    const std::string name = item.fullname();
    if (std::find(names.begin(), names.end(), name) == names.end()) {
      return InvalidField(
          ErrorReason::kUnknownValue, path,
          absl::StrCat("has '", name, "', which is no setting", DidYouMean(name, names)));
    }
    if (IsEmpty(item.inputs)) continue;
    CAPFIT_RETURN_IF_ERROR(Take(app, name, item.inputs, absl::StrCat(path, ": ", name), values));
  }
  return absl::OkStatus();
}

absl::Status TakeEnvironment(CLI::App& app, Values& values) {
  for (const std::string& name : ConfigurableNames(app)) {
    const std::string variable = EnvironmentName(name);
    const char* const value = std::getenv(variable.c_str());
    if (value == nullptr || *value == '\0') continue;
    CAPFIT_RETURN_IF_ERROR(Take(app, name, {value}, variable, values));
  }
  return absl::OkStatus();
}

std::string FilePath(const Values& given) {
  if (const auto found = given.find(kFileFlag); found != given.end()) return found->second.back();
  const char* const value = std::getenv(EnvironmentName(kFileFlag).c_str());
  return value == nullptr ? "" : value;
}

}  // namespace

std::string EnvironmentName(const std::string& flag) {
  return absl::StrCat(kPrefix, VariableOf(flag));
}

std::vector<std::string> DoubtfulVariables(const CLI::App& app) {
  // Without the prefix, which all share.
  std::vector<std::string> known;
  for (const std::string& name : ConfigurableNames(app)) known.push_back(VariableOf(name));
  known.push_back(VariableOf(kFileFlag));
  std::vector<std::string> doubtful;
  for (char** variable = environ; variable != nullptr && *variable != nullptr; ++variable) {
    absl::string_view text = *variable;
    // CAPFIT_PORT=tcp://10.0.0.7:50051 is Kubernetes' way to tell where a Service is.
    if (!absl::ConsumePrefix(&text, kPrefix) || absl::StrContains(text, "://")) continue;
    const std::string name(text.substr(0, text.find('=')));
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    const std::string* const meant = NearestOf(name, known);
    if (meant == nullptr) continue;
    doubtful.push_back(
        absl::StrCat(kPrefix, name, " is no setting; did you mean ", kPrefix, *meant, "?"));
  }
  std::sort(doubtful.begin(), doubtful.end());
  return doubtful;
}

// CLI11's own order is the file before the environment, which would make a variable in a container
// of no use where a file is mounted; so each place is parsed alone, the weakest first.
absl::Status ReadSettings(CLI::App& app, const std::vector<std::string>& arguments) {
  Parse(app, arguments);  // help, version and wrong flags end here
  Values given;
  Collect(app, given);
  Values values;
  if (const std::string path = FilePath(given); !path.empty()) {
    CAPFIT_RETURN_IF_ERROR(TakeFile(app, path, values));
  }
  CAPFIT_RETURN_IF_ERROR(TakeEnvironment(app, values));
  for (const auto& [name, one] : given) values[name] = one;
  std::vector<std::string> words;
  for (const auto& [name, one] : values) AddWords(name, one, words);
  Parse(app, words);
  return absl::OkStatus();
}

}  // namespace capfit::server
