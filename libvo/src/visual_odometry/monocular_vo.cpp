#include "vo/visual_odometry/monocular_vo.hpp"

#include "vo/base/degrees.hpp"
#include "vo/image/grey.hpp"
#include "vo/visual_odometry/landmark_tracking.hpp"
#include "vo/visual_odometry/scene_start.hpp"
#include "vo/visual_odometry/scene_tracking.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace vo {
namespace {

SceneTrackingOptions scene_options(const MonocularVoOptions& options, const Camera& camera) {
  const double noise = options.noise_px / camera.fx_px;
  return {.map = {.noise = noise,
                  .min_parallax_rad = options.min_parallax_deg * kRadPerDeg,
                  .window = options.window,
                  .radial_sigma = options.radial_sigma,
                  .radial_step = options.radial_step},
          .pose = {.noise = noise,
                   .min_points = options.min_points,
                   .min_landmarks = options.min_landmarks,
                   .min_inlier_share = options.min_inlier_share,
                   .min_cells = options.min_cells,
                   .seed = options.seed},
          .corners = options.corners,
          .klt = options.klt,
          .ground = options.ground,
          .keyframe_travel = options.keyframe_travel,
          .keyframe_share = options.keyframe_share,
          .max_turn_rad = options.max_turn_deg * kRadPerDeg,
          .max_speedup = options.max_speedup};
}

}  // namespace

class MonocularVo::Impl {
 public:
  explicit Impl(const MonocularVoOptions& options) : options_(options) {}

  void push(const cv::Mat& image, double time_s) {
    if (!camera_) {
      size_ = image.size();
      const Camera camera = camera_of_recording(options_.camera, size_.width, size_.height, options_.fov_deg);
      camera_ = resized(camera, std::min(size_.width, options_.width_px));
      scene_options_ = scene_options(options_, *camera_);
    }
    const bool first = time_s_.empty();
    if (image.size() != size_) throw std::invalid_argument("MonocularVo: frames of one size expected");
    if (!first && time_s <= time_s_.back())
      throw std::invalid_argument("MonocularVo: strictly increasing times expected");
    const bool gap = !first && time_s - time_s_.back() > options_.max_gap_s;
    time_s_.push_back(time_s);
    grey_ = grey_of(image, options_.width_px);
    KltPyramid pyramid = klt_pyramid(grey_, options_.klt);
    track_.frames.push_back({.valid = first, .segment = segment_});
    track_.poses.emplace_back();
    track_.heights.emplace_back();
    if (first) {
      start();
    } else if (gap) {
      end();
      lose(TrackLoss::kGap);
    } else if (state_ == State::kTracking) {
      track(pyramid);
    } else if (!resume(pyramid)) {
      state_ == State::kLost ? lose(TrackLoss::kTooFewCorners) : wait(pyramid);
    }
    before_ = std::move(pyramid);
  }

  DisplacementTrack finish() {
    end();
    return std::move(track_);
  }

 private:
  enum class State {
    kLost,      ///< the last frame has nothing to track
    kStarting,  ///< points are tracked, their depths not known yet
    kTracking,
  };

  /// A lost scene, and the last picture of it.
  struct BrokenOff {
    TrackedScene scene;
    KltPyramid picture;
    TrackLoss loss = TrackLoss::kNone;
  };

  [[nodiscard]] std::size_t now() const { return time_s_.size() - 1; }

  // ---- losing and starting ----

  /// Begins a scene with this frame.
  void start() {
    const double radial = scene_.map.radial;  // a property of the camera, kept
    scene_ = {.map = {.keyframes = {{now(), {}}}, .landmarks = {}, .radial = radial}};
    waiting_.clear();
    add_corners(scene_.map, grey_, *camera_, options_.corners);
    state_ = scene_.map.landmarks.size() >= options_.min_points ? State::kStarting : State::kLost;
  }

  /// Writes the scene so far into the track.
  void end() {
    write_broken_off();
    if (state_ == State::kStarting) give_up_waiting();
    if (state_ == State::kTracking) write(scene_);
  }

