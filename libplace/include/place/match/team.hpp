#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace place {

/// Members that search one reference together, each a part of it: processes that exchange messages, or the
/// threads of a test. Every member makes the same calls in the same order.
class Team {
 public:
  using Message = std::vector<std::uint8_t>;

  virtual ~Team() = default;
  [[nodiscard]] virtual std::size_t size() const = 0;
  /// Which member this is, from 0. The first one has the query and the results.
  [[nodiscard]] virtual std::size_t rank() const = 0;
  /// Gives every member's message to every member, by rank. Throws `vo::Error` if another member failed.
  virtual std::vector<Message> exchange(std::span<const std::uint8_t> message) = 0;
  /// Gives every member's message to the first member; the others get none.
  virtual std::vector<Message> collect(std::span<const std::uint8_t> message) = 0;
};

/// A team of one, as a search in one process is.
class Alone final : public Team {
 public:
  [[nodiscard]] std::size_t size() const override { return 1; }
  [[nodiscard]] std::size_t rank() const override { return 0; }
  std::vector<Message> exchange(std::span<const std::uint8_t> message) override {
    return {Message(message.begin(), message.end())};
  }
  std::vector<Message> collect(std::span<const std::uint8_t> message) override { return exchange(message); }
};

/// A member's part of a reference: keyframes [begin, end).
struct Shard {
  std::size_t begin = 0, end = 0;

  [[nodiscard]] std::size_t size() const { return end - begin; }
};

/// Where one shard ends and the next begins, a multiple of this many keyframes: sums over the reference are
/// made of sums over such blocks, so that they do not depend on how it is divided.
inline constexpr std::size_t kShardBlock = 512;

/// Shards of a reference of `count` keyframes for `members`, as even as blocks allow, in order. With fewer
/// blocks than members some are empty.
std::vector<Shard> shards_of(std::size_t count, std::size_t members);

}  // namespace place
