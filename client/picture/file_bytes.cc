#include "client/picture/file_bytes.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>

#include "absl/strings/str_cat.h"

namespace capfit::client {

namespace {

constexpr char kStandardStream[] = "-";

std::string AllOf(std::istream& in) {
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

absl::StatusOr<std::string> ReadStandardInput() {
  if (std::cin.eof()) {
    return absl::NotFoundError("cannot read standard input again: only one input can be -");
  }
  std::string bytes = AllOf(std::cin);
  std::cin.setstate(std::ios::eofbit);
  return bytes;
}

absl::Status CannotWrite(const std::string& path) {
  return absl::NotFoundError(absl::StrCat("cannot write ", path));
}

}  // namespace

absl::StatusOr<std::string> ReadFileBytes(const std::string& path) {
  if (path == kStandardStream) return ReadStandardInput();
  std::error_code error;
  const bool is_folder = std::filesystem::is_directory(path, error);
  std::ifstream in(path, std::ios::binary);
  if (is_folder || !in) return absl::NotFoundError(absl::StrCat("cannot read ", path));
  return AllOf(in);
}

absl::Status WriteFileBytes(const std::string& path, const std::string& bytes) {
  if (path == kStandardStream) {
    const bool is_whole = std::fwrite(bytes.data(), 1, bytes.size(), stdout) == bytes.size();
    return is_whole && std::fflush(stdout) == 0 ? absl::OkStatus() : CannotWrite("standard output");
  }
  std::ofstream out(path, std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  return out ? absl::OkStatus() : CannotWrite(path);
}

absl::Status CheckWritable(const std::string& path) {
  if (path == kStandardStream) return absl::OkStatus();
  const std::filesystem::file_status there = std::filesystem::status(path);
  if (std::filesystem::exists(there) && !std::filesystem::is_regular_file(there) &&
      !std::filesystem::is_directory(there)) {
    return absl::OkStatus();  // a pipe or a device: opening it is already using it
  }
  const bool is_new = !std::filesystem::exists(there);
  const int file = open(path.c_str(), O_WRONLY | O_CLOEXEC | (is_new ? O_CREAT | O_EXCL : 0), 0666);
  if (file < 0) {
    const std::string problem = std::strerror(errno);
    return absl::NotFoundError(absl::StrCat("cannot write ", path, ": ", problem));
  }
  close(file);
  if (is_new) unlink(path.c_str());
  return absl::OkStatus();
}

std::string FileEnding(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

}  // namespace capfit::client
