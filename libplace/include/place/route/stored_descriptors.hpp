#pragma once

#include "place/describe/descriptor.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>

namespace place {

/// The descriptors of a traverse in a route database, read when they are needed, for routes larger than
/// memory and for processes that need a part. The file stays open. One thread at a time, also for `const`
/// functions.
class StoredDescriptors {
 public:
  /// `traverse`: its index on the route. Throws `vo::Error` as `read_route` does.
  StoredDescriptors(const std::filesystem::path& path, std::size_t traverse);
  ~StoredDescriptors();
  StoredDescriptors(StoredDescriptors&&) noexcept;
  StoredDescriptors& operator=(StoredDescriptors&&) noexcept;

  /// Keyframes of the traverse.
  [[nodiscard]] std::size_t size() const;
  /// Descriptors of each keyframe.
  [[nodiscard]] std::size_t kinds() const;
  [[nodiscard]] std::size_t bytes_of_each(std::size_t kind) const;

  /// Those of keyframes [begin, end). O(bytes), of 256 keyframes at least. Throws `vo::Error` if the file is
  /// damaged, `std::out_of_range` for keyframes past the end.
  [[nodiscard]] Descriptors read(std::size_t kind, std::size_t begin, std::size_t end) const;
  /// Those of some keyframes, which increase.
  [[nodiscard]] Descriptors read(std::size_t kind, std::span<const std::size_t> keyframes) const;

  /// `Route::digest` of the route in the file.
  [[nodiscard]] std::optional<std::int64_t> digest() const;

  /// Bytes of descriptors read from the file so far.
  [[nodiscard]] std::uint64_t bytes_read() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace place