  void write(TrackedScene& scene) {
    finish_heights(scene, scene_options_);
    write_segment(scene.frames, scene.map.keyframes, segment_, track_);
    for (std::size_t i = 0; i < scene.heights.size(); ++i) {
      const std::size_t frame = scene.map.keyframes[i].frame;
      if (track_.frames[frame].segment == segment_) track_.heights[frame] = std::move(scene.heights[i]);
    }
  }

  void write_broken_off() {
    if (broken_off_) write(broken_off_->scene);
    broken_off_.reset();
  }

  void lose(TrackLoss loss) {
    if (state_ == State::kStarting) give_up_waiting();
    track_.frames.back().valid = false;
    track_.frames.back().loss = loss;
    start();
  }

  /// The waiting frames will get no landmarks.
  void give_up_waiting() {
    if (waiting_.empty()) return;
    const double seconds = time_s_[waiting_.back().frame] - time_s_[scene_.map.keyframes[0].frame];
    const bool still = stood_or_turned(waiting_, seconds, scene_options_.map.noise);
    cv::Matx33d before = cv::Matx33d::eye();
    for (const WaitingFrame& frame : waiting_) {
      TrackedDisplacement& result = track_.frames[frame.frame];
      result.valid = still;
      result.loss = still ? TrackLoss::kNone : TrackLoss::kLowParallax;
      if (still) result.turn_rad = heading_change_rad(before, frame.rotation);
      before = frame.rotation;
    }
    waiting_.clear();
  }

  void wait(const KltPyramid& pyramid) {
    follow_landmarks(scene_.map, before_, pyramid, *camera_, std::nullopt, options_.klt);
    const std::size_t followed = followed_landmarks(scene_.map);
    if (followed < options_.min_points) return lose(TrackLoss::kTooFewCorners);
    waiting_.push_back(waiting_frame(scene_.map, now(), scene_options_.map.noise));
    if (waiting_.back().off > options_.start_parallax_deg * kRadPerDeg && begin()) return;
    // Only a turn was seen until most points left the view, or for long: start again from here.
    constexpr double kLeastShare = 0.4;
    constexpr std::size_t kMostWaiting = 250;
    const double share = static_cast<double>(followed) / static_cast<double>(scene_.map.landmarks.size());
    if (share < kLeastShare || waiting_.size() >= kMostWaiting) {
      give_up_waiting();
      start();
    }
  }

  bool begin() {
    std::vector<SegmentFrame> frames =
        begin_scene(scene_.map, waiting_, scene_options_.map,
                    {.min_parallax_rad = options_.start_parallax_deg * kRadPerDeg,
                     .min_seen = options_.min_landmarks,
                     .seed = options_.seed});
    if (frames.empty()) return false;
    write_broken_off();
    if (begun_) ++segment_;
    begun_ = true;
    scene_.frames = std::move(frames);
    scene_.pose = scene_.map.keyframes.back().pose;
    // The mean motion so far is a better guess than that of one frame.
    const Pose3 moved = compose(inverse(scene_.map.keyframes[0].pose), scene_.pose);
    scene_.motion = interpolate({}, moved, 1 / static_cast<double>(waiting_.size()));
    waiting_.clear();
    renew_landmarks(scene_, grey_, *camera_, scene_options_);
    state_ = State::kTracking;
    return true;
  }

  // ---- tracking ----

  void track(const KltPyramid& pyramid) {
    const LandmarkPose pose = locate(scene_, now(), before_, pyramid, *camera_, scene_options_);
    if (pose.loss == TrackLoss::kNone) {
      add_frame(scene_, now(), pose.found, grey_, *camera_, scene_options_);
    } else if (pose.loss == TrackLoss::kTooFewInliers && pose.landmarks < options_.min_landmarks &&
               is_still(scene_)) {
      end();  // turned away from all known landmarks
      start();
      track_.frames.back().valid = true;
    } else {
      broken_off_ = BrokenOff{scene_, before_, pose.loss};
      lose(pose.loss);
    }
  }

