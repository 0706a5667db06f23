#include "core/tighten/normal_blocks.h"

namespace capfit::tighten {

void NormalBlocks::Take(Eigen::Index variables, const RowLayout& layout) {
  Ties ties;
  ties.reserve(layout.groups.size());
  for (const RowGroup& group : layout.groups) ties.emplace_back(group.first_a, group.first_b);
  blocks_.resize(ties.size());
  if (variables == variables_ && ties == ties_) return;
  variables_ = variables;
  ties_ = std::move(ties);
  PlaceAll();
}

void NormalBlocks::PlaceAll() {
  Ties pairs;
  for (const auto& tie : ties_) {
    if (tie.second >= 0) pairs.push_back(tie);
  }
  matrix_ = NormalMatrix(variables_, pairs);
  places_.clear();
  for (const auto& [a, b] : ties_) {
    Places& places = places_.emplace_back();
    places.a = matrix_.PlaceOf(a, a);
    if (b < 0) continue;
    places.b = matrix_.PlaceOf(b, b);
    places.across = matrix_.PlaceOf(b, a);
  }
}

void NormalBlocks::Factorise(const Eigen::VectorXd& diagonal) {
  matrix_.Reset(diagonal);
  for (std::size_t g = 0; g < blocks_.size(); ++g) {
    matrix_.Add(places_[g].a, blocks_[g].a);
    if (ties_[g].second < 0) continue;
    matrix_.Add(places_[g].b, blocks_[g].b);
    matrix_.Add(places_[g].across, blocks_[g].across);
  }
  matrix_.Factorise();
}

}  // namespace capfit::tighten
