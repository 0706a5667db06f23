// Words and numbers as files of engines can hold them, whatever a rig or a file name has in it.
#ifndef CAPFIT_CORE_EXPORT_FILE_TEXT_H_
#define CAPFIT_CORE_EXPORT_FILE_TEXT_H_

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "core/export/collider_set.h"
#include "core/export/frame.h"

namespace capfit::exports {

// Of every file here; raised when a reader of older files would misread a new one.
inline constexpr int kFormatVersion = 1;

// What every file says of itself: keys and values, in the order to be written: "format",
// "format_version", "capfit" (its version), "source", "frame", "axis", "profile".
using Statement = std::vector<std::pair<std::string, std::string>>;

// `axis`: a sentence on how capsules lie in their own frame.
[[nodiscard]] Statement StatementOf(const ColliderSet& set, const std::string& format,
                                    const Frame& frame, const std::string& axis);

// One "key: value" a line, each between `before` and `after`; in CommentText.
[[nodiscard]] std::string StatementLines(const Statement& statement, const std::string& before,
                                         const std::string& after);

// The shortest decimal that reads back to the same bits: "0.1", "1e-05"; for a float with a point
// or an exponent in any case: "1.0".
[[nodiscard]] std::string NumberText(double number);
[[nodiscard]] std::string FloatText(double number);
// Three numbers with spaces between.
[[nodiscard]] std::string NumbersText(const Eigen::Vector3d& numbers);

// For attributes and text of XML: UTF-8, & < > " ' as entities, control characters as '_'.
[[nodiscard]] std::string XmlText(const std::string& text);
// For comments of C, Python, XML and CSV, which it can neither end nor continue: printable ASCII
// without '*' and '\', no "--"; other bytes as '_'.
[[nodiscard]] std::string CommentText(const std::string& text);
// A string of C, quotes included: printable ASCII as it is, other bytes in octal.
[[nodiscard]] std::string CStringText(const std::string& text);
// A field of a CSV file, in quotes where it must be.
[[nodiscard]] std::string CsvText(const std::string& text);

// Names of which no two are the same and none is empty: an empty one becomes `unnamed` with its
// index ("joint_4"), one that is there already gets "_2", "_3" ... behind it.
[[nodiscard]] std::vector<std::string> UniqueNames(std::vector<std::string> names,
                                                   const std::string& unnamed);

// UniqueNames of the set's joints.
[[nodiscard]] std::vector<std::string> JointNames(const ColliderSet& set);

}  // namespace capfit::exports

#endif  // CAPFIT_CORE_EXPORT_FILE_TEXT_H_
