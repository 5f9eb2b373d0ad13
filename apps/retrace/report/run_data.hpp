#pragma once

#include "report/kept_matrices.hpp"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include <place/place.hpp>
#include <vo/odometry.hpp>

namespace retrace {

/// The file in a run's folder with the report data that its other files lack: `retrace evaluate` redraws the
/// report from the folder alone.
inline constexpr const char* kRunDataFile = "report_data.json";

/// The contents of that file: for each traverse its keyframes, its cost matrix as pictures ("pictures" is
/// empty if there is none) and the travelled displacement; for the query the displacement; pairs of query and
/// reference previews.
///
/// `reference`: the route, with previews if pairs are to be shown; `matrices`: one for each traverse, or
/// none. They may be shrunk: a picture is stretched over all keyframes.
nlohmann::ordered_json run_data(const place::Route& route, const vo::Walk& walk, const place::Run& run,
                                const std::vector<KeptMatrix>& matrices);

/// Reads the file; an empty object if it is missing or incomplete, as in a run of an older version.
nlohmann::ordered_json read_run_data(const std::filesystem::path& folder);

}  // namespace retrace
