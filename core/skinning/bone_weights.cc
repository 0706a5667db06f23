#include "core/skinning/bone_weights.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "core/mesh/nearest_vertex.h"
#include "core/skinning/linear_precision.h"

namespace capfit::skinning {
namespace {

using formats::JointInfluences;
using formats::NamedJoint;
using formats::Placing;

bool IsInvertible(const Placing& placing) {
  return placing.allFinite() && std::abs(placing.leftCols<3>().determinant()) > 0.0;
}

Placing Inverse(const Placing& placing) {
  Placing inverse;
  inverse.leftCols<3>() = placing.leftCols<3>().inverse();
  inverse.col(3) = -inverse.leftCols<3>() * placing.col(3);
  return inverse;
}

Placing Product(const Placing& a, const Placing& b) {
  Placing product;
  product.leftCols<3>() = a.leftCols<3>() * b.leftCols<3>();
  product.col(3) = a.leftCols<3>() * b.col(3) + a.col(3);
  return product;
}

Eigen::Vector3d Place(const Placing& placing, const Eigen::Vector3d& point) {
  return placing.leftCols<3>() * point + placing.col(3);
}

// What a joint does to vertices as they are stored.
struct Carrier {
  bool may_carry = false;
  Placing to_mesh;
  Placing from_bind;  // inverse of its bind
  Placing moves;      // to_mesh * from_bind
};

std::vector<Carrier> CarriersOf(std::span<const NamedJoint> joints) {
  std::vector<Carrier> carriers;
  for (const NamedJoint& joint : joints) {
    Carrier carrier;
    carrier.may_carry = IsInvertible(joint.to_mesh) && IsInvertible(joint.bind);
    if (carrier.may_carry) {
      carrier.to_mesh = joint.to_mesh;
      carrier.from_bind = Inverse(joint.bind);
      carrier.moves = Product(joint.to_mesh, carrier.from_bind);
    }
    carriers.push_back(carrier);
  }
  return carriers;
}

// Which joints hold a vertex, and where in their frames.
class Holders {
 public:
  explicit Holders(const formats::PolygonSoup& soup)
      : soup_(soup), carriers_(CarriersOf(soup.joints)) {
    for (std::size_t v = 0; v < soup.influences.size(); ++v) {
      if (!IsHeld(soup.influences[v])) continue;
      held_.push_back(static_cast<std::uint32_t>(v));
      held_positions_.push_back(soup.positions[v]);
    }
    if (!held_.empty()) nearest_.emplace(held_positions_);
  }

  [[nodiscard]] bool empty() const { return held_.empty(); }
  [[nodiscard]] const Carrier& carrier(std::uint16_t joint) const { return carriers_[joint]; }

  struct Held {
    std::size_t count = 0;
    std::array<std::uint16_t, 4> joints{};
    std::array<double, 4> weights{};  // sum 1
    Eigen::Vector3d stored = Eigen::Vector3d::Zero();
    bool has_stored = true;
  };

  [[nodiscard]] Held Of(std::uint32_t vertex) const {
    const bool is_held = IsHeld(soup_.influences[vertex]);
    const std::uint32_t holder = is_held ? vertex : held_[nearest_->At(soup_.positions[vertex])];
    Held held;
    double sum = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
      if (!Holds(soup_.influences[holder], k)) continue;
      held.joints[held.count] = soup_.influences[holder].joint[k];
      held.weights[held.count] = soup_.influences[holder].weight[k];
      sum += held.weights[held.count++];
    }
    Placing moves = Placing::Zero();
    for (std::size_t k = 0; k < held.count; ++k) {
      held.weights[k] /= sum;
      moves += held.weights[k] * carriers_[held.joints[k]].moves;
    }
    held.has_stored = IsInvertible(moves);
    if (held.has_stored) held.stored = Place(Inverse(moves), soup_.positions[vertex]);
    return held;
  }

 private:
  [[nodiscard]] bool Holds(const JointInfluences& influences, std::size_t k) const {
    return influences.weight[k] > 0.0F && influences.joint[k] < carriers_.size() &&
           carriers_[influences.joint[k]].may_carry;
  }
  [[nodiscard]] bool IsHeld(const JointInfluences& influences) const {
    return Holds(influences, 0) || Holds(influences, 1) || Holds(influences, 2) ||
           Holds(influences, 3);
  }

