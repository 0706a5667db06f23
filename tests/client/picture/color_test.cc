#include "client/picture/color.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/body/anatomy.h"

namespace capfit::client {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d Rows(const std::array<double, 9>& n) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(n.data());
}

// How dichromats see linear RGB: Machado, Oliveira and Fernandes, 2009, severity 1.
std::vector<std::pair<std::string, Matrix3d>> Eyes() {
  return {{"trichromat", Matrix3d::Identity()},
          {"protanope", Rows({0.152286, 1.052583, -0.204868, 0.114503, 0.786281, 0.099216,
                              -0.003882, -0.048116, 1.051998})},
          {"deuteranope", Rows({0.367322, 0.860646, -0.227968, 0.280085, 0.672501, 0.047413,
                                -0.011820, 0.042940, 0.968881})},
          {"tritanope", Rows({1.255528, -0.076749, -0.178779, -0.078411, 0.930809, 0.147602,
                              0.004733, 0.691367, 0.303900})}};
}

double Linear(double channel) {
  return channel <= 0.04045 ? channel / 12.92 : std::pow((channel + 0.055) / 1.055, 2.4);
}

// Ottosson's Oklab, in which distances are about as large as they look.
Vector3d Oklab(const Color& color, const Matrix3d& eye) {
  const Vector3d seen = eye * color.cast<double>().unaryExpr(&Linear);
  const Vector3d light = seen.cwiseMax(0.0).cwiseMin(1.0);
  const Matrix3d cones = Rows({0.4122214708, 0.5363325363, 0.0514459929, 0.2119034982, 0.6806995451,
                               0.1073969566, 0.0883024619, 0.2817188376, 0.6299787005});
  const Matrix3d lab = Rows({0.2104542553, 0.7936177850, -0.0040720468, 1.9779984951, -2.4285922050,
                             0.4505937099, 0.0259040371, 0.7827717662, -0.8086757660});
  return lab * (cones * light).cwiseMax(0.0).unaryExpr([](double x) { return std::cbrt(x); });
}

std::vector<std::pair<std::string, Color>> LegendColors() {
  std::vector<std::pair<std::string, Color>> colors = {{"not fitted", kNotFitted}};
  for (int p = 0; p < body::kPartCount; ++p) {
    const std::string name(body::PartName(static_cast<body::Part>(p)));
    colors.emplace_back(name, PartColor(name, 0.5));
  }
  return colors;
}

TEST(ColorTest, RampIsContinuousAndClamped) {
  EXPECT_EQ(SignedColor(2.0), SignedColor(1.0));
  EXPECT_EQ(SignedColor(-2.0), SignedColor(-1.0));
  for (double value = -1.0; value < 1.0; value += 0.001) {
    EXPECT_LT((SignedColor(value + 0.001) - SignedColor(value)).norm(), 0.01);
  }
}

TEST(ColorTest, PartsAreToldApartByAllEyes) {
  const auto colors = LegendColors();
  ASSERT_EQ(colors.size(), 11u);
  for (const auto& [eye, matrix] : Eyes()) {
    for (std::size_t i = 0; i < colors.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const double distance =
            (Oklab(colors[i].second, matrix) - Oklab(colors[j].second, matrix)).norm();
        EXPECT_GT(distance, 0.1) << eye << ": " << colors[i].first << ", " << colors[j].first;
      }
    }
  }
}

TEST(ColorTest, EndsOfTheGapBarAreToldApartByAllEyes) {
  for (const auto& [eye, matrix] : Eyes()) {
    const Vector3d out = Oklab(SignedColor(-1.0), matrix);
    const Vector3d covered = Oklab(SignedColor(1.0), matrix);
    const Vector3d touching = Oklab(SignedColor(0.0), matrix);
    EXPECT_GT((out - covered).norm(), 0.1) << eye;
    EXPECT_GT((out - touching).norm(), 0.3) << eye;
    EXPECT_GT((covered - touching).norm(), 0.3) << eye;
  }
}

TEST(ColorTest, ShadesOfAPartStayNearestToItsOwnColour) {
  const auto colors = LegendColors();
  for (const auto& [part, unused] : colors) {
    if (part == "not fitted") continue;
    for (const double shade : {0.0, 0.25, 0.75, 1.0}) {
      const Vector3d drawn = Oklab(PartColor(part, shade), Matrix3d::Identity());
      std::pair<double, std::string> nearest = {1e9, ""};
      for (const auto& [name, color] : colors) {
        const double distance = (Oklab(color, Matrix3d::Identity()) - drawn).norm();
        nearest = std::min(nearest, {distance, name});
      }
      EXPECT_EQ(nearest.second, part) << shade;
    }
  }
}

}  // namespace
}  // namespace capfit::client
