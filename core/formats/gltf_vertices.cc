#include "core/formats/gltf_vertices.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"

namespace capfit::formats {
namespace {

// Matrices are stored as floats and chains of ten joints multiply their rounding: a hundredth of a
// millimetre on a body, below what any fit notices.
constexpr double kSamePlace = 1e-5;

// Weights that sum to 1, or all 0.
void Normalise(std::array<float, 8>& weights) {
  double sum = 0.0;
  for (const float weight : weights) sum += weight;
  if (!(sum > 0.0)) return;
  for (float& weight : weights) weight = static_cast<float>(weight / sum);
}

float WeightFrom(double value) {
  return std::isfinite(value) && value > 0.0 ? static_cast<float>(std::min(value, 1e6)) : 0.0F;
}

}  // namespace

absl::StatusOr<std::vector<SkinInfluences>> ReadInfluences(std::span<const InfluenceSet> sets,
                                                           std::size_t count, const GltfSkin& skin,
                                                           const FilePlace& place) {
  std::vector<SkinInfluences> influences(count);
  for (std::size_t s = 0; s < sets.size(); ++s) {
    for (std::size_t v = 0; v < count; ++v) {
      for (std::size_t k = 0; k < 4; ++k) {
        const float weight = WeightFrom(sets[s].weights.At(v, k));
        if (!(weight > 0.0F)) continue;  // then exporters leave any joint there
        const double joint = sets[s].joints.At(v, k);
        if (!(joint < static_cast<double>(skin.joints.size()))) {
          return FileOutOfRange(place, absl::StrCat("JOINTS_", s, " of vertex ", v),
                                static_cast<std::uint64_t>(joint), IndexRange(skin.joints.size()));
        }
        influences[v].joint[4 * s + k] = static_cast<std::uint16_t>(joint);
        influences[v].weight[4 * s + k] = weight;
      }
    }
  }
  for (SkinInfluences& of_vertex : influences) Normalise(of_vertex.weight);
  return influences;
}

JointInfluences StrongestFour(const SkinInfluences& influences, const GltfSkin& skin) {
  std::array<std::size_t, 8> order{};
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto is_stronger = [&](std::size_t a, std::size_t b) {
    return influences.weight[a] > influences.weight[b] ||
           (influences.weight[a] == influences.weight[b] && a < b);
  };
  if (influences.weight[4] + influences.weight[5] + influences.weight[6] + influences.weight[7] >
      0.0F) {
    std::partial_sort(order.begin(), order.begin() + 4, order.end(), is_stronger);
  }
  JointInfluences strongest;
  double sum = 0.0;
  for (std::size_t k = 0; k < 4; ++k) sum += influences.weight[order[k]];
  for (std::size_t k = 0; k < 4 && sum > 0.0; ++k) {
    const float weight = influences.weight[order[k]];
    if (!(weight > 0.0F)) continue;
    strongest.joint[k] = skin.joints[influences.joint[order[k]]];
    strongest.weight[k] = static_cast<float>(weight / sum);
  }
  return strongest;
}

std::optional<Placing> CommonPlacing(std::span<const SkinInfluences> influences,
                                     const GltfSkin& skin, double largest) {
  std::vector<char> is_used(skin.placings.size(), 0);
  for (const SkinInfluences& of_vertex : influences) {
    for (std::size_t k = 0; k < of_vertex.weight.size(); ++k) {
      if (of_vertex.weight[k] > 0.0F) is_used[of_vertex.joint[k]] = 1;
    }
  }
  std::optional<Placing> common = skin.first_placing;
  for (std::size_t j = 0; j < is_used.size(); ++j) {
    if (!is_used[j] || !skin.is_placing[j]) continue;
    if (!common.has_value()) common = skin.placings[j];
    const Placing difference = (skin.placings[j] - *common).cwiseAbs();
    const double off = difference.leftCols<3>().maxCoeff() * largest + difference.col(3).maxCoeff();
    const double scale = common->leftCols<3>().cwiseAbs().maxCoeff();
    if (!(off <= kSamePlace * scale * largest)) return std::nullopt;
  }
  return common;
}

Eigen::Vector3d Skinned(const Eigen::Vector3d& stored, const SkinInfluences& influences,
                        const GltfSkin& skin, const Placing& fallback) {
  Placing blended = Placing::Zero();
  double sum = 0.0;
  for (std::size_t k = 0; k < influences.weight.size(); ++k) {
    const double weight = influences.weight[k];
    if (!(weight > 0.0) || !skin.is_placing[influences.joint[k]]) continue;
    blended += weight * skin.placings[influences.joint[k]];
    sum += weight;
  }
  if (!(sum > 0.0)) return fallback.leftCols<3>() * stored + fallback.col(3);
  return (blended.leftCols<3>() * stored + blended.col(3)) / sum;
}

}  // namespace capfit::formats
