// The words of the command line for the options' values.
#ifndef CAPFIT_CLIENT_OPTION_WORDS_H_
#define CAPFIT_CLIENT_OPTION_WORDS_H_

#include <map>
#include <string>

#include "core/pipeline/fit.h"

namespace capfit::client {

// For CLI::CheckedTransformer, and to go through all the words.
template <typename Value>
using Words = std::map<std::string, Value>;

inline Words<pipeline::FitMode> FitModeWords() {
  return {{"enclose", pipeline::FitMode::kEnclose}, {"best", pipeline::FitMode::kBestFit}};
}
inline Words<pipeline::Quality> QualityWords() {
  return {{"paper", pipeline::Quality::kPaper}, {"tight", pipeline::Quality::kTight}};
}
inline Words<pipeline::SkinningMode> SkinningWords() {
  return {{"none", pipeline::SkinningMode::kNone}, {"dense", pipeline::SkinningMode::kDense}};
}
inline Words<section::Sex> SexWords() {
  return {{"auto", section::Sex::kAuto},
          {"female", section::Sex::kFemale},
          {"male", section::Sex::kMale}};
}
inline Words<body::Unit> UnitWords() {
  return {{"auto", body::Unit::kAuto},
          {"m", body::Unit::kMetre},
          {"cm", body::Unit::kCentimetre},
          {"mm", body::Unit::kMillimetre},
          {"in", body::Unit::kInch}};
}
inline Words<body::UpAxis> UpWords() {
  return {{"auto", body::UpAxis::kAuto},
          {"x", body::UpAxis::kX},
          {"y", body::UpAxis::kY},
          {"z", body::UpAxis::kZ}};
}
inline Words<bool body::PartSelection::*> PartWords() {
  return {{"torso", &body::PartSelection::torso}, {"arms", &body::PartSelection::arms},
          {"legs", &body::PartSelection::legs},   {"head", &body::PartSelection::head},
          {"hands", &body::PartSelection::hands}, {"feet", &body::PartSelection::feet}};
}

// The same word for a value, for showing it.
template <typename Value>
[[nodiscard]] std::string WordOf(const Words<Value>& words, const Value& value) {
  for (const auto& [word, known] : words) {
    if (known == value) return word;
  }
  return "?";
}

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_OPTION_WORDS_H_
