#pragma once

#include "vo/geometry/camera.hpp"
#include "vo/motion/displacement_track.hpp"
#include "vo/tracks/corner_grid.hpp"
#include "vo/tracks/klt_tracking.hpp"
#include "vo/visual_odometry/ground_height.hpp"

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

namespace vo {

/// Settings of `MonocularVo`.
struct MonocularVoOptions {
  int width_px = 1280;           ///< wider frames are resized to it
  double fov_deg = 64.4;         ///< horizontal, of a camera without calibration [PVO 5.3 (6)]
  std::optional<Camera> camera;  ///< calibrated, of the recording's own size
  CornerGridOptions corners;
  KltOptions klt;
  double noise_px = 0.5;            ///< standard deviation of a tracked point's position
  double min_parallax_deg = 0.4;    ///< between two rays to a landmark, to triangulate it
  double start_parallax_deg = 1.0;  ///< median over the points, to begin a scene
  std::size_t window = 8;           ///< keyframes adjusted together
  double radial_sigma = 0.02;       ///< standard deviation of the radial distortion left by calibration
  double radial_step = 0.002;       ///< standard deviation of its change in one adjustment; 0: not learned
  double keyframe_travel = 0.08;    ///< travel since the last keyframe, as a share of the median depth
  double keyframe_share = 0.7;      ///< or landmarks still seen, as a share of those it saw
  std::size_t min_points = 20;      ///< with fewer points tracked: lost
  std::size_t min_landmarks = 8;    ///< with fewer landmarks where they should be: lost
  double min_inlier_share = 0.5;    ///< of the landmarks tracked
  std::size_t min_cells = 4;        ///< of 6 x 4 over the picture that the landmarks lie in
  double max_turn_deg = 20;         ///< from one frame to the next
  double max_speedup = 5;           ///< times the median displacement of the last frames
  double max_gap_s = 0.5;           ///< seconds without a frame or a pose after which a scene is given up
  GroundHeightOptions ground;
  int seed = 1;  ///< of random samples

  /// True if every field is in its range; else says in `*error` which is not.
  [[nodiscard]] bool is_valid(std::string* error) const;
};

/// Monocular visual odometry (SSS 3.5 uses ORB-SLAM, Mur-Artal et al. 2015; this has its structure, but
/// tracks points instead of matching them): from pictures to the distance the camera moved in each frame, in
/// a unit that lasts until tracking is lost.
///
/// Corners are tracked from frame to frame. As soon as the points shift against each other, the first
/// keyframe and a later one give the geometry and the first landmarks, whose median depth is the unit of
/// length. From then on each frame's pose comes from the landmarks it sees, new ones are triangulated from
/// keyframes of known pose, so that the unit lasts, and the last keyframes are adjusted together. A camera
/// that is still or only turns has displacement 0. A frame whose pose cannot be found is lost, with a reason;
/// the next ones are tried from the last one found, for up to `max_gap_s`, so that one bad frame does not end
/// a unit. Meanwhile points of the new view are tracked as well, and whichever succeeds first continues: the
/// old scene, or a new segment begun from two views.
class MonocularVo {
 public:
  /// Throws `std::invalid_argument` for options out of range.
  explicit MonocularVo(const MonocularVoOptions& options = {});
  ~MonocularVo();
  MonocularVo(MonocularVo&&) noexcept;
  MonocularVo& operator=(MonocularVo&&) noexcept;

  /// Takes the next frame, 8 bit grey or BGR, all of one size, at strictly increasing times. Throws
  /// `vo::Error` if a calibrated camera is of another size, `std::invalid_argument` if frames differ in size
  /// or times do not increase. O(pixels + corners), plus the adjustment at each keyframe.
  void push(const cv::Mat& frame, double time_s);

  /// The track of all frames, which are adjusted until the end. Nothing may be pushed afterwards.
  DisplacementTrack finish();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// The same for frames that are all in memory. `time_s`: one for each.
DisplacementTrack monocular_vo(std::span<const cv::Mat> frames, std::span<const double> time_s,
                               const MonocularVoOptions& options = {});

}  // namespace vo
