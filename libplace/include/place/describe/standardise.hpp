#pragma once

#include "place/describe/float_rows.hpp"

namespace place {

/// Of each value of descriptors over the keyframes of a walk: what it usually is, and how much it differs.
struct Spread {
  FloatRows mean, deviation;  ///< one row each
};

/// Means and population deviations over rows. Throws `std::invalid_argument` without rows.
Spread spread_of(const FloatRows& rows);

/// Takes the mean off each value and divides it by its deviation, in place, so that what all pictures of a
/// walk have in common (sky above, ground below) does not count. Many rows stand for themselves, of few the
/// spread that the route learned is taken: with w = rows / (rows + 100), w of theirs and 1 - w of that. A
/// deviation is raised by a tenth of the mean one, so that a value that hardly changes is not blown up.
/// Throws `std::invalid_argument` if the sizes differ.
void standardise(FloatRows& rows, const Spread& learned);

}  // namespace place
