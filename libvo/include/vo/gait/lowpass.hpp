#pragma once

#include <array>
#include <span>
#include <vector>

namespace vo {

/// Settings of the low-pass filter.
struct LowpassOptions {
  /// 1 to 8. PVO gives no order; the usual filter in gait analysis is of order 2, run both ways (Winter,
  /// "Biomechanics and Motor Control of Human Movement").
  int order = 2;
  double cutoff_hz = 4;  ///< where one pass halves the power [PVO 5.3 (2)]
};

/// Replaces values whose flag is false by a straight line between the reliable ones on either side; before
/// the first and after the last, by that value; by 0 if none is reliable. Otherwise a filter would smear them
/// over their neighbours. Throws `std::invalid_argument` unless there is one flag per value. O(n).
std::vector<double> bridge_gaps(std::span<const double> values, const std::vector<bool>& reliable);

/// A Butterworth low-pass filter that takes one value at a time (PVO 4.3, 5.3 (2)), for live use.
///
/// Second-order sections by the bilinear transform, with the cut-off warped so that it comes out exact. The
/// gain at f Hz is 1 / sqrt(1 + (tan(pi f / rate) / tan(pi cutoff / rate))^(2 order)), 1 at rest. The input
/// is assumed to have always had its first value, so that there is no start-up transient. The output lags: by
/// 56 ms for order 2 at 4 Hz.
class Lowpass {
 public:
  /// Throws `std::invalid_argument`, naming value and expectation, for an order outside 1..8, a cut-off that
  /// is not above 0, or a rate that is not above twice the cut-off.
  Lowpass(double rate_hz, const LowpassOptions& options = {});

  /// The next value, filtered. O(order).
  double push(double value);

 private:
  struct Section {
    std::array<double, 3> b{};  // numerator, 1 z^-1 z^-2
    std::array<double, 2> a{};  // denominator, z^-1 z^-2; that of 1 is 1
    std::array<double, 2> state{};
  };
  std::vector<Section> sections_;
  bool started_ = false;
};

/// The same filter run forwards and backwards over a whole signal, for files: no lag at any frequency, and
/// the gain squared. The ends are extended by odd reflection through the end point, for three periods of the
/// cut-off or as far as the signal reaches. One value out for each in. Throws as `Lowpass`.
/// O(order * n).
std::vector<double> lowpass_zero_phase(std::span<const double> signal, double rate_hz,
                                       const LowpassOptions& options = {});

/// The signal without its part slower than `slowest_hz`: the signal minus its zero-phase low-pass of order 2.
/// Takes out turns and drift but leaves strides, which have 0.5 Hz or more: the median x shift swings with
/// them as the orientation does, and where a camera holds its horizon steady it alone does. Throws as
/// `Lowpass`.
std::vector<double> without_drift(std::span<const double> signal, double rate_hz, double slowest_hz = 0.5);

}  // namespace vo
