#pragma once

#include "place/evaluation/run_evaluation.hpp"
#include "place/match/route_matching.hpp"
#include "place/resolve.hpp"
#include "place/route/route.hpp"
#include "place/route/route_database.hpp"
#include "place/route/walk_sampling.hpp"
#include "place/settings.hpp"
#include "place/trajectory/query_trajectory.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <vo/base/progress.hpp>
#include <vo/odometry.hpp>

/// The whole library on one screen: a first walk makes a route, another is found on it, the matches are held
/// against the truth, and where they lie corrects the drift of the walk's odometry.
///
/// Settings are given once. A new route keeps them, and every walk that is read for it, added to it or found
/// on it has them too (`resolve`), so that nothing has to be copied from one call to the next.
namespace place {

/// A route without traverses. Throws `vo::Error` for settings that do not go together (`resolve`).
Route new_route(const Settings& settings = {});

/// Reads a recording (`vo::read_walk`) with what the settings, of a new route, need kept of it; with motion
/// by a file, the file's track. Throws `vo::Error` if it cannot be read, or for settings that do not go
/// together. The time of decoding, see `vo::read_walk`.
vo::Walk read(const std::string& source, const Settings& settings, const vo::ProgressCallback& progress = {});
/// The same of several files in order, as one walk.
vo::Walk read(std::span<const std::string> sources, const Settings& settings,
              const vo::ProgressCallback& progress = {});
/// The same of a walk that is to be found on a route: what `settings` do not give is the route's.
vo::Walk read(const std::string& source, const Route& route, const Settings& settings = {},
              const vo::ProgressCallback& progress = {});
vo::Walk read(std::span<const std::string> sources, const Route& route, const Settings& settings = {},
              const vo::ProgressCallback& progress = {});

/// What became of a walk on a route.
struct AddedTraverse {
  std::size_t index = 0;              ///< in the route's traverses
  double scale = 1;                   ///< see `SampledWalk::scale`
  std::vector<std::string> warnings;  ///< what a user should know of its motion and keyframes
};

/// Samples a walk and puts it among the route's traverses. The first one gives the route its unit. Without a
/// survey it has the poses of its own odometry, where there are any. `replace`: a traverse of the same name
/// makes room, which else is refused. Throws `vo::Error` naming the walk if it gives a single keyframe or
/// shows no motion; `std::invalid_argument` for a walk that was read with other settings.
AddedTraverse add(Route& route, const std::string& name, const vo::Walk& walk,
                  const std::optional<Survey>& survey = {}, const Settings& settings = {},
                  bool replace = false);

/// A walk found on a route.
struct Run {
  Settings settings;           ///< resolved
  SampledWalk sampled;         ///< its keyframes
  std::vector<Match> matches;  ///< one for each keyframe, in order
  int sequence_length = 0;     ///< keyframes, as used
  int lines = 0;               ///< distinct lines searched through each pair, where lines are
  ProbabilitySource probability_source = ProbabilitySource::kNone;  ///< see `RouteMatches`
  double wrong_share = 1, looked_at = 1;                            ///< see `RouteMatches`
  std::vector<std::string> warnings;                                ///< of the search
  QueryTrajectory drift;  ///< how the trajectory was corrected, or why not
  /// The walk's odometry without its drift, in the route's coordinates: a pose for each keyframe, where the
  /// route has poses and the matches bear it out.
  std::optional<vo::Trajectory> trajectory;
};

/// Finds a walk on a route: keyframes (`sample_walk`), matches (`match_on_route`), and, where the route has
/// poses, the trajectory (`query_trajectory`). `callback`: sees the cost matrices pass by. Throws `vo::Error`
/// for settings that do not go together, a walk without motion, a traverse shorter than the sequence;
/// `std::invalid_argument` for a route without traverses or a walk that was read with other settings.
Run localise(const Route& route, const vo::Walk& walk, const Settings& settings = {},
             const SearchCallback& callback = {});

/// `evaluate` of its matches.
RunEvaluation evaluate(const Run& run, const GroundTruth& truth, const Tolerance& tolerance);

}  // namespace place
