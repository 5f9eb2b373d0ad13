#include "vo/motion/monocular_vo.hpp"

#include "vo/base/median.hpp"
#include "vo/image/grey.hpp"
#include "vo/motion/landmark_map.hpp"
#include "vo/motion/landmark_tracking.hpp"
#include "vo/motion/resection.hpp"
#include "vo/motion/scene_start.hpp"
#include "vo/motion/track_segment.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <ranges>
#include <stdexcept>

#include <fmt/format.h>

namespace vo {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180;

/// How many cells of a coarse grid over the picture the points lie in.
std::size_t cells_of(const std::vector<cv::Point2f>& points, cv::Size picture) {
  constexpr int kColumns = 6, kRows = 4;
  std::vector<bool> taken(kColumns * kRows);
  for (const cv::Point2f& point : points) {
    const int column = std::clamp(static_cast<int>(point.x) * kColumns / picture.width, 0, kColumns - 1);
    const int row = std::clamp(static_cast<int>(point.y) * kRows / picture.height, 0, kRows - 1);
    taken[static_cast<std::size_t>(row * kColumns + column)] = true;
  }
  return static_cast<std::size_t>(std::ranges::count(taken, true));
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
      map_options_ = {.noise = options_.noise_px / camera_->fx_px,
                      .min_parallax_rad = options_.min_parallax_deg * kRadPerDeg,
                      .window = options_.window,
                      .radial_sigma = options_.radial_sigma,
                      .radial_step = options_.radial_step};
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
      lose(TrackLoss::kGap);
    } else if (state_ == State::kLost) {
      lose(TrackLoss::kTooFewCorners);
    } else {
      const bool tracking = state_ == State::kTracking;
      follow_landmarks(map_, before_, pyramid, *camera_,
                       tracking ? std::optional(compose(pose_, motion_)) : std::nullopt, options_.klt);
      tracking ? track() : wait();
    }
    before_ = std::move(pyramid);
  }

  DisplacementTrack finish() {
    end();
    return std::move(track_);
  }

 private:
  enum class State {
    kLost,      ///< the last frame has nothing to follow
    kStarting,  ///< points are followed, their depths not known yet
    kTracking,
  };

  [[nodiscard]] std::size_t now() const { return time_s_.size() - 1; }

  // ---- losing and starting ----

  /// Begins a scene with this frame.
  void start() {
    map_ = {.keyframes = {}, .landmarks = {}, .radial = map_.radial};  // that belongs to the camera
    waiting_.clear();
    map_.keyframes.push_back({now(), {}});
    add_corners(map_, grey_, *camera_, options_.corners);
    state_ = map_.landmarks.size() >= options_.min_points ? State::kStarting : State::kLost;
  }

  /// Writes down what there is of the scene.
  void end() {
    if (state_ == State::kStarting) give_up_waiting();
    if (state_ == State::kTracking) write_segment(segment_frames_, map_.keyframes, segment_, track_);
  }

  void lose(TrackLoss loss) {
    end();
    track_.frames.back().valid = false;
    track_.frames.back().loss = loss;
    start();
  }

  /// The frames that wait get no landmarks any more.
  void give_up_waiting() {
    if (waiting_.empty()) return;
    const double seconds = time_s_[waiting_.back().frame] - time_s_[map_.keyframes[0].frame];
    const bool still = stood_or_turned(waiting_, seconds, map_options_.noise);
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

  void wait() {
    const std::size_t followed = followed_landmarks(map_);
    if (followed < options_.min_points) return lose(TrackLoss::kTooFewCorners);
    waiting_.push_back(waiting_frame(map_, now(), map_options_.noise));
    if (waiting_.back().off > options_.start_parallax_deg * kRadPerDeg && begin()) return;
    // Nothing but a turn to be seen until most went out of view, or for long: from here anew.
    constexpr double kLeastShare = 0.4;
    constexpr std::size_t kMostWaiting = 250;
    const double share = static_cast<double>(followed) / static_cast<double>(map_.landmarks.size());
    if (share < kLeastShare || waiting_.size() >= kMostWaiting) {
      give_up_waiting();
      start();
    }
  }

  bool begin() {
    segment_frames_ = begin_scene(map_, waiting_, map_options_,
                                  {.min_parallax_rad = options_.start_parallax_deg * kRadPerDeg,
                                   .min_seen = options_.min_landmarks,
                                   .seed = options_.seed});
    if (segment_frames_.empty()) return false;
    if (begun_) ++segment_;
    begun_ = true;
    pose_ = map_.keyframes.back().pose;
    // The mean motion so far is a better guess than that of one frame.
    const Pose3 way = compose(inverse(map_.keyframes[0].pose), pose_);
    motion_ = interpolate({}, way, 1 / static_cast<double>(waiting_.size()));
    waiting_.clear();
    speeds_.clear();
    after_keyframe();
    state_ = State::kTracking;
    return true;
  }

  // ---- tracking ----

  void track() {
    if (followed_landmarks(map_) < options_.min_points) return lose(TrackLoss::kTooFewCorners);
    std::vector<Landmark*> landmarks;
    std::vector<cv::Vec3d> points;
    std::vector<ImagePoint> seen;
    for (Landmark& landmark : map_.landmarks) {
      if (!landmark.followed || !landmark.position) continue;
      landmarks.push_back(&landmark);
      points.push_back(*landmark.position);
      seen.push_back(landmark.at);
    }
    if (points.size() < options_.min_landmarks && stands()) {  // turned away from all it knew
      end();
      start();
      track_.frames.back().valid = true;
      return;
    }
    const Resection found = resection(points, seen, compose(pose_, motion_),
                                      {.noise = map_options_.noise, .seed = options_.seed});
    const auto inliers = static_cast<double>(found.inliers);
    if (found.inliers < options_.min_landmarks ||
        inliers < options_.min_inlier_share * static_cast<double>(points.size())) {
      return lose(TrackLoss::kTooFewInliers);
    }
    std::vector<cv::Point2f> fitting;
    for (std::size_t i = 0; i < landmarks.size(); ++i) {
      landmarks[i]->followed = found.fits[i];
      if (found.fits[i]) fitting.push_back(landmarks[i]->pixel);
    }
    if (cells_of(fitting, grey_.size()) < options_.min_cells) return lose(TrackLoss::kPoorSpread);
    const Pose3 motion = compose(inverse(pose_), found.camera);
    if (is_jump(motion)) return lose(TrackLoss::kJump);
    motion_ = motion;
    pose_ = found.camera;

    const std::size_t last = map_.keyframes.size() - 1;
    const Pose3& keyframe = map_.keyframes[last].pose;
    segment_frames_.push_back({.frame = now(),
                               .before = AnchoredPose{last, compose(inverse(keyframe), pose_)},
                               .sigma = displacement_sigma(found, pose_.rotation * motion.position)});
    if (cv::norm(pose_.position - keyframe.position) > options_.keyframe_travel * median_depth_ ||
        inliers < options_.keyframe_share * static_cast<double>(keyframe_landmarks_)) {
      make_keyframe();
    }
  }

  /// True if the camera hardly moved of late.
  [[nodiscard]] bool stands() const {
    constexpr double kStill = 1e-3;  // of the median depth, a frame: a centimetre at 10 m
    return !speeds_.empty() && median(speeds_) < kStill * median_depth_;
  }

  /// True if no camera moves so from one frame to the next.
  bool is_jump(const Pose3& motion) {
    if (angle_rad(motion.rotation) > options_.max_turn_deg * kRadPerDeg) return true;
    constexpr std::size_t kRemembered = 25;
    constexpr double kSmall = 0.1;  // of the median depth: a start from standing
    const double displacement = cv::norm(motion.position);
    if (speeds_.size() >= kRemembered / 2 && displacement > kSmall * median_depth_ &&
        displacement > options_.max_speedup * median(speeds_)) {
      return true;
    }
    speeds_.push_back(displacement);
    if (speeds_.size() > kRemembered) speeds_.erase(speeds_.begin());
    return false;
  }

  void make_keyframe() {
    const std::size_t last = map_.keyframes.size() - 1;
    const Pose3 new_from_last = compose(inverse(pose_), map_.keyframes[last].pose);
    for (SegmentFrame& frame : std::views::reverse(segment_frames_)) {
      if (frame.frame <= map_.keyframes[last].frame) break;
      if (frame.before)
        frame.after = AnchoredPose{last + 1, compose(new_from_last, frame.before->in_keyframe)};
    }
    segment_frames_.back().before = AnchoredPose{last + 1, {}};
    segment_frames_.back().after.reset();
    add_keyframe(map_, {now(), pose_});
    place_landmarks(map_, map_options_);
    adjust_window(map_, map_options_);
    pose_ = map_.keyframes.back().pose;
    track_.heights.back() = heights_above_ground();
    after_keyframe();
  }

  /// Of the last keyframe, above the landmarks that it sees.
  [[nodiscard]] std::vector<double> heights_above_ground() const {
    constexpr double kLongWay = 0.5;  // of the median depth: bounce and sway hardly turn its direction
    cv::Vec3d travel{0, 0, 0};
    for (const Keyframe& keyframe : std::views::reverse(map_.keyframes)) {
      travel = pose_.position - keyframe.pose.position;
      if (cv::norm(travel) >= kLongWay * median_depth_) break;
    }
    if (cv::norm(travel) < kLongWay * median_depth_) return {};
    std::vector<cv::Vec3d> points;
    for (const Landmark& landmark : map_.landmarks)
      if (landmark.followed && landmark.position) points.push_back(*landmark.position);
    return heights_above(pose_, travel, points, options_.ground);
  }

  void after_keyframe() {
    prune(map_, map_options_);
    std::vector<double> depths;
    for (const Landmark& landmark : map_.landmarks) {
      if (landmark.followed && landmark.position)
        depths.push_back((pose_.rotation.t() * (*landmark.position - pose_.position))[2]);
    }
    keyframe_landmarks_ = depths.size();
    if (!depths.empty()) median_depth_ = median(depths);
    add_corners(map_, grey_, *camera_, options_.corners);
  }

  MonocularVoOptions options_;
  LandmarkMapOptions map_options_;
  cv::Size size_;                 // of the frames
  std::optional<Camera> camera_;  // of the resized ones, known from the first
  State state_ = State::kLost;
  std::vector<double> time_s_;
  DisplacementTrack track_;
  cv::Mat grey_;
  KltPyramid before_;  // of the last frame

  LandmarkMap map_;
  std::vector<WaitingFrame> waiting_;
  std::vector<SegmentFrame> segment_frames_;
  int segment_ = 0;
  bool begun_ = false;  // the first segment has been

  Pose3 pose_;                  // of the last frame
  Pose3 motion_;                // of the last frame in the axes of the one before
  std::vector<double> speeds_;  // displacements of the last frames
  double median_depth_ = 1;     // of the landmarks, at the last keyframe
  std::size_t keyframe_landmarks_ = 0;
};

bool MonocularVoOptions::is_valid(std::string* error) const {
  const auto refuse = [&](std::string_view name, auto value, std::string_view expected) {
    *error = fmt::format("{} is {}; expected {}", name, value, expected);
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
