#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include <vo/io/trajectory_io.hpp>

namespace place {

/// Landmarks seen in both walks: frame numbers, strictly increasing in `query_frame`.
struct LandmarkPairs {
  std::vector<double> query_frame;
  std::vector<double> reference_frame;
};

/// Reads `pairs.csv` (columns query_frame,reference_frame). Throws `vo::Error` naming file and line for
/// missing columns, cells that are not numbers >= 0, fewer than two rows, or query frames that do not
/// increase.
LandmarkPairs read_pairs(const std::filesystem::path& path);

/// The true reference frame of a query frame: interpolated between the landmarks on either side (SSS 4.2);
/// none outside.
std::optional<double> true_reference_frame(const LandmarkPairs& pairs, double query_frame);

/// The true places of the query. Either `pairs`, or both walks' travelled distances; `reference_distance_m`
/// may be given with `pairs` to turn frames into metres.
struct GroundTruth {
  std::optional<LandmarkPairs> pairs;
  std::vector<std::optional<double>> query_distance_m;  ///< for each query frame; empty with `pairs`
  std::vector<double> reference_distance_m;             ///< for each reference frame
};

/// The unit of a tolerance and of errors.
enum class ErrorUnit { kFrames, kMetres };

/// The error of a match.
struct PlaceError {
  bool has_truth = false;       ///< the query has a true place on the reference (within `tolerance` of it)
  std::optional<double> error;  ///< distance of the match from that place; none without truth or match
};

/// Compares one match with the truth. With distances, a query has a true place if its own is known and the
/// reference comes within `tolerance` of it, for errors in frames reaches it; the error in frames is to the
/// nearest reference frame at that distance (a walker who is still spends many there). Throws `vo::Error` if
/// a frame is outside the truth, `std::invalid_argument` if the truth cannot give errors in `unit`.
/// O(frames).
PlaceError place_error(const GroundTruth& truth, std::int64_t query_frame,
                       std::optional<std::int64_t> reference_frame, ErrorUnit unit, double tolerance);

}  // namespace place
