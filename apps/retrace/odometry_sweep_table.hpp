#pragma once

#include <string>
#include <vector>

#include <place/evaluation/odometry_sweep.hpp>

namespace retrace {

/// odometry_sweep.csv: a row for each value of the setting and each distance that any walk reaches.
std::string odometry_sweep_csv(const std::string& setting, const std::vector<place::OdometrySweepRow>& rows);

/// PVO Table 1, for people: improvements over the first value, at 50 m and at the last distance that a walk
/// reaches.
std::string odometry_sweep_table(const std::string& setting,
                                 const std::vector<place::OdometrySweepRow>& rows);

}  // namespace retrace
