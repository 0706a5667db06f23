// The kept inputs of a fuzzer.
#ifndef CAPFIT_TESTS_CORE_MESH_CORPUS_H_
#define CAPFIT_TESTS_CORE_MESH_CORPUS_H_

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace capfit::fuzz {

// Seeds and findings of the target fuzz_NAME, sorted by name.
inline std::vector<std::filesystem::path> Corpus(const std::string& target) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(CAPFIT_FUZZ_CORPUS) / target)) {
    files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace capfit::fuzz

#endif  // CAPFIT_TESTS_CORE_MESH_CORPUS_H_
