#ifndef CAPFIT_TESTS_SUPPORT_SCRATCH_H_
#define CAPFIT_TESTS_SUPPORT_SCRATCH_H_

#include <string>

namespace capfit::test_support {

// A folder of its own, removed with everything in it when the object goes. No two objects share
// one, whatever tests and processes run beside each other.
class Scratch {
 public:
  Scratch();
  ~Scratch();
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  [[nodiscard]] const std::string& folder() const { return folder_; }
  [[nodiscard]] std::string Path(const std::string& name) const { return folder_ + "/" + name; }

 private:
  std::string folder_;
};

}  // namespace capfit::test_support

#endif  // CAPFIT_TESTS_SUPPORT_SCRATCH_H_
