#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

namespace retrace {

/// A picture and its title.
struct OverviewTile {
  cv::Mat picture;  ///< colour
  std::string title;
};

/// A PNG of two views of one place side by side and, below them, two matrix pictures (`matrix_picture`) of
/// `kOverviewTile_px` at most.
std::vector<std::uint8_t> overview_picture(const std::vector<OverviewTile>& views,
                                           const std::vector<OverviewTile>& matrices);

inline constexpr int kOverviewTile_px = 440;

}  // namespace retrace
