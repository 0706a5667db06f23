// The normal matrix of a penalty programme as its groups of rows add to it.
#ifndef CAPFIT_CORE_TIGHTEN_NORMAL_BLOCKS_H_
#define CAPFIT_CORE_TIGHTEN_NORMAL_BLOCKS_H_

#include <Eigen/Core>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/tighten/normal_matrix.h"
#include "core/tighten/row_table.h"

namespace capfit::tighten {

// What each group of rows adds to the matrix, to be set by any thread, and the matrix itself. It
// finds its places and its order of elimination once for all programmes that tie the same
// variables, as those of successive steps mostly do.
class NormalBlocks {
 public:
  // The last two where the group touches two groups of variables.
  struct Blocks {
    Eigen::Matrix4d a, b, across;
  };

  // Makes blocks for each group of rows. O(groups), or O(groups of variables^2) where they tie
  // others than before.
  void Take(Eigen::Index variables, const RowLayout& layout);

  Blocks& of(std::size_t group) { return blocks_[group]; }

  // With all groups' blocks and this diagonal.
  void Factorise(const Eigen::VectorXd& diagonal);
  [[nodiscard]] Eigen::VectorXd Solve(const Eigen::VectorXd& right_side) const {
    return matrix_.Solve(right_side);
  }

 private:
  // Of a group's blocks.
  struct Places {
    NormalMatrix::Place a, b, across;
  };
  using Ties = std::vector<std::pair<int, int>>;

  void PlaceAll();

  Eigen::Index variables_ = 0;
  Ties ties_;  // first variables of each group of rows; the second -1: only one
  NormalMatrix matrix_{0, {}};
  std::vector<Places> places_;
  std::vector<Blocks> blocks_;
};

}  // namespace capfit::tighten

#endif  // CAPFIT_CORE_TIGHTEN_NORMAL_BLOCKS_H_
