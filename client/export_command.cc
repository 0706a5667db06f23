#include "client/export_command.h"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "client/exit_code.h"
#include "client/option_words.h"
#include "client/picture/belongs.h"
#include "client/picture/file_bytes.h"
#include "client/picture/result_body.h"
#include "client/result_colliders.h"
#include "client/word_option.h"
#include "core/base/status.h"
#include "core/export/export.h"
#include "core/formats/read_mesh.h"

namespace capfit::client {
namespace {

struct ExportArguments {
  std::string result;
  std::vector<std::string> formats;
  std::string body;
  std::string folder = ".";
  double max_overshoot_mm = 1e3 * exports::kDefaultOvershootM;
  bool quiet = false;
  exports::ExportOptions options;
};

// The file that was fitted, or nothing; refused where it is of another body.
absl::StatusOr<std::string> Original(const ExportArguments& arguments,
                                     const std::string& result_text) {
  if (arguments.body.empty()) return std::string();
  CAPFIT_ASSIGN_OR_RETURN(std::string bytes, ReadFileBytes(arguments.body));
  CAPFIT_ASSIGN_OR_RETURN(const ResultSet result, ParseResultSet(result_text));
  CAPFIT_ASSIGN_OR_RETURN(const formats::PolygonSoup soup,
                          formats::ReadMesh(std::as_bytes(std::span(bytes)),
                                            formats::FormatFromFileName(arguments.body)));
  CAPFIT_RETURN_IF_ERROR(CheckBelongs(result, soup));
  return bytes;
}

std::string SourceOf(const ExportArguments& arguments) {
  const std::string& path = arguments.body.empty() ? arguments.result : arguments.body;
  return path == "-" ? "body" : std::filesystem::path(path).stem().string();
}

absl::Status PrintFile(const std::vector<exports::ExportFile>& files) {
  if (files.size() == 1) return WriteFileBytes("-", files.front().bytes);
  return InvalidField(ErrorReason::kConflict, "--output",
                      absl::StrCat("is -, which takes one file; these formats make ", files.size(),
                                   ": name a folder"));
}

absl::Status WriteFiles(const std::vector<exports::ExportFile>& files,
                        const ExportArguments& arguments) {
  for (const exports::ExportFile& file : files) {
    CAPFIT_RETURN_IF_ERROR(WriteExportFile(file, arguments.folder, arguments.quiet));
  }
  return absl::OkStatus();
}

absl::Status RunExport(const ExportArguments& arguments) {
  CAPFIT_ASSIGN_OR_RETURN(const std::string text, ReadFileBytes(arguments.result));
  CAPFIT_ASSIGN_OR_RETURN(const exports::ColliderSet set, CollidersOf(text, SourceOf(arguments)));
  CAPFIT_ASSIGN_OR_RETURN(const std::string original, Original(arguments, text));
  exports::ExportOptions options = arguments.options;
  options.max_overshoot_m = 1e-3 * arguments.max_overshoot_mm;
  std::vector<exports::ExportFile> files;
  for (const std::string& format : arguments.formats) {
    absl::StatusOr<exports::Exported> exported =
        exports::Export(set, format, std::as_bytes(std::span(original)), options);
    if (!exported.ok()) {
      const bool wants_body = FieldOf(exported.status()) == "original";
      return wants_body ? InvalidField(ErrorReason::kMissing, "--body",
                                       absl::StrCat("is missing; ", format,
                                                    " puts the colliders into the file that was "
                                                    "fitted"))
                        : exported.status();
    }
    PrintWarnings(exported->warnings);
    for (exports::ExportFile& file : exported->files) files.push_back(std::move(file));
  }
  return arguments.folder == "-" ? PrintFile(files) : WriteFiles(files, arguments);
}

std::string FormatsFooter() {
  std::string text = "Formats:\n";
  for (const exports::ExportFormat& format : exports::ExportFormats()) {
    std::string name(format.name);
    name.resize(10, ' ');
    absl::StrAppend(&text, "  ", name, std::string(format.summary), "\n");
  }
  return text + "docs/engines tells of each what it holds and how to load it.";
}

}  // namespace

absl::Status WriteExportFile(const exports::ExportFile& file, const std::string& folder,
                             bool quiet) {
  std::error_code error;
  if (!folder.empty()) std::filesystem::create_directories(folder, error);
  if (error) {
    return absl::NotFoundError(absl::StrCat("cannot make ", folder, ": ", error.message()));
  }
  const std::string path = (std::filesystem::path(folder) / file.name).string();
  CAPFIT_RETURN_IF_ERROR(WriteFileBytes(path, file.bytes));
  if (!quiet) std::printf("%s (%zu bytes)\n", path.c_str(), file.bytes.size());
  return absl::OkStatus();
}

void AddExportCommand(CLI::App& app, int& exit_code) {
  const auto arguments = std::make_shared<ExportArguments>();
  CLI::App* const command =
      app.add_subcommand("export", "Write a RESULT.json as files that engines load");
  command->add_option("RESULT", arguments->result, "RESULT.json of `capfit approximate`")
      ->required()
      ->type_name("RESULT.json");
  AddWordList(*command, "--to", arguments->formats, ExportWords(), "Formats, see below")
      ->required();
  command
      ->add_option("--body", arguments->body,
                   "The mesh file that was fitted: gltf gives it back with colliders, vrm needs it")
      ->type_name("FILE");
  command
      ->add_option("-o,--output", arguments->folder, "Folder for the files; - prints the only one")
      ->type_name("FOLDER")
      ->capture_default_str();
  command->add_flag("--preview", arguments->options.has_preview,
                    "gltf: the colliders as visible meshes too");
  command->add_flag("--plain", arguments->options.is_plain,
                    "usd, mujoco: shapes that every reader knows, in place of tapered capsules");
  command
      ->add_option("--max-overshoot-mm", arguments->max_overshoot_mm,
                   "vrm, usd, mujoco, urdf: how far capsules of one radius may stand out of the "
                   "tapered ones")
      ->capture_default_str();
  command->add_flag("--quiet", arguments->quiet, "Print no names, only warnings");
  command->footer(FormatsFooter());
  command->callback([arguments, &exit_code] { exit_code = Report(RunExport(*arguments)); });
}

}  // namespace capfit::client
