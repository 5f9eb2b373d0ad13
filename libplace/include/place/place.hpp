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

/// The whole library on one screen: a first walk makes a route, another is found on it, the matches are
/// compared with the truth, and they correct the drift of the walk's odometry.
///
/// Settings are given once. A new route keeps them, and every walk read for it, added to it or found on it
/// uses them too (`resolve`), so that nothing has to be passed from one call to the next.
namespace place {

/// A route without traverses. Throws `vo::Error` for settings that are not compatible (`resolve`).
Route new_route(const Settings& settings = {});

/// Reads a recording (`vo::read_walk`), keeping what the settings of a new route need; with motion from a
/// file, also the file's track. Throws `vo::Error` if it cannot be read, or for settings that are not
/// compatible. Takes the time of decoding, see `vo::read_walk`.
vo::Walk read(const std::string& source, const Settings& settings, const vo::ProgressCallback& progress = {});
/// The same for several files in order, as one walk.
vo::Walk read(std::span<const std::string> sources, const Settings& settings,
              const vo::ProgressCallback& progress = {});
/// The same for a walk to be found on a route: settings not given are the route's.
vo::Walk read(const std::string& source, const Route& route, const Settings& settings = {},
              const vo::ProgressCallback& progress = {});
vo::Walk read(std::span<const std::string> sources, const Route& route, const Settings& settings = {},
              const vo::ProgressCallback& progress = {});

/// The result of adding a walk to a route.
struct AddedTraverse {
  std::size_t index = 0;              ///< in the route's traverses
  double scale = 1;                   ///< see `SampledWalk::scale`
  std::optional<double> gait_share;   ///< see `MotionChoice`, where motion was auto
  std::vector<std::string> warnings;  ///< what a user should know about its motion and keyframes
};

/// Samples a walk and adds it to the route's traverses. The first one gives the route its unit, and with
/// `motion auto` its motion (`choose_motion`), which the route's settings then name. Without a survey it has
/// the poses of its own odometry, if any. `replace`: replaces a traverse of the same name, which is otherwise
/// refused. Throws `vo::Error` naming the walk if it gives only one keyframe or shows no motion;
/// `std::invalid_argument` for a walk that was read with other settings.
AddedTraverse add(Route& route, const std::string& name, const vo::Walk& walk,
                  const std::optional<Survey>& survey = {}, const Settings& settings = {},
                  bool replace = false);

/// A walk found on a route.
struct Run {
  Settings settings;           ///< resolved
  SampledWalk sampled;         ///< its keyframes
  std::vector<Match> matches;  ///< one for each keyframe, in order
  int sequence_length = 0;     ///< keyframes, as used
  int lines = 0;               ///< distinct lines searched through each pair; 0 without lines
  ProbabilitySource probability_source = ProbabilitySource::kNone;  ///< see `RouteMatches`
  double wrong_share = 1, looked_at = 1;                            ///< see `RouteMatches`
  std::vector<std::string> warnings;  ///< of the search, and where it hardly found the walk (`not_found`)
  QueryTrajectory drift;              ///< how the trajectory was corrected, or why not
  /// The walk's odometry with its drift removed, in the route's coordinates: a pose for each keyframe, if the
  /// route has poses and the matches confirm it.
  std::optional<vo::Trajectory> trajectory;
};

/// Finds a walk on a route: keyframes (`sample_walk`), matches (`match_on_route`) and, if the route has
/// poses, the trajectory (`query_trajectory`). `callback`: receives the cost matrices. `search`: for a
/// route that was read without descriptors (`StoredSearch`). Throws `vo::Error` for
/// settings that are not compatible, a walk without motion, a traverse shorter than the sequence;
/// `std::invalid_argument` for a route without traverses or a walk that was read with other settings.
Run localise(const Route& route, const vo::Walk& walk, const Settings& settings = {},
             const SearchCallback& callback = {}, TraverseSearch* search = nullptr);

/// `evaluate` for the run's matches.
RunEvaluation evaluate(const Run& run, const GroundTruth& truth, const Tolerance& tolerance);

}  // namespace place
