#include "io/gpmf.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <string_view>

namespace vo {
namespace {

using Bytes = std::span<const std::uint8_t>;

/// A big-endian number of 2 or 4 bytes.
std::uint32_t number_at(Bytes bytes, std::size_t at, std::size_t size) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < size; ++i) value = value << 8U | bytes[at + i];
  return value;
}

std::int32_t signed_at(Bytes bytes, std::size_t at) {
  return static_cast<std::int32_t>(number_at(bytes, at, 4));
}

struct Entry {
  std::string_view key;
  std::uint8_t type = 0;
  std::size_t value_size = 0, count = 0;
  Bytes data;
};

/// The entries of a container; none if one is longer than what is left.
std::optional<std::vector<Entry>> entries_of(Bytes bytes) {
  constexpr std::size_t kHead = 8;
  std::vector<Entry> entries;
  while (bytes.size() >= kHead) {
    if (number_at(bytes, 0, 4) == 0) break;  // padding
    Entry entry{.key = {reinterpret_cast<const char*>(bytes.data()), 4},
                .type = bytes[4],
                .value_size = bytes[5],
                .count = number_at(bytes, 6, 2)};
    const std::size_t size = entry.value_size * entry.count, padded = (size + 3) / 4 * 4;
    if (size > bytes.size() - kHead) return std::nullopt;
    entry.data = bytes.subspan(kHead, size);
    entries.push_back(entry);
    bytes = bytes.subspan(std::min(kHead + padded, bytes.size()));
  }
  return entries;
}

const Entry* find(const std::vector<Entry>& entries, std::string_view key) {
  const auto found = std::ranges::find(entries, key, &Entry::key);
  return found == entries.end() ? nullptr : &*found;
}

/// What the values of a stream are divided by: one for all, or one for each.
std::vector<double> scales_of(const Entry& entry) {
  std::vector<double> scales;
  if (entry.value_size != 2 && entry.value_size != 4) return scales;
  for (std::size_t i = 0; i < entry.count; ++i) {
    const std::uint32_t raw = number_at(entry.data, i * entry.value_size, entry.value_size);
    scales.push_back(entry.value_size == 2 ? static_cast<std::int16_t>(raw) : static_cast<std::int32_t>(raw));
  }
  return scales;
}

/// The positions of one stream, appended; false if it is damaged.
bool take_positions(const std::vector<Entry>& stream, std::vector<GpmfPosition>& positions) {
  constexpr std::size_t kOlderSize = 20;  // GPS5: latitude, longitude, altitude, two speeds, of 4 bytes each
  constexpr std::size_t kNewerSize = 32;  // GPS9: those, days, seconds, and dilution and fix of 2 bytes each
  constexpr std::size_t kFixAt = 30;
  const Entry* older = find(stream, "GPS5");
  const Entry* newer = find(stream, "GPS9");
  const Entry* values = newer != nullptr ? newer : older;
  if (values == nullptr) return true;
  const Entry* scale = find(stream, "SCAL");
  const std::vector<double> scales = scale != nullptr ? scales_of(*scale) : std::vector<double>();
  if (values->value_size != (newer != nullptr ? kNewerSize : kOlderSize) || scales.empty()) return false;
  const double latitude_scale = scales[0], longitude_scale = scales.size() > 1 ? scales[1] : scales[0];
  if (latitude_scale == 0 || longitude_scale == 0) return false;
  const Entry* fixed = find(stream, "GPSF");  // of all of the piece, with GPS5
  const bool fix = fixed == nullptr || fixed->data.size() < 4 || number_at(fixed->data, 0, 4) >= 2;
  for (std::size_t i = 0; i < values->count; ++i) {
    const Bytes one = values->data.subspan(i * values->value_size, values->value_size);
    positions.push_back({.latitude_deg = signed_at(one, 0) / latitude_scale,
                         .longitude_deg = signed_at(one, 4) / longitude_scale,
                         .fix = newer != nullptr ? number_at(one, kFixAt, 2) >= 2 : fix});
  }
  return true;
}

/// The accelerations of one stream, appended; false if it is damaged.
bool take_accelerations(const std::vector<Entry>& stream, std::vector<std::array<double, 3>>& accelerations) {
  constexpr std::size_t kAxes = 3, kSize = 2 * kAxes;
  const Entry* values = find(stream, "ACCL");
  if (values == nullptr) return true;
  const Entry* scale = find(stream, "SCAL");
  const std::vector<double> scales = scale != nullptr ? scales_of(*scale) : std::vector<double>();
  if (values->value_size != kSize || (scales.size() != 1 && scales.size() != kAxes)) return false;
  if (std::ranges::find(scales, 0) != scales.end()) return false;
  for (std::size_t i = 0; i < values->count; ++i) {
    std::array<double, kAxes> acceleration{};
    for (std::size_t axis = 0; axis < kAxes; ++axis) {
      const auto raw = static_cast<std::int16_t>(number_at(values->data, i * kSize + 2 * axis, 2));
      acceleration[axis] = raw / scales[scales.size() == 1 ? 0 : axis];
    }
    accelerations.push_back(acceleration);
  }
  return true;
}

/// What `take` appends of each stream. Streams may lie in devices, which lie in the piece: three levels, and
/// no more are followed. False if any is damaged.
template <typename Value>
bool take_all(Bytes bytes, int levels, bool (*take)(const std::vector<Entry>&, std::vector<Value>&),
              std::vector<Value>& values) {
  const auto entries = entries_of(bytes);
  if (!entries || !take(*entries, values)) return false;
  return std::ranges::all_of(*entries, [&](const Entry& entry) {
    return entry.type != 0 || levels == 0 || take_all(entry.data, levels - 1, take, values);
  });
}

constexpr int kLevels = 3;

}  // namespace

std::optional<std::vector<GpmfPosition>> gpmf_positions(std::span<const std::uint8_t> piece) {
  std::vector<GpmfPosition> positions;
  if (!take_all(piece, kLevels, take_positions, positions)) return std::nullopt;
  return positions;
}

std::optional<std::vector<std::array<double, 3>>> gpmf_accelerations(std::span<const std::uint8_t> piece) {
  std::vector<std::array<double, 3>> accelerations;
  if (!take_all(piece, kLevels, take_accelerations, accelerations)) return std::nullopt;
  return accelerations;
}

}  // namespace vo
