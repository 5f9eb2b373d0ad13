#include "vo/motion/standing.hpp"

#include "vo/base/median.hpp"
#include "vo/base/parallel.hpp"
#include "vo/base/percentile.hpp"
#include "vo/image/patch_normalisation.hpp"
#include "vo/motion/alignment_error.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

namespace vo {

namespace {

/// Errors between frames and those a share of their number later.
std::vector<double> errors_apart(const ImageStack& normalised, const std::vector<std::size_t>& frames,
                                 double share) {
  const auto apart = static_cast<std::size_t>(share * static_cast<double>(frames.size()));
  if (apart == 0) return {};
  std::vector<double> errors(frames.size() - apart);
  parallel_for(errors.size(), [&](std::size_t i) {
    errors[i] = alignment_error(normalised[frames[i]], normalised[frames[i + apart]]);
  });
  return errors;
}

/// Errors between the frames not excluded and those half of their number later. A walker who goes round twice
/// is at the same place then; where errors at another distance, which no small number of rounds divides, are
/// clearly larger, it is those.
std::vector<double> distant_errors(const ImageStack& normalised, const std::vector<bool>& excluded) {
  constexpr double kGolden = 0.381966, kClearly = 1.25;
  std::vector<std::size_t> frames;
  for (std::size_t i = 0; i < normalised.size(); ++i)
    if (excluded.empty() || !excluded[i]) frames.push_back(i);
  std::vector<double> half = errors_apart(normalised, frames, 0.5);
  std::vector<double> other = errors_apart(normalised, frames, kGolden);
  const bool in_rounds = !half.empty() && !other.empty() && median(other) > kClearly * median(half);
  return in_rounds ? other : half;
}

}  // namespace

double distant_error(const ImageStack& normalised, const std::vector<bool>& excluded) {
  if (!excluded.empty() && excluded.size() != normalised.size())
    throw std::invalid_argument("distant_error: one flag per frame expected");
  std::vector<double> errors = distant_errors(normalised, excluded);
  return errors.empty() ? 0 : median(std::move(errors));
}

bool standing_still(double distant_error) {
  return distant_error < 2 / std::sqrt(std::numbers::pi) / 3;
}

std::vector<bool> standing_frames(const ImageStack& normalised, std::span<const double> time_s,
                                  double distant_error, const StandingOptions& options) {
  if (time_s.size() != normalised.size())
    throw std::invalid_argument("standing_frames: one time per frame expected");
  std::vector<bool> standing(normalised.size(), false);
  if (!(options.span_s > 0)) return standing;

  const auto frame_at = [&](double s) {
    return static_cast<std::size_t>(std::ranges::lower_bound(time_s, s) - time_s.begin());
  };
  constexpr double kLongest = 1.5;  // times the span, at barely a frame a second
  const std::vector<std::uint8_t> blank(normalised.image_size(), kNeutralByte);
  std::vector<char> shows(normalised.size());  // pictures of nothing are all alike
  parallel_for(normalised.size(), [&](std::size_t i) {
    constexpr double kLeast = 0.2;  // deviations: a quarter of what normal pixels differ from their mean
    shows[i] = alignment_error(normalised[i], blank) >= kLeast;
  });
  std::vector<std::size_t> last(normalised.size(),
                                0);  // of the standing span that starts at each frame; 0: none starts there
  parallel_for(normalised.size(), [&](std::size_t first) {
    const std::size_t middle = frame_at(time_s[first] + options.span_s / 2);
    const std::size_t end = frame_at(time_s[first] + options.span_s);
    if (end >= normalised.size() || middle == first || end == middle) return;
    if (time_s[end] - time_s[first] > kLongest * options.span_s) return;  // the clock jumped in between
    const auto alike = [&](std::size_t a, std::size_t b, double share) {
      return shows[a] && shows[b] && alignment_error(normalised[a], normalised[b]) < share * distant_error;
    };
    const auto all_alike = [&](double share) {
      return alike(first, middle, share) && alike(middle, end, share) && alike(first, end, share);
    };
    const auto stays_for_long = [&] {
      const double long_s = kLongSpans * options.span_s;
      const std::size_t before = frame_at(time_s[end] - long_s), after = frame_at(time_s[first] + long_s);
      const double share = options.alike_for_long;
      return (time_s[end] - long_s >= time_s.front() && alike(before, end, share)) ||
             (after < normalised.size() && alike(first, after, share));
    };
    if (all_alike(options.alike) || (all_alike(options.alike_for_long) && stays_for_long()))
      last[first] = end;
  });
  std::size_t covered = 0;
  for (std::size_t i = 0; i + 1 < standing.size(); ++i) {
    covered = std::max(covered, last[i]);
    standing[i + 1] = i + 1 <= covered;
  }
  return standing;
}

Pauses find_pauses(const ImageStack& normalised, std::span<const double> time_s,
                   const StandingOptions& options) {
  constexpr double kMostUnlike = 0.9;
  std::vector<double> errors = distant_errors(normalised, {});
  std::ranges::sort(errors);
  Pauses pauses;
  pauses.still = errors.empty() || standing_still(percentile(errors, kMostUnlike));
  if (pauses.still) return pauses;
  pauses.distant_error = percentile(errors, 0.5);
  if (standing_still(pauses.distant_error)) pauses.distant_error = percentile(errors, kMostUnlike);
  pauses.standing = standing_frames(normalised, time_s, pauses.distant_error, options);
  if (2 * static_cast<std::size_t>(std::ranges::count(pauses.standing, true)) <= normalised.size())
    return pauses;
  pauses.distant_error = distant_error(normalised, pauses.standing);
  pauses.standing = standing_frames(normalised, time_s, pauses.distant_error, options);
  return pauses;
}

}  // namespace vo
