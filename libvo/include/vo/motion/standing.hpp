#pragma once

#include "vo/image/image_stack.hpp"

#include <span>
#include <vector>

namespace vo {

/// How much unrelated views differ: the median error of frames half the walk apart, or 0.38 of
/// it where that is a quarter larger, as on a walk of several rounds. Two unrelated pictures of
/// independent normal pixels have 2 / sqrt(pi) = 1.13. `normalised`: bytes of `patch_normalise`; `excluded`:
/// one flag per frame, true if it is left out, or empty. 0 if fewer than two frames remain. O(frames *
/// pixels), in parallel.
double distant_error(const ImageStack& normalised, const std::vector<bool>& excluded = {});

/// True if a walk with this distant error never leaves its first view or shows nothing at all: less than a
/// third of the error of unrelated pictures.
bool standing_still(double distant_error);

/// Settings of `standing_frames`.
struct StandingOptions {
  double span_s = 2;   ///< seconds over which a moving walker's view changes for good; 0: never standing
  double alike = 0.4;  ///< share of the distant error below which two views show one place
  double alike_for_long = 2.0 / 3;  ///< the same where views `kLongSpans` spans apart are as alike
};

/// A walker who sways for this many spans has stood; one who walked slowly sees another view by then.
inline constexpr double kLongSpans = 4;

/// The intervals between frames in which the walker is still. One flag per frame, for the interval that ends
/// with it; the first is false.
///
/// SSS has no such stage: there, the sway and breathing of a standing walker count as motion, a fifth of
/// walking by alignment error alone. But these return to where they began: a span is standing if its first,
/// middle and last frames are all within `alike` of each other; or within `alike_for_long`, if the view four
/// spans before the last or after the first is so too. Three frames, because two places along a fence or a
/// row of doors may look alike by chance. Black frames do not change either, and show nothing.
///
/// On drawn walks (tests/RESULTS.md, "Sources of motion"), views 2 s apart differ by 0.08 to 0.4 of the
/// distant error while standing, and by 0.45 and more while walking slowly along a street that looks the same
/// for long. A pause that is missed counts as a little motion; motion that is taken for a pause leaves a hole
/// in a route.
///
/// `normalised`: bytes of `patch_normalise`; `time_s`: one per frame, increasing. O(frames * pixels), in
/// parallel.
std::vector<bool> standing_frames(const ImageStack& normalised, std::span<const double> time_s,
                                  double distant_error, const StandingOptions& options = {});

/// Where a walker is still, and the measurements behind it.
struct Pauses {
  std::vector<bool> standing;  ///< as `standing_frames`; empty if the walk never leaves its first view
  double distant_error = 0;    ///< that it was decided by
  bool still = false;          ///< the walk never leaves its first view, or shows nothing
};

/// The same for a walk about which nothing is known yet. If the walker is still most of the time, frames half
/// the walk apart mostly show one place and do not measure how much places differ. Then the frames between
/// the pauses do, and the most different tenth shows whether the walk leaves its first view. Throws and costs
/// as `standing_frames`.
Pauses find_pauses(const ImageStack& normalised, std::span<const double> time_s,
                   const StandingOptions& options = {});

}  // namespace vo
