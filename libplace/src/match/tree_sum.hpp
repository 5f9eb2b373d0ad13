#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace place {

/// A sum of a block, of two neighbouring blocks, of four, ...: of blocks [index << level, (index + 1) <<
/// level).
template <typename Value>
struct TreeNode {
  std::uint64_t index = 0;
  std::uint64_t level = 0;
  Value sum{};
};

/// The sum over a row of blocks in an order that does not depend on who adds which of them: neighbouring
/// blocks are added in pairs, the pairs in pairs, and so on. Members of a team add the blocks of their own
/// part, and the sum of their nodes is that of one who adds them all, to the bit. `Value` has +=. Keeps two
/// nodes for each doubling of the blocks.
template <typename Value>
class TreeSum {
 public:
  using Node = TreeNode<Value>;

  /// Begins at a block.
  explicit TreeSum(std::size_t block = 0) : next_(block) {}

  /// Adds the next block.
  void add(Value sum) { append({next_, 0, std::move(sum)}); }

  /// Adds the next blocks, as another summed them.
  void append(Node node) {
    next_ = (node.index + 1) << node.level;
    while (!nodes_.empty() && nodes_.back().level == node.level && nodes_.back().index % 2 == 0 &&
           nodes_.back().index + 1 == node.index) {
      Node left = std::move(nodes_.back());
      nodes_.pop_back();
      left.sum += node.sum;
      node = {left.index / 2, left.level + 1, std::move(left.sum)};
    }
    nodes_.push_back(std::move(node));
  }

  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }

  /// The sum over all blocks, which begin at 0; `Value{}` without any.
  [[nodiscard]] Value total() const {
    if (nodes_.empty()) return {};
    Value sum = nodes_.back().sum;
    for (std::size_t i = nodes_.size() - 1; i-- > 0;) {
      Value longer = nodes_[i].sum;
      longer += sum;
      sum = std::move(longer);
    }
    return sum;
  }

 private:
  std::size_t next_;
  std::vector<Node> nodes_;
};

}  // namespace place
