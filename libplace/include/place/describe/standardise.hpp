#pragma once

#include "place/describe/float_rows.hpp"

namespace place {

/// The mean and deviation of each value of descriptors over the keyframes of a walk.
struct Spread {
  FloatRows mean, deviation;  ///< one row each
};

/// Means and population deviations over rows. Throws `std::invalid_argument` without rows.
Spread spread_of(const FloatRows& rows);

/// Subtracts the mean from each value and divides it by its deviation, in place, so that what all pictures of
/// a walk share (sky above, ground below) does not count. With many rows their own spread is used, with few
/// the one that the route learned: with w = rows / (rows + 100), w of theirs and 1 - w of the route's. A
/// tenth of the mean deviation is added to each, so that values that hardly change are not amplified. Throws
/// `std::invalid_argument` if the sizes differ.
void standardise(FloatRows& rows, const Spread& learned);

}  // namespace place
