#include "place/match/openseqslam.hpp"

#include "kernels/absolute_difference.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <vo/base/parallel.hpp>

namespace place::openseqslam {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Mean and sample deviation, in single precision and in order.
struct Statistics {
  float mean, deviation;
};

template <typename Values>
Statistics statistics(const Values& values) {
  float sum = 0;
  float count = 0;
  for (const auto value : values) {
    sum += static_cast<float>(value);
    ++count;
  }
  const float mean = sum / count;
  float squares = 0;
  for (const auto value : values)
    squares += (static_cast<float>(value) - mean) * (static_cast<float>(value) - mean);
  return {mean, std::sqrt(squares / (count - 1))};
}

/// The reference offsets of a line's terms, for each velocity. In double precision like the original: at
/// length 50 three of them differ from exact arithmetic.
std::vector<std::vector<std::size_t>> line_offsets(int length, const Options& options) {
  std::vector<std::vector<std::size_t>> lines;
  const int terms = options.quirks.one_term_too_many ? length + 1 : length;
  for (double m = length * options.v_min; m <= length * options.v_max; m += 1) {
    const double velocity = m / length;
    std::vector<std::size_t> offsets;
    for (int k = 0; k < terms; ++k) offsets.push_back(static_cast<std::size_t>(std::floor(k * velocity)));
    lines.push_back(std::move(offsets));
  }
  return lines;
}

}  // namespace

vo::ImageStack patch_normalise(const vo::ImageStack& images, const Options& options) {
  const int side = options.patch_px;
  if (side < 2 || images.width % side != 0 || images.height % side != 0) {
    throw std::invalid_argument(
        "openseqslam::patch_normalise: width and height must be multiples of patch_px >= 2");
  }
  vo::ImageStack result = vo::make_image_stack(images.width, images.height, images.size());
  const std::uint8_t constant_patch = options.quirks.constant_patch_is_zero ? 0 : 127;
  vo::parallel_for(images.size(), [&](std::size_t i) {
    std::vector<std::size_t> patch;
    std::vector<std::uint8_t> values;
    for (int y0 = 0; y0 < images.height; y0 += side) {
      for (int x0 = 0; x0 < images.width; x0 += side) {
        patch.clear();
        values.clear();
        for (int x = x0; x < x0 + side; ++x) {  // column by column, as Matlab sums
          for (int y = y0; y < y0 + side; ++y)
            patch.push_back(static_cast<std::size_t>(y) * images.width + x);
        }
        for (const std::size_t k : patch) values.push_back(images[i][k]);
        const Statistics stats = statistics(values);
        for (std::size_t p = 0; p < patch.size(); ++p) {
          const float normalised =
              127 + std::round((static_cast<float>(values[p]) - stats.mean) / stats.deviation);
          result[i][patch[p]] = stats.deviation > 0
                                    ? static_cast<std::uint8_t>(std::clamp(normalised, 0.0F, 255.0F))
                                    : constant_patch;
        }
      }
    }
  });
  return result;
}

CostMatrix difference_matrix(const vo::ImageStack& queries, const vo::ImageStack& references,
                             const Options& options) {
  if (queries.width != references.width || queries.height != references.height) {
    throw std::invalid_argument("openseqslam::difference_matrix: query and reference images differ in size");
  }
  CostMatrix matrix = make_cost_matrix(queries.size(), references.size());
  const auto divisor = static_cast<float>(options.quirks.divides_by_reference_count ? references.size()
                                                                                    : queries.image_size());
  vo::parallel_for(queries.size(), [&](std::size_t q) {
    const std::span<float> row = matrix.row(q);
    kernels::absolute_difference()({queries[q].data(), 1}, {references.pixels.data(), references.size()},
                                   {references.image_size(), references.image_size()},
                                   {1, row.data(), row.size()});
    for (float& cost : row) cost /= divisor;
  });
  return matrix;
}

CostMatrix enhance(const CostMatrix& differences, const Options& options) {
  CostMatrix enhanced = make_cost_matrix(differences.queries, differences.references);
  const auto half = static_cast<std::size_t>(options.enhancement_window / 2);
  vo::parallel_for(differences.queries, [&](std::size_t q) {
    const std::span<const float> row = differences.row(q);
    for (std::size_t r = 0; r < row.size(); ++r) {
      const std::size_t begin = r > half ? r - half : 0;
      const Statistics stats = statistics(row.subspan(begin, std::min(row.size(), r + half + 1) - begin));
      enhanced.row(q)[r] = stats.deviation > 0 ? (row[r] - stats.mean) / stats.deviation : kNaN;
    }
  });
  float smallest = kInfinity;
  for (const float value : enhanced.values) smallest = std::fmin(smallest, value);
  for (float& value : enhanced.values) value -= smallest;
  return enhanced;
}

std::vector<Match> find_matches(const CostMatrix& enhanced, const Options& options) {
  const int length = options.sequence_length + options.sequence_length % 2;
  if (length < 2) throw std::invalid_argument("openseqslam::find_matches: sequence_length must be >= 1");
  const auto half = static_cast<std::size_t>(length / 2);
  const std::vector<std::vector<std::size_t>> lines = line_offsets(length, options);

  std::vector<Match> matches(enhanced.queries);
  vo::parallel_for(enhanced.queries, [&](std::size_t q) {
    if (q < half || q + half >= enhanced.queries) return;
    std::vector<float> best_from(enhanced.references, kInfinity);
    std::vector<std::size_t> best_line(enhanced.references, 0);
    for (std::size_t start = 0; start < enhanced.references; ++start) {
      for (std::size_t line = 0; line < lines.size(); ++line) {
        float sum = 0;
        for (std::size_t k = 0; k < lines[line].size(); ++k) {
          const std::size_t r = start + lines[line][k];
          sum += r < enhanced.references ? enhanced.at(q - half + k, r) : kInfinity;
        }
        if (sum < best_from[start]) {  // false for NaN, which every minimum in the original ignores
          best_from[start] = sum;
          best_line[start] = line;
        }
      }
    }
    const auto best = static_cast<std::size_t>(std::ranges::min_element(best_from) - best_from.begin());
    if (best_from[best] == kInfinity) return;
    const auto window = static_cast<std::size_t>(options.match_window / 2);
    float second = kInfinity;
    for (std::size_t start = 0; start < best_from.size(); ++start) {
      if (start + window < best || start > best + window) second = std::min(second, best_from[start]);
    }
    const std::size_t offset = options.quirks.centre_ignores_velocity ? half : lines[best_line[best]][half];
    // The original's centre may lie past the last reference where lines are slower than 1/2.
    matches[q] = {.reference = std::min(best + offset, enhanced.references - 1),
                  .score = best_from[best] / second};
  });
  return matches;
}

}  // namespace place::openseqslam
