#pragma once

#include "match/tree_sum.hpp"
#include "place/match/team.hpp"

#include <cstring>
#include <span>
#include <stdexcept>
#include <type_traits>
#include <vector>

/// Values as the bytes of a message, for processors of one kind.
namespace place {

class MessageWriter {
 public:
  template <typename Value>
  void put(const Value& value) {
    static_assert(std::is_trivially_copyable_v<Value>);
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(&value);
    bytes_.insert(bytes_.end(), bytes, bytes + sizeof value);
  }
  /// With their number.
  template <typename Value>
  void put_all(std::span<const Value> values) {
    static_assert(std::is_trivially_copyable_v<Value>);
    put(values.size());
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(values.data());
    bytes_.insert(bytes_.end(), bytes, bytes + values.size_bytes());
  }
  template <typename Value>
  void put_all(const std::vector<Value>& values) {
    put_all(std::span<const Value>(values));
  }

  [[nodiscard]] const Team::Message& bytes() const { return bytes_; }

 private:
  Team::Message bytes_;
};

class MessageReader {
 public:
  explicit MessageReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  template <typename Value>
  Value get() {
    Value value;
    std::memcpy(&value, take(sizeof value), sizeof value);
    return value;
  }
  template <typename Value>
  std::vector<Value> get_all() {
    std::vector<Value> values(get<std::size_t>());
    const std::uint8_t* const from = take(values.size() * sizeof(Value));
    if (!values.empty()) std::memcpy(values.data(), from, values.size() * sizeof(Value));
    return values;
  }

 private:
  const std::uint8_t* take(std::size_t count) {
    if (count > bytes_.size()) throw std::logic_error("a message of a search is too short");
    const std::uint8_t* const from = bytes_.data();
    bytes_ = bytes_.subspan(count);
    return from;
  }

  std::span<const std::uint8_t> bytes_;
};

/// Everyone's values to everyone, by rank.
template <typename Value>
std::vector<std::vector<Value>> exchange_all(Team& team, std::span<const Value> mine) {
  MessageWriter message;
  message.put_all(mine);
  std::vector<std::vector<Value>> all;
  for (const Team::Message& received : team.exchange(message.bytes()))
    all.push_back(MessageReader(received).get_all<Value>());
  return all;
}

/// The sum over the blocks of all members.
template <typename Value>
TreeSum<Value> sum_of_team(Team& team, const TreeSum<Value>& mine) {
  if (team.size() == 1) return mine;
  TreeSum<Value> sum;
  for (const auto& nodes : exchange_all(team, std::span(mine.nodes())))
    for (const TreeNode<Value>& node : nodes) sum.append(node);
  return sum;
}

}  // namespace place
