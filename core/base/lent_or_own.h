// An array that somebody else keeps, where it can be taken as it is, or one of one's own.
#ifndef CAPFIT_CORE_BASE_LENT_OR_OWN_H_
#define CAPFIT_CORE_BASE_LENT_OR_OWN_H_

#include <cassert>
#include <cstddef>
#include <span>
#include <vector>

namespace capfit {

// Read like a span. Whose array is lent keeps it, unchanged, as long as this and its copies are
// read.
template <typename T>
class LentOrOwn {
 public:
  LentOrOwn() = default;  // own, empty
  [[nodiscard]] static LentOrOwn Lent(std::span<const T> array) {
    LentOrOwn lent;
    lent.lent_ = array;
    lent.is_lent_ = true;
    return lent;
  }

  operator std::span<const T>() const { return view(); }
  [[nodiscard]] std::span<const T> view() const {
    return is_lent_ ? lent_ : std::span<const T>(own_);
  }
  // To be changed; only where nothing is lent.
  [[nodiscard]] std::vector<T>& own() {
    assert(!is_lent_);
    return own_;
  }

  [[nodiscard]] std::size_t size() const { return view().size(); }
  [[nodiscard]] bool empty() const { return view().empty(); }
  [[nodiscard]] const T& operator[](std::size_t i) const { return view()[i]; }
  [[nodiscard]] auto begin() const { return view().begin(); }
  [[nodiscard]] auto end() const { return view().end(); }

 private:
  bool is_lent_ = false;
  std::span<const T> lent_;
  std::vector<T> own_;
};

}  // namespace capfit

#endif  // CAPFIT_CORE_BASE_LENT_OR_OWN_H_
