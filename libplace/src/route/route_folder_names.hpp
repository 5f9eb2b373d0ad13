#pragma once

#include <cstddef>
#include <filesystem>

#include <fmt/format.h>

/// The files of a route's folder (place/route/route_folder.hpp); numbers in their names count from 1.
namespace place::route_folder {

inline constexpr int kFormat = 1;  ///< in route.csv

inline std::filesystem::path traverse_folder(const std::filesystem::path& folder, std::size_t traverse) {
  return folder / fmt::format("traverse-{}", traverse + 1);
}
inline std::filesystem::path descriptor_file(const std::filesystem::path& folder, std::size_t descriptor) {
  return folder / fmt::format("descriptors-{}.npy", descriptor + 1);
}
inline std::filesystem::path learned_file(const std::filesystem::path& folder, std::size_t descriptor) {
  return folder / fmt::format("learned-{}.npy", descriptor + 1);
}

}  // namespace place::route_folder