  /// Resumes the lost scene if this frame shows it again after one or more useless ones, unless a new scene
  /// has begun or the camera may be elsewhere. The frames in between stay lost.
  bool resume(const KltPyramid& pyramid) {
    if (!broken_off_) return false;
    TrackedScene& scene = broken_off_->scene;
    const std::size_t last = scene.frames.back().frame;
    if (time_s_.back() - time_s_[last] > options_.max_gap_s) {
      write_broken_off();
      return false;
    }
    const LandmarkPose pose = locate(scene, now(), broken_off_->picture, pyramid, *camera_, scene_options_);
    if (pose.loss != TrackLoss::kNone) return false;
    for (std::size_t i = last + 1; i <= now(); ++i)
      track_.frames[i] = {.valid = false, .segment = segment_, .loss = broken_off_->loss};
    scene_ = std::move(scene);
    broken_off_.reset();
    waiting_.clear();
    state_ = State::kTracking;
    add_frame(scene_, now(), pose.found, grey_, *camera_, scene_options_);
    return true;
  }

  MonocularVoOptions options_;
  SceneTrackingOptions scene_options_;
  cv::Size size_;                 // of the frames
  std::optional<Camera> camera_;  // of the resized frames, known from the first
  State state_ = State::kLost;
  std::vector<double> time_s_;
  DisplacementTrack track_;
  cv::Mat grey_;
  KltPyramid before_;  // of the last frame

  TrackedScene scene_;
  std::vector<WaitingFrame> waiting_;
  std::optional<BrokenOff> broken_off_;
  int segment_ = 0;
  bool begun_ = false;  // the first segment has begun
};

bool MonocularVoOptions::is_valid(std::string* error) const {
  const auto refuse = [&](std::string_view name, auto value, std::string_view expected) {
    if (error != nullptr) *error = fmt::format("{} is {}; expected {}", name, value, expected);
    return false;
  };
  if (width_px < 16) return refuse("width_px", width_px, "at least 16");
  if (!(noise_px > 0)) return refuse("noise_px", noise_px, "> 0");
  if (!(min_parallax_deg > 0)) return refuse("min_parallax_deg", min_parallax_deg, "> 0");
  if (!(start_parallax_deg > 0)) return refuse("start_parallax_deg", start_parallax_deg, "> 0");
  if (window < 2) return refuse("window", window, "at least 2");
  if (min_points < 8) return refuse("min_points", min_points, "at least 8");
  if (min_landmarks < 4) return refuse("min_landmarks", min_landmarks, "at least 4");
  if (!(radial_sigma > 0)) return refuse("radial_sigma", radial_sigma, "> 0");
  if (!(radial_step >= 0)) return refuse("radial_step", radial_step, ">= 0");
  if (!(max_gap_s > 0)) return refuse("max_gap_s", max_gap_s, "> 0");
  if (!(fov_deg >= 10 && fov_deg <= 170)) return refuse("fov_deg", fov_deg, "10 to 170");
  if (!(keyframe_travel > 0)) return refuse("keyframe_travel", keyframe_travel, "> 0");
  if (!(keyframe_share >= 0 && keyframe_share <= 1))
    return refuse("keyframe_share", keyframe_share, "0 to 1");
  if (!(min_inlier_share >= 0 && min_inlier_share <= 1))
    return refuse("min_inlier_share", min_inlier_share, "0 to 1");
  if (!(max_turn_deg > 0)) return refuse("max_turn_deg", max_turn_deg, "> 0");
  if (!(max_speedup > 1)) return refuse("max_speedup", max_speedup, "> 1");
  return true;
}

MonocularVo::MonocularVo(const MonocularVoOptions& options) : impl_(std::make_unique<Impl>(options)) {
  if (std::string error; !options.is_valid(&error)) throw std::invalid_argument("MonocularVo: " + error);
}
MonocularVo::~MonocularVo() = default;
MonocularVo::MonocularVo(MonocularVo&&) noexcept = default;
MonocularVo& MonocularVo::operator=(MonocularVo&&) noexcept = default;

void MonocularVo::push(const cv::Mat& frame, double time_s) {
  impl_->push(frame, time_s);
}

DisplacementTrack MonocularVo::finish() {
  return impl_->finish();
}

DisplacementTrack monocular_vo(std::span<const cv::Mat> frames, std::span<const double> time_s,
                               const MonocularVoOptions& options) {
  if (frames.size() != time_s.size())
    throw std::invalid_argument("monocular_vo: one time for each frame expected");
  MonocularVo vo(options);
  for (std::size_t i = 0; i < frames.size(); ++i) vo.push(frames[i], time_s[i]);
  return vo.finish();
}

}  // namespace vo
