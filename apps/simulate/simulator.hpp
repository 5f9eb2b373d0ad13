#pragma once

#include "failure.hpp"
#include "gait.hpp"
#include "options.hpp"
#include "people.hpp"
#include "rasteriser.hpp"
#include "route.hpp"
#include "sensor.hpp"
#include "timetable.hpp"
#include "world.hpp"

#include <vector>

#include <opencv2/core.hpp>

namespace simulate {

/// Where the walker truly is when a frame is exposed.
struct TruthRow {
  int frame;
  double time_s;       ///< middle of the exposure
  double x_m, y_m;     ///< of the body, east and north; the camera swings about it
  double heading_deg;  ///< of the body, clockwise from +y
  double distance_m;   ///< along the route, the same for every walk of it
  int steps;           ///< taken since the beginning
};

/// Draws a walk frame by frame, in any order. The same options give the same bytes for any number of threads.
///
/// The constructor builds and lights the world, which takes two cores some two seconds for 120 m of street.
class WalkSimulator {
 public:
  /// Throws `vo::Error` if the options are out of range; see `validate`.
  explicit WalkSimulator(const Options& options);

  [[nodiscard]] const Options& options() const { return options_; }
  [[nodiscard]] const World& world() const { return world_; }
  /// Puts something more into the world, as it is, such as a target to be found again.
  void place(const Surface& surface) { world_.surfaces.push_back(surface); }
  [[nodiscard]] int frame_count() const { return frame_count_; }
  [[nodiscard]] const std::vector<Failure>& failures() const { return failures_; }

  /// Frames are 0 to frame_count() - 1; others throw `std::out_of_range`.
  [[nodiscard]] TruthRow truth(int frame) const;
  /// The camera in the middle of a frame's exposure, with its swing.
  [[nodiscard]] Camera camera(int frame) const;
  /// The picture, CV_8UC3 of options().size.
  [[nodiscard]] cv::Mat render(int frame) const;

 private:
  struct Body {
    vo::Pose2 pose;
    Timetable::Entry entry;
  };
  [[nodiscard]] double time_of(int frame) const;
  [[nodiscard]] Body body_at(double time_s) const;
  [[nodiscard]] Camera camera_at(double time_s) const;
  [[nodiscard]] cv::Mat picture_at(double time_s) const;

  Options options_;
  Route route_;
  WalkPath path_;
  Walker walker_;
  Timetable timetable_;
  World world_;
  std::vector<Passer> people_;
  std::vector<Failure> failures_;
  Exposure exposure_;
  int frame_count_;
};

}  // namespace simulate
