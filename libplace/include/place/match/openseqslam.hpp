#pragma once

#include "place/match/cost_matrix.hpp"

#include <optional>
#include <vector>

#include <vo/image/image_stack.hpp>

/// The original OpenSeqSLAM (Sünderhauf, Neubert, Protzel 2013), reproduced to the bit, for comparison. Its
/// arithmetic is in single precision and in the original's order. Nothing else in the library uses this; see
/// `place/place.hpp` for our own search.
namespace place::openseqslam {

/// Behaviour of the original that is not in its paper or that costs accuracy, each by name. Off by default.
struct Quirks {
  /// A constant patch (0 / 0) becomes byte 0 where every other byte lies in 119..135, so that a dark or plain
  /// patch differs more from anything than two unrelated patches do. Off: the neutral 127.
  bool constant_patch_is_zero = false;
  /// The difference is divided by the number of reference images. Off: by the number of pixels. Only a scale.
  bool divides_by_reference_count = false;
  /// The matched reference is the line's start plus half the sequence length, whatever the line's velocity.
  /// Off: the reference the line passes at the query.
  bool centre_ignores_velocity = false;
  /// The line adds sequence length + 1 terms. Off: sequence length terms.
  bool one_term_too_many = false;

  /// All of them: the program as published.
  static Quirks original() {
    return {.constant_patch_is_zero = true,
            .divides_by_reference_count = true,
            .centre_ignores_velocity = true,
            .one_term_too_many = true};
  }
};

/// The original's parameters and their defaults.
struct Options {
  int patch_px = 8;             ///< pixels
  int enhancement_window = 10;  ///< reference images (R)
  int sequence_length = 10;     ///< query images (ds); an odd one is made even by adding 1
  double v_min = 0.8;           ///< reference images per query image
  double v_max = 1.2;           ///< reference images per query image
  int match_window = 10;        ///< reference images (Rwindow)
  Quirks quirks;
};

/// One query image's match.
struct Match {
  std::optional<std::size_t> reference;  ///< none for the first and last half sequence
  float score = 0;  ///< best / second best outside the window, smaller is surer; 0 without a match
};

/// Patch-normalised images: 127 + round((pixel - mean) / sample deviation), halves away from zero. Throws
/// `std::invalid_argument` if a side is not a multiple of patch_px.
vo::ImageStack patch_normalise(const vo::ImageStack& images, const Options& options);

/// D: sums of absolute differences divided by a constant (see Quirks::divides_by_reference_count).
CostMatrix difference_matrix(const vo::ImageStack& queries, const vo::ImageStack& references,
                             const Options& options);

/// DD: each value relative to the window of references around it, (D - mean) / sample deviation, minus the
/// smallest of all. NaN where the deviation is zero.
CostMatrix enhance(const CostMatrix& differences, const Options& options);

/// The best line through each query. O(queries * references * velocities * length).
std::vector<Match> find_matches(const CostMatrix& enhanced, const Options& options);

}  // namespace place::openseqslam