  const formats::PolygonSoup& soup_;
  std::vector<Carrier> carriers_;
  std::vector<std::uint32_t> held_;
  std::vector<Eigen::Vector3d> held_positions_;
  std::optional<mesh::NearestVertex> nearest_;
};

// What a joint has of a centre: the weight, and the weighted sum of places in its frame.
struct Share {
  double weight = 0.0;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
};

std::map<std::uint16_t, Share> SharesOf(const SparseWeights& sparse, std::size_t sphere,
                                        const formats::PolygonSoup& soup, const Holders& holders) {
  std::map<std::uint16_t, Share> shares;
  for (std::size_t i = sparse.RowBegin(sphere); i < sparse.row_ends[sphere]; ++i) {
    const Holders::Held held = holders.Of(sparse.vertices[i]);
    for (std::size_t k = 0; k < held.count; ++k) {
      const Carrier& carrier = holders.carrier(held.joints[k]);
      const Eigen::Vector3d place =
          held.has_stored ? Place(carrier.from_bind, held.stored)
                          : Place(Inverse(carrier.to_mesh), soup.positions[sparse.vertices[i]]);
      const double weight = static_cast<double>(sparse.weights[i]) * held.weights[k];
      Share& share = shares[held.joints[k]];
      share.weight += weight;
      share.moment += weight * place;
    }
  }
  return shares;
}

// How many joints are above it.
std::size_t DepthOf(std::uint16_t joint, std::span<const NamedJoint> joints) {
  std::size_t depth = 0;
  for (std::int32_t above = joints[joint].parent; above >= 0 && depth < joints.size(); ++depth) {
    above = joints[above].parent;
  }
  return depth;
}

// Hands what joints below kLeastBoneWeight have on to the joint above them, with which they mostly
// move: fingers to the hand. The lowest first.
void HandOnSmall(std::map<std::uint16_t, Share>& shares, std::span<const NamedJoint> joints,
                 const Holders& holders) {
  std::set<std::pair<std::size_t, std::uint16_t>> lowest_last;
  for (const auto& [joint, share] : shares) lowest_last.emplace(DepthOf(joint, joints), joint);
  while (!lowest_last.empty()) {
    const std::uint16_t joint = lowest_last.rbegin()->second;
    lowest_last.erase(std::prev(lowest_last.end()));
    const std::int32_t above = joints[joint].parent;
    const Share share = shares[joint];
    if (std::abs(share.weight) >= kLeastBoneWeight || above < 0) continue;
    const auto parent = static_cast<std::uint16_t>(above);
    if (!holders.carrier(parent).may_carry) continue;
    const Placing to_parent =
        Product(Inverse(holders.carrier(parent).to_mesh), holders.carrier(joint).to_mesh);
    shares.erase(joint);
    const bool is_new = !shares.contains(parent);
    shares[parent].weight += share.weight;
    shares[parent].moment +=
        to_parent.leftCols<3>() * share.moment + share.weight * to_parent.col(3);
    // (A ring of parents comes to its end: each joint is looked at once more at most.)
    if (is_new && DepthOf(parent, joints) < DepthOf(joint, joints)) {
      lowest_last.emplace(DepthOf(parent, joints), parent);
    }
  }
}

// Only those that matter; at least the one with the most.
void DropSmall(std::map<std::uint16_t, Share>& shares) {
  const auto is_less = [](const auto& a, const auto& b) {
    return a.second.weight < b.second.weight;
  };
  const std::uint16_t largest = std::max_element(shares.begin(), shares.end(), is_less)->first;
  std::erase_if(shares, [largest](const auto& share) {
    return share.first != largest && std::abs(share.second.weight) < kLeastBoneWeight;
  });
}

void AppendRow(const std::map<std::uint16_t, Share>& shares, const Eigen::Vector3d& center,
               const Holders& holders, BoneWeights& result) {
  double sum = 0.0;
  for (const auto& [joint, share] : shares) sum += share.weight;
  const std::size_t begin = result.weights.size();
  for (const auto& [joint, share] : shares) {
    result.joints.push_back(joint);
    result.weights.push_back(static_cast<float>(share.weight / sum));
    result.offsets.emplace_back(share.moment / share.weight);
  }
  const std::span<float> row = std::span(result.weights).subspan(begin);
  MendFloatSum(row);
  Eigen::Vector3d missing = center;
  double row_sum = 0.0;
  for (std::size_t k = 0; k < row.size(); ++k) {
    const Placing& to_mesh = holders.carrier(result.joints[begin + k]).to_mesh;
    missing -= static_cast<double>(row[k]) * Place(to_mesh, result.offsets[begin + k]);
    row_sum += row[k];
  }
  for (std::size_t k = begin; k < result.offsets.size(); ++k) {
    const Placing& to_mesh = holders.carrier(result.joints[k]).to_mesh;
    result.offsets[k] += to_mesh.leftCols<3>().inverse() * missing / row_sum;
  }
  result.row_ends.push_back(static_cast<std::uint32_t>(result.joints.size()));
}

}  // namespace

std::optional<BoneWeights> BonesOfSparse(const SparseWeights& sparse,
                                         std::span<const Eigen::Vector3d> centers,
                                         const formats::PolygonSoup& soup) {
  if (soup.influences.size() != soup.positions.size()) return std::nullopt;
  const Holders holders(soup);
  if (holders.empty()) return std::nullopt;
  BoneWeights result;
  result.joint_count = soup.joints.size();
  for (std::size_t s = 0; s < sparse.sphere_count(); ++s) {
    std::map<std::uint16_t, Share> shares = SharesOf(sparse, s, soup, holders);
    if (shares.empty()) return std::nullopt;  // cancelled
    HandOnSmall(shares, soup.joints, holders);
    DropSmall(shares);
    AppendRow(shares, centers[s], holders, result);
  }
  return result;
}

std::vector<Eigen::Vector3d> Apply(const BoneWeights& weights, std::span<const Placing> to_mesh) {
  assert(to_mesh.size() == weights.joint_count);
  std::vector<Eigen::Vector3d> centers(weights.sphere_count(), Eigen::Vector3d::Zero());
  for (std::size_t s = 0; s < centers.size(); ++s) {
    for (std::size_t i = weights.RowBegin(s); i < weights.row_ends[s]; ++i) {
      centers[s] += static_cast<double>(weights.weights[i]) *
                    Place(to_mesh[weights.joints[i]], weights.offsets[i]);
    }
  }
  return centers;
}

}  // namespace capfit::skinning
