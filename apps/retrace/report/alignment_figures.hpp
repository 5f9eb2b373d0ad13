#pragma once

#include "report/page.hpp"

#include <vector>

#include <nlohmann/json_fwd.hpp>

#include <vo/gait/turns.hpp>

namespace retrace {

/// Stretches of time in which a walker turns, as a shading; without any there is nothing to shade.
Band turn_band(const std::vector<vo::WalkedTurn>& turns);

/// The figures of alignment error that the SSS paper shows: the difference of each pixel (1a), the error over
/// frames and separations (1b) and its course with the windows left out (10), the mean curve (2) and the
/// learned relation (3). `data`: see `alignment_data`; empty: nothing is shown. `turns`: marked in the
/// course.
void put_alignment(Page& page, const nlohmann::ordered_json& data,
                   const std::vector<vo::WalkedTurn>& turns = {});

}  // namespace retrace
