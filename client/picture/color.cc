#include "client/picture/color.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace capfit::client {
namespace {

// Found by climbing on the least distance in Oklab between any two of them and kNotFitted, in
// normal sight and as Machado, Oliveira and Fernandes (2009) model the three kinds of dichromats,
// from colours that pair hues with sides: 0.107 at the least.
constexpr auto kPartColors = std::to_array<std::pair<const char*, std::array<float, 3>>>({
    {"torso", {.26f, .16f, .74f}},
    {"left_arm", {.91f, .72f, .37f}},
    {"right_arm", {.58f, .08f, .31f}},
    {"left_leg", {.16f, .55f, .47f}},
    {"right_leg", {.67f, .40f, .07f}},
    {"head", {.43f, .36f, .62f}},
    {"left_hand", {.83f, .99f, .41f}},
    {"right_hand", {.76f, .37f, .99f}},
    {"left_foot", {.33f, .88f, .99f}},
    {"right_foot", {.24f, .07f, .47f}},
});

Color Mix(const Color& a, const Color& b, double t) { return a + static_cast<float>(t) * (b - a); }

// Once around the colours, muted.
Color SpectralColor(double turn) {
  Color color;
  for (int k = 0; k < 3; ++k) {
    color[k] = static_cast<float>(
        0.58 + 0.26 * std::cos(2.0 * std::numbers::pi * (turn - static_cast<double>(k) / 3.0)));
  }
  return color;
}

}  // namespace

Color PartColor(const std::string& part, double shade) {
  Color color = SpectralColor(shade);
  for (const auto& [name, rgb] : kPartColors) {
    if (part == name) color = Color(rgb[0], rgb[1], rgb[2]);
  }
  return shade < 0.5 ? Mix(color, Color::Zero(), 0.10 * (1.0 - 2.0 * shade))
                     : Mix(color, Color::Ones(), 0.12 * (2.0 * shade - 1.0));
}

Color SignedColor(double value) {
  // At -1, 0, 1/4, 1/2 and 1.
  const Color covered(.13f, .30f, .68f);
  const std::array<Color, 4> ramp = {Color(.96f, .95f, .90f), Color(.98f, .82f, .50f),
                                     Color(.90f, .46f, .28f), Color(.55f, .04f, .16f)};
  const double t = std::clamp(value, -1.0, 1.0);
  if (t < 0.0) return Mix(ramp[0], covered, -t);
  if (t < 0.25) return Mix(ramp[0], ramp[1], 4.0 * t);
  if (t < 0.5) return Mix(ramp[1], ramp[2], 4.0 * t - 1.0);
  return Mix(ramp[2], ramp[3], 2.0 * t - 1.0);
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
