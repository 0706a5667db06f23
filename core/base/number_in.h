// What command lines ask of their numbers.
#ifndef CAPFIT_CORE_BASE_NUMBER_IN_H_
#define CAPFIT_CORE_BASE_NUMBER_IN_H_

#include <functional>
#include <string>

namespace capfit {

// Says what is wrong with a text that is to be a number in [low, high], "" for nothing: "'nan' must
// be a number in [0.01, 60]". (CLI11's own check lets what is not a number pass.)
[[nodiscard]] std::function<std::string(const std::string&)> NumberIn(double low, double high);

// The same for the seeds of random numbers: a whole number from 0, below 2 to the 64th.
[[nodiscard]] std::function<std::string(const std::string&)> SeedCheck();

}  // namespace capfit

#endif  // CAPFIT_CORE_BASE_NUMBER_IN_H_
