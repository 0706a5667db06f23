// Whether files have changed since they were last looked at.
#ifndef CAPFIT_SERVER_FILE_WATCH_H_
#define CAPFIT_SERVER_FILE_WATCH_H_

#include <chrono>
#include <string>
#include <vector>

namespace capfit::server {

// Looks at most once a second, so that asking costs nothing in front of every call. Sees files that
// were written anew, replaced by a rename, or reached by another link, as Kubernetes swaps mounted
// secrets. Not safe from several threads at once.
class FileWatch {
 public:
  // The state at this moment is the first one. Empty paths are left out.
  explicit FileWatch(std::vector<std::string> paths);

  // Whether anything is different from what it was when this last said so.
  [[nodiscard]] bool HasChanged();

 private:
  // Place, size and time of one file; all 0 where there is none.
  struct Stamp {
    unsigned long device = 0;
    unsigned long inode = 0;
    long size = 0;
    long seconds = 0;
    long nanoseconds = 0;
    bool operator==(const Stamp&) const = default;
  };
  [[nodiscard]] std::vector<Stamp> Look() const;

  const std::vector<std::string> paths_;
  std::vector<Stamp> stamps_;
  std::chrono::steady_clock::time_point last_look_;
};

}  // namespace capfit::server

#endif  // CAPFIT_SERVER_FILE_WATCH_H_
