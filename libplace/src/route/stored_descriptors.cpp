#include "place/route/stored_descriptors.hpp"

#include "place/route/route_database.hpp"
#include "route/descriptor_rows.hpp"
#include "route/row_digests.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <vo/base/error.hpp>

namespace place {

namespace rows = descriptor_rows;

struct StoredDescriptors::State {
  std::string path;
  sqlite::Database database;
  std::int64_t traverse;
  std::size_t size = 0;
  struct Kind {
    std::string form;
    std::int64_t width, height;
    std::size_t bytes;
  };
  std::vector<Kind> kinds;
  std::uint64_t bytes_read = 0;

  [[nodiscard]] Descriptors make(std::size_t kind, std::size_t count) const {
    const Kind& of = kinds.at(kind);
    std::optional<Descriptors> made = rows::make_of_form(of.form, of.width, of.height, count);
    if (!made) rows::damaged(path, "the size of its descriptors is no size");
    return std::move(*made);
  }

  /// Calls `take` with the chunks of [begin, end): the first keyframe of each, and its bytes.
  template <typename Take>
  void for_each_chunk(std::size_t kind, std::size_t begin, std::size_t end, const Take& take) {
    database.renew_limits();  // the size of each chunk is checked
    sqlite::Statement chunk = database.prepare(
        "SELECT first, checksum, bytes FROM descriptor_chunk WHERE traverse = ? AND descriptor = ? AND first "
        ">= ? AND first < ? ORDER BY first");
    const std::size_t first_chunk = begin / rows::kChunk * rows::kChunk;
    chunk.bind(traverse).bind(static_cast<std::int64_t>(kind));
    chunk.bind(static_cast<std::int64_t>(first_chunk)).bind(static_cast<std::int64_t>(end));
    std::size_t next = first_chunk;
    while (next < end && chunk.step()) {
      const std::int64_t first = chunk.integer(), expected = chunk.integer();
      const std::span<const std::uint8_t> bytes = chunk.blob();
      if (rows::checksum(bytes) != expected)
        rows::damaged(path, "a block of descriptors does not fit its checksum");
      const std::size_t count = std::min(rows::kChunk, size - next);
      if (first != static_cast<std::int64_t>(next) || bytes.size() != count * kinds[kind].bytes)
        rows::damaged(path, "descriptors are missing");
      bytes_read += bytes.size();
      take(next, bytes);
      next += count;
    }
    if (next < end) rows::damaged(path, "descriptors are missing");
  }
};

StoredDescriptors::StoredDescriptors(const std::filesystem::path& path, std::size_t traverse)
    : state_(std::make_unique<State>(
          State{.path = path.string(),
                .database = sqlite::Database(path, sqlite::Database::Mode::kReadOnly, path.string()),
                .traverse = static_cast<std::int64_t>(traverse) + 1,
                .kinds = {}})) {
  sqlite::Statement version = state_->database.prepare("PRAGMA user_version");
  if (!version.step() || version.integer() != kRouteSchemaVersion)
    throw vo::Error(state_->path, "is no route of this version", "a file written by `retrace build`");
  sqlite::Statement keyframes = state_->database.prepare("SELECT keyframes FROM traverse WHERE id = ?");
  if (!keyframes.bind(state_->traverse).step())
    rows::damaged(state_->path, fmt::format("traverse {} is missing", state_->traverse));
  state_->size = static_cast<std::size_t>(keyframes.integer());
  sqlite::Statement form = state_->database.prepare(
      "SELECT form, width, height FROM descriptor WHERE traverse = ? ORDER BY descriptor");
  form.bind(state_->traverse);
  while (form.step()) {
    State::Kind kind{form.text(), form.integer(), form.integer(), 0};
    const std::optional<Descriptors> one = rows::make_of_form(kind.form, kind.width, kind.height, 1);
    if (one) kind.bytes = rows::form_of(*one).bytes;
    if (kind.bytes == 0) rows::damaged(state_->path, "the size of its descriptors is no size");
    state_->kinds.push_back(std::move(kind));
  }
}
StoredDescriptors::~StoredDescriptors() = default;
StoredDescriptors::StoredDescriptors(StoredDescriptors&&) noexcept = default;
StoredDescriptors& StoredDescriptors::operator=(StoredDescriptors&&) noexcept = default;

std::size_t StoredDescriptors::size() const {
  return state_->size;
}

std::size_t StoredDescriptors::kinds() const {
  return state_->kinds.size();
}

std::size_t StoredDescriptors::bytes_of_each(std::size_t kind) const {
  return state_->kinds.at(kind).bytes;
}

std::optional<std::int64_t> StoredDescriptors::digest() const {
  return row_digests::of_all(state_->database);
}

std::uint64_t StoredDescriptors::bytes_read() const {
  return state_->bytes_read;
}

Descriptors StoredDescriptors::read(std::size_t kind, std::size_t begin, std::size_t end) const {
  if (begin > end || end > size()) throw std::out_of_range("StoredDescriptors: keyframes of it expected");
  Descriptors made = state_->make(kind, end - begin);
  if (begin == end) return made;
  const std::span<std::uint8_t> to = rows::bytes_of(made);
  const std::size_t each = state_->kinds[kind].bytes;
  state_->for_each_chunk(kind, begin, end, [&](std::size_t first, std::span<const std::uint8_t> bytes) {
    const std::size_t low = std::max(first, begin), high = std::min(first + bytes.size() / each, end);
    const auto part = bytes.subspan((low - first) * each, (high - low) * each);
    std::ranges::copy(part, to.subspan((low - begin) * each).begin());
  });
  return made;
}

Descriptors StoredDescriptors::read(std::size_t kind, std::span<const std::size_t> keyframes) const {
  if (!std::ranges::is_sorted(keyframes) || (!keyframes.empty() && keyframes.back() >= size()))
    throw std::out_of_range("StoredDescriptors: increasing keyframes of it expected");
  Descriptors made = state_->make(kind, keyframes.size());
  const std::span<std::uint8_t> to = rows::bytes_of(made);
  const std::size_t each = state_->kinds[kind].bytes;
  for (std::size_t i = 0; i < keyframes.size();) {
    // Those of one chunk together.
    const std::size_t chunk = keyframes[i] / rows::kChunk;
    state_->for_each_chunk(kind, keyframes[i], keyframes[i] + 1,
                           [&](std::size_t first, std::span<const std::uint8_t> bytes) {
                             for (; i < keyframes.size() && keyframes[i] / rows::kChunk == chunk; ++i) {
                               std::ranges::copy(bytes.subspan((keyframes[i] - first) * each, each),
                                                 to.subspan(i * each).begin());
                             }
                           });
  }
  return made;
}

}  // namespace place
