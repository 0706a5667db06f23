#include "server/file_watch.h"

#include <sys/stat.h>

#include <utility>

namespace capfit::server {

namespace {
constexpr std::chrono::seconds kBetweenLooks{1};
}

FileWatch::FileWatch(std::vector<std::string> paths)
    : paths_(std::move(paths)), stamps_(Look()), last_look_(std::chrono::steady_clock::now()) {}

bool FileWatch::HasChanged() {
  const auto now = std::chrono::steady_clock::now();
  if (now - last_look_ < kBetweenLooks) return false;
  last_look_ = now;
  std::vector<Stamp> stamps = Look();
  if (stamps == stamps_) return false;
  stamps_ = std::move(stamps);
  return true;
}

std::vector<FileWatch::Stamp> FileWatch::Look() const {
  std::vector<Stamp> stamps;
  for (const std::string& path : paths_) {
    struct stat facts = {};
    if (path.empty() || stat(path.c_str(), &facts) != 0) {
      stamps.emplace_back();
    } else {
      stamps.push_back(
          {facts.st_dev, facts.st_ino, facts.st_size, facts.st_mtim.tv_sec, facts.st_mtim.tv_nsec});
    }
  }
  return stamps;
}

}  // namespace capfit::server
