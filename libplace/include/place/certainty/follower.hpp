#pragma once

#include "place/route/route.hpp"
#include "place/settings.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <vo/base/trajectory.hpp>
#include <vo/io/frame_source.hpp>

namespace place {

/// What is known of where a walker is.
enum class FollowState {
  kSearching,  ///< not found yet, or lost
  kOnRoute,
  kOffRoute,  ///< was on the route and left it
};

/// The state as a word: "searching", "on_route", "off_route".
std::string name_of(FollowState state);

/// A place on the route, between its keyframes too.
struct FollowedPlace {
  std::string traverse;
  std::size_t keyframe = 0;          ///< the nearest
  std::int64_t reference_frame = 0;  ///< of the traverse's source video
  std::optional<double> distance_m;  ///< along the route, where surveyed
  std::optional<double> sd_m;        ///< standard deviation along the route, where surveyed
  double sd_keyframes = 0;           ///< the same in keyframes
  double probability = 0;            ///< that this is the place
  std::optional<vo::Pose2> pose;     ///< where the route has poses
};

/// The answer to a frame. It depends on no later one.
struct Position {
  std::int64_t frame = 0;
  double time_s = 0;
  FollowState state = FollowState::kSearching;
  std::optional<FollowedPlace> place;  ///< where the state is on the route
  double off_route = 0;                ///< probability of being off the route
  bool described = false;              ///< this picture was compared with the route
  /// The surer answer of `FollowerOptions::lag_s` ago, or of the first description, with the frame it is of.
  std::optional<std::int64_t> lag_frame;
  std::optional<FollowedPlace> lag_place;  ///< none where the walker was on no place of the route
};

/// Where the walker was at an earlier frame, as is known by now.
struct EarlierPlace {
  std::int64_t frame = 0;
  std::optional<FollowedPlace> place;  ///< none where he was on no place of the route
};

/// Settings of `Follower`.
struct FollowerOptions {
  double lag_s = 0;  ///< seconds that a second answer looks back by, up to 60; 0: no second answer
};

/// Says where on a route a walker is, frame by frame, while he walks. No clock, no thread and no file of its
/// own.
///
/// A frame's thumbnail gives the distance moved (`vo::MotionFollower`); half a keyframe on, the frame is
/// described and compared with every keyframe of the route, and a histogram filter (`PlaceFilter`) joins the
/// two. Costs are standardised over each traverse as a query's row is (`enhance_contrast`), and each
/// keyframe's over what was seen before it; what a keyframe's costs usually are is known beforehand from the
/// route itself, some of whose keyframes play queries. A cost c makes a place exp(-0.8 (c + e)) times as
/// probable as being off the route, to the power of the keyframes walked since the last description: pictures
/// close to each other repeat themselves. e is 1.5, or 0.55 times what places on the route cost on this walk
/// so far, if that is more. Between two descriptions the place moves on with the walker.
///
/// A walker who is on a street much like one of the route may be taken to be on the route for a while:
/// tests/RESULTS.md, "Following".
///
/// The first answer needs the route and about five seconds of walk. O(keyframes) for each description, of
/// which there are two for each keyframe walked; memory does not grow.
class Follower {
 public:
  /// `settings`: of the reading of frames, as for `localise`; what they do not give is the route's. The route
  /// must outlive this. Throws `vo::Error` for settings that do not go together, a route without traverses,
  /// or one whose descriptors come from a file and so cannot be made of a new picture;
  /// `std::invalid_argument` for another lag.
  explicit Follower(const Route& route, const Settings& settings = {}, const FollowerOptions& options = {});
  ~Follower();
  Follower(Follower&&) noexcept;
  Follower& operator=(Follower&&) noexcept;

  /// The next frame; `time_s` later than the one before, else `std::invalid_argument`.
  Position push(const vo::Frame& frame);

  /// After the last frame: the surer answers that no later one has brought, of the frames described within
  /// the lag, oldest first. None without a lag. O(keyframes * n^2) for n descriptions
  /// in the lag.
  [[nodiscard]] std::vector<EarlierPlace> finish() const;

  /// All settings in use, the route's and those given.
  [[nodiscard]] const Settings& settings() const;

  /// How frames are to be read: `vo::open_frame_source` with these gives what `push` takes.
  [[nodiscard]] const vo::FrameSourceOptions& frame_source() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace place
