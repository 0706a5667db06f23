// The words of the command line for the options' values.
#ifndef CAPFIT_CLIENT_OPTION_WORDS_H_
#define CAPFIT_CLIENT_OPTION_WORDS_H_

#include <string>
#include <utility>
#include <vector>

#include "core/export/export.h"
#include "core/pipeline/fit.h"

namespace capfit::client {

// In the order in which help shows them. A value's first word is the one that is shown; the others
// are understood too. (Capital letters, and '-' for '_', are understood everywhere.)
template <typename Value>
using Words = std::vector<std::pair<std::string, Value>>;

// The word that is shown for a value of `words`.
template <typename Value>
std::string WordOf(const Words<Value>& words, const Value& value) {
  for (const auto& [word, known] : words) {
    if (known == value) return word;
  }
  return "";
}

inline Words<pipeline::FitMode> FitModeWords() {
  return {{"enclose", pipeline::FitMode::kEnclose},
          {"best", pipeline::FitMode::kBestFit},
          {"best_fit", pipeline::FitMode::kBestFit}};
}
inline Words<pipeline::Quality> QualityWords() {
  Words<pipeline::Quality> words;
  for (int i = 0; i < pipeline::kQualityCount; ++i) {
    const auto quality = static_cast<pipeline::Quality>(i);
    words.emplace_back(pipeline::QualityName(quality), quality);
  }
  return words;
}
inline Words<pipeline::SkinningMode> SkinningWords() {
  return {{"none", pipeline::SkinningMode::kNone},
          {"dense", pipeline::SkinningMode::kDense},
          {"sparse", pipeline::SkinningMode::kSparse},
          {"bones", pipeline::SkinningMode::kBones}};
}
inline std::vector<std::string> ExportWords() {
  std::vector<std::string> words;
  for (const exports::ExportFormat& format : exports::ExportFormats()) {
    words.emplace_back(format.name);
  }
  return words;
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
          {"in", body::Unit::kInch},
          {"metre", body::Unit::kMetre},
          {"centimetre", body::Unit::kCentimetre},
          {"millimetre", body::Unit::kMillimetre},
          {"inch", body::Unit::kInch}};
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

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_OPTION_WORDS_H_
