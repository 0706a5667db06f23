// What capfit noticed and repaired or left out: never silent, never fatal.
#ifndef CAPFIT_CORE_BASE_WARNING_H_
#define CAPFIT_CORE_BASE_WARNING_H_

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace capfit {

// One thing the caller should know about the input or the result.
struct Warning {
  std::string code;        // stable UPPER_SNAKE_CASE word, e.g. "HOLES_CLOSED"
  std::string message;     // one sentence: what, where, how many, and the next step if there is one
  std::int64_t count = 0;  // how many of it; 0 where counting makes no sense
};

inline void Append(std::vector<Warning> more, std::vector<Warning>& warnings) {
  for (Warning& warning : more) warnings.push_back(std::move(warning));
}

}  // namespace capfit

#endif  // CAPFIT_CORE_BASE_WARNING_H_
