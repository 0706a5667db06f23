// Fuzz bytes handed out one after the other.
#ifndef CAPFIT_TESTS_FUZZ_BYTE_SOURCE_H_
#define CAPFIT_TESTS_FUZZ_BYTE_SOURCE_H_

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace capfit::fuzz {

// Zeros when the bytes are used up.
class ByteSource {
 public:
  explicit ByteSource(std::span<const std::byte> bytes) : bytes_(bytes) {}

  [[nodiscard]] bool IsEmpty() const { return bytes_.empty(); }
  std::uint8_t Next() {
    if (bytes_.empty()) return 0;
    const auto value = static_cast<std::uint8_t>(bytes_.front());
    bytes_ = bytes_.subspan(1);
    return value;
  }
  std::int8_t NextSigned() { return static_cast<std::int8_t>(Next()); }
  std::uint32_t NextWord() {
    const std::uint32_t low = Next();
    return low | static_cast<std::uint32_t>(Next()) << 8;
  }
  // The next `count` bytes, or what is left of them.
  std::span<const std::byte> Take(std::size_t count) {
    const std::span<const std::byte> taken = bytes_.first(std::min(count, bytes_.size()));
    bytes_ = bytes_.subspan(taken.size());
    return taken;
  }

 private:
  std::span<const std::byte> bytes_;
};

}  // namespace capfit::fuzz

#endif  // CAPFIT_TESTS_FUZZ_BYTE_SOURCE_H_
