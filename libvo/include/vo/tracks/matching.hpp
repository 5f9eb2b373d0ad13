#pragma once

#include "vo/surf/features.hpp"

#include <cstddef>
#include <vector>

namespace vo {

/// One point seen in two images.
struct Match {
  std::size_t from = 0;  ///< index in the first image's features
  std::size_t to = 0;    ///< index in the second's
  float distance = 0;    ///< Euclidean, between descriptors; 0 to 2

  friend bool operator==(const Match&, const Match&) = default;
};

/// Settings of `match_features`.
struct MatchOptions {
  double max_ratio = 0.8;          ///< largest nearest over second nearest distance; 1: no ratio test
  bool mutual = true;              ///< `from` must be the nearest of `to` as well
  double max_displacement_px = 0;  ///< points further apart are not candidates; 0: any distance
};

/// The pairs of points with the nearest descriptors, among points of the same Laplacian sign (Bay et al.
/// 2008, section 4.3), by index of `from`. Every point is in at most one pair if `mutual`.
///
/// A nearest neighbour is a match if its distance is at most `max_ratio` times the second nearest's (Lowe
/// 2004, section 7.1), and if no other `from` is nearer to it. Among equal distances the lowest index wins.
/// Only candidates, i.e. points of the same sign within `max_displacement_px`, count as second nearest or as
/// rivals; a point with a single candidate passes the ratio test.
///
/// Throws `std::invalid_argument` if descriptor sizes differ while both have points, the ratio is not in (0,
/// 1], or the displacement is negative. O(|from| |to| descriptor size), in parallel, with the
/// same bytes for any number of threads; points too far up or down are skipped.
std::vector<Match> match_features(const Features& from, const Features& to, const MatchOptions& options = {});

}  // namespace vo
