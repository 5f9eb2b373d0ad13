#include "place/evaluation/ground_truth.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include <vo/base/error.hpp>
#include <vo/io/csv.hpp>

namespace place {
namespace {

template <typename T>
T at_frame(const std::vector<T>& by_frame, std::int64_t frame, std::string_view walk) {
  if (frame < 0 || frame >= static_cast<std::int64_t>(by_frame.size())) {
    throw vo::Error(fmt::format("{} truth", walk), fmt::format("has no frame {}", frame),
                    fmt::format("frames 0..{}; is it the truth of another walk?",
                                static_cast<std::int64_t>(by_frame.size()) - 1));
  }
  return by_frame[static_cast<std::size_t>(frame)];
}

double interpolated(const std::vector<double>& by_frame, double frame) {
  const double low = std::floor(frame);
  const double a = at_frame(by_frame, static_cast<std::int64_t>(low), "reference");
  return frame == low
             ? a
             : std::lerp(a, at_frame(by_frame, static_cast<std::int64_t>(low) + 1, "reference"), frame - low);
}

/// Frames between `frame` and the nearest at which a walk of non-decreasing distance is at `distance_m`.
double frames_from_distance(const std::vector<double>& by_frame, double frame, double distance_m) {
  const auto [first, last] = std::equal_range(by_frame.begin(), by_frame.end(), distance_m);
  double begin = static_cast<double>(first - by_frame.begin());
  double end = static_cast<double>(last - by_frame.begin()) - 1;
  if (first == last) {  // between two frames, or past an end
    if (first == by_frame.end()) {
      begin = end = static_cast<double>(by_frame.size()) - 1;
    } else if (first != by_frame.begin()) {
      const double before = *std::prev(first);
      begin = end = begin - 1 + (distance_m - before) / (*first - before);
    } else {
      begin = end = 0;
    }
  }
  return std::max({0.0, begin - frame, frame - end});
}

}  // namespace

LandmarkPairs read_pairs(const std::filesystem::path& path) {
  const vo::CsvTable table = vo::CsvTable::read(path);
  LandmarkPairs pairs{.query_frame = table.numbers("query_frame"),
                      .reference_frame = table.numbers("reference_frame")};
  if (table.rows() < 2)
    throw vo::Error(path.string(), fmt::format("has {} rows", table.rows()), "2 landmarks or more");
  for (std::size_t i = 0; i < table.rows(); ++i) {
    if (pairs.query_frame[i] < 0 || pairs.reference_frame[i] < 0) {
      throw vo::Error(table.where(i), "has a negative frame", "frames >= 0");
    }
    constexpr double kMost = 9e15;  // a double holds whole numbers up to this
    if (pairs.query_frame[i] > kMost || pairs.reference_frame[i] > kMost)
      throw vo::Error(table.where(i), "has a frame that no video has",
                      fmt::format("frames up to {:g}", kMost));
    if (i > 0 && pairs.query_frame[i] <= pairs.query_frame[i - 1]) {
      throw vo::Error(
          table.where(i),
          fmt::format("query_frame {} does not follow {}", pairs.query_frame[i], pairs.query_frame[i - 1]),
          "strictly increasing query frames");
    }
  }
  return pairs;
}

std::optional<double> true_reference_frame(const LandmarkPairs& pairs, double query_frame) {
  const auto after = std::ranges::lower_bound(pairs.query_frame, query_frame);
  if (after == pairs.query_frame.end()) return std::nullopt;
  const auto i = static_cast<std::size_t>(after - pairs.query_frame.begin());
  if (*after == query_frame) return pairs.reference_frame[i];
  if (i == 0) return std::nullopt;
  // Uses the slope, which is a whole number where it should be: otherwise a match exactly at the tolerance
  // would be wrong by the last digit.
  const double slope = (pairs.reference_frame[i] - pairs.reference_frame[i - 1]) /
                       (pairs.query_frame[i] - pairs.query_frame[i - 1]);
  return pairs.reference_frame[i - 1] + slope * (query_frame - pairs.query_frame[i - 1]);
}

PlaceError place_error(const GroundTruth& truth, std::int64_t query_frame,
                       std::optional<std::int64_t> reference_frame, ErrorUnit unit, double tolerance) {
  if (truth.pairs) {
    const std::optional<double> true_frame =
        true_reference_frame(*truth.pairs, static_cast<double>(query_frame));
    if (!true_frame) return {};
    if (!reference_frame) return {.has_truth = true, .error = std::nullopt};
    if (unit == ErrorUnit::kFrames) {
      return {.has_truth = true, .error = std::abs(static_cast<double>(*reference_frame) - *true_frame)};
    }
    if (truth.reference_distance_m.empty()) {
      throw std::invalid_argument("place_error: errors in metres need the reference's distances");
    }
    return {.has_truth = true,
            .error = std::abs(at_frame(truth.reference_distance_m, *reference_frame, "reference") -
                              interpolated(truth.reference_distance_m, *true_frame))};
  }

  const std::optional<double> known_m = at_frame(truth.query_distance_m, query_frame, "query");
  if (truth.reference_distance_m.empty()) throw std::invalid_argument("place_error: no reference distances");
  if (!known_m) return {};
  const double distance_m = *known_m;
  const auto [low, high] = std::ranges::minmax(truth.reference_distance_m);
  const double slack_m = unit == ErrorUnit::kMetres ? tolerance : 0;
  if (distance_m < low - slack_m || distance_m > high + slack_m) return {};
  if (!reference_frame) return {.has_truth = true, .error = std::nullopt};
  const double matched_m = at_frame(truth.reference_distance_m, *reference_frame, "reference");
  if (unit == ErrorUnit::kMetres) return {.has_truth = true, .error = std::abs(matched_m - distance_m)};
  return {.has_truth = true,
          .error = frames_from_distance(truth.reference_distance_m, static_cast<double>(*reference_frame),
                                        distance_m)};
}

}  // namespace place
