#include "client/text_width.h"

#include <clocale>
#include <cwchar>
#include <memory>
#include <type_traits>

namespace capfit::client {
namespace {

using Locale = std::unique_ptr<std::remove_pointer_t<locale_t>, decltype(&freelocale)>;

// The C library knows the widths of letters, in locales that have them; the one that has them
// everywhere holds for this thread alone, and only so long.
class WithLetters {
 public:
  WithLetters() : locale_(newlocale(LC_CTYPE_MASK, "C.UTF-8", nullptr), &freelocale) {
    if (locale_) before_ = uselocale(locale_.get());
  }
  ~WithLetters() {
    if (locale_) uselocale(before_);
  }
  WithLetters(const WithLetters&) = delete;
  WithLetters& operator=(const WithLetters&) = delete;

 private:
  Locale locale_;
  locale_t before_ = nullptr;
};

}  // namespace

std::size_t TextWidth(const std::string& text) {
  const WithLetters with_letters;
  std::size_t width = 0;
  std::mbstate_t state{};
  for (std::size_t i = 0; i < text.size();) {
    wchar_t letter = 0;
    const std::size_t bytes = std::mbrtowc(&letter, text.data() + i, text.size() - i, &state);
    if (bytes == 0 || bytes > text.size() - i) {
      state = {};
      ++width;
      ++i;
      continue;
    }
    const int columns = wcwidth(letter);
    width += columns < 0 ? 1 : static_cast<std::size_t>(columns);
    i += bytes;
  }
  return width;
}

}  // namespace capfit::client
