// Words and numbers of USD layers in text.
#ifndef CAPFIT_CORE_EXPORT_USD_TEXT_H_
#define CAPFIT_CORE_EXPORT_USD_TEXT_H_

#include <Eigen/Geometry>
#include <string>

namespace capfit::exports {

// "(1, 2, 3)"
[[nodiscard]] std::string UsdVector(const Eigen::Vector3d& vector);
// "(w, x, y, z)"
[[nodiscard]] std::string UsdQuaternion(const Eigen::Quaterniond& q);
// In quotes, with what would end the string escaped; control characters as spaces, bytes that are
// no UTF-8 as U+FFFD.
[[nodiscard]] std::string UsdString(const std::string& text);

// An identifier: letters, digits and '_', which stands for all else, no digit in front. Several
// names may give one: see UniqueNames.
[[nodiscard]] std::string UsdIdentifier(const std::string& name);

}  // namespace capfit::exports

#endif  // CAPFIT_CORE_EXPORT_USD_TEXT_H_
