#pragma once

#include <span>
#include <vector>

namespace vo {

/// The times of the steps that an accelerometer shows, seconds: an independent check of those that the
/// pictures show.
///
/// The length of the acceleration vector is the same however the camera is held. It is resampled to 50 Hz and
/// band-passed from 0.5 to 4 Hz. Around each time the period of the steps is the lag of 0.286 to 1.25 s (3.5
/// to 0.8 Hz) at which the signal repeats best over 4 s; of lags that are nearly as good, the shortest, as
/// strides repeat too. A step is a peak above the mean that no higher one lies near, within six tenths of a
/// period, where the signal repeats at least by a correlation of 0.4 and deviates by at least 0.5 m/s^2 over
/// a period: windowed peaks behind a threshold of the deviation, the kind of counter that Brajdic and Harle
/// ("Walk detection and step counting on unconstrained smartphones", UbiComp 2013) found best, with the
/// periodicity in place of a fixed window. Neither a camera at rest nor one in a car that shakes has steps.
///
/// `acceleration_m_s2`: lengths of the vectors, with gravity; `time_s`: one for each, increasing. Throws
/// `std::invalid_argument` for other sizes or times. Nothing for less than 4 s. O(time * log steps).
std::vector<double> acceleration_steps(std::span<const double> acceleration_m_s2,
                                       std::span<const double> time_s);

}  // namespace vo
