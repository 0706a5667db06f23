// Words and numbers of USD layers in text.
#ifndef CAPFIT_CORE_EXPORT_USD_TEXT_H_
#define CAPFIT_CORE_EXPORT_USD_TEXT_H_

#include <Eigen/Geometry>
#include <set>
#include <string>

namespace capfit::exports {

// The shortest decimal that reads back to the same double.
[[nodiscard]] std::string UsdNumber(double number);
// "(1, 2, 3)"
[[nodiscard]] std::string UsdVector(const Eigen::Vector3d& vector);
// "(w, x, y, z)"
[[nodiscard]] std::string UsdQuaternion(const Eigen::Quaterniond& q);
// In quotes, with what would end the string escaped; control characters as spaces.
[[nodiscard]] std::string UsdString(const std::string& text);

// Identifiers of which no two are the same: letters, digits and '_', no digit in front; "_2", "_3"
// ... behind those that are there already.
class UsdNames {
 public:
  [[nodiscard]] std::string Add(const std::string& name);

 private:
  std::set<std::string> taken_;
};

}  // namespace capfit::exports

#endif  // CAPFIT_CORE_EXPORT_USD_TEXT_H_
