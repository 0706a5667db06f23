#include "client/picture/color.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace capfit::client {
namespace {

constexpr auto kPartColors = std::to_array<std::pair<const char*, std::array<float, 3>>>({
    {"torso", {.30f, .52f, .78f}},
    {"left_arm", {.93f, .58f, .24f}},
    {"right_arm", {.86f, .40f, .34f}},
    {"left_leg", {.32f, .68f, .52f}},
    {"right_leg", {.52f, .66f, .28f}},
    {"head", {.62f, .48f, .76f}},
    {"left_hand", {.95f, .78f, .38f}},
    {"right_hand", {.92f, .60f, .56f}},
    {"left_foot", {.22f, .56f, .60f}},
    {"right_foot", {.42f, .54f, .34f}},
});

Color Mix(const Color& a, const Color& b, double t) { return a + static_cast<float>(t) * (b - a); }

}  // namespace

Color PartColor(const std::string& part, double shade) {
  Color color(.55f, .57f, .62f);
  for (const auto& [name, rgb] : kPartColors) {
    if (part == name) color = Color(rgb[0], rgb[1], rgb[2]);
  }
  return shade < 0.5 ? Mix(color, Color::Zero(), 0.16 * (1.0 - 2.0 * shade))
                     : Mix(color, Color::Ones(), 0.36 * (2.0 * shade - 1.0));
}

Color SignedColor(double value) {
  const Color inside(.13f, .30f, .68f);
  const Color middle(.96f, .95f, .90f);
  const Color far(.72f, .07f, .13f);
  const double t = std::clamp(value, -1.0, 1.0);
  // The square root spreads the small gaps, which are most of them.
  return t < 0 ? Mix(middle, inside, std::sqrt(-t)) : Mix(middle, far, std::sqrt(t));
}

Color Lit(const Color& color, const Eigen::Vector3d& normal) {
  static const Eigen::Vector3d kKey = Eigen::Vector3d(-0.45, 0.60, 0.72).normalized();
  static const Eigen::Vector3d kFill = Eigen::Vector3d(0.75, 0.10, 0.55).normalized();
  const double diffuse = 0.56 * std::max(0.0, normal.dot(kKey)) +
                         0.16 * std::max(0.0, normal.dot(kFill)) + 0.10 * (1.0 + normal.y());
  const double facing = std::max(0.0, normal.z());
  const double light = 0.24 + diffuse + 0.12 * facing;
  const Eigen::Vector3d half = (kKey + Eigen::Vector3d::UnitZ()).normalized();
  const double shine = 0.10 * std::pow(std::max(0.0, normal.dot(half)), 24);
  return (color * static_cast<float>(light) + Color::Constant(static_cast<float>(shine)))
      .cwiseMin(1.0f);
}

}  // namespace capfit::client
