#include "vo/motion/monocular_vo.hpp"

#include "vo/base/error.hpp"
#include "vo/base/median.hpp"
#include "vo/motion/landmark_map.hpp"
#include "vo/motion/resection.hpp"
#include "vo/motion/triangulation.hpp"
#include "vo/motion/two_view_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <opencv2/core/eigen.hpp>
#include <opencv2/imgproc.hpp>

namespace vo {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180;

Pose3 compose(const Pose3& a, const Pose3& b) {
  return {.rotation = a.rotation * b.rotation, .position = a.rotation * b.position + a.position};
}

Pose3 inverse(const Pose3& a) {
  return {.rotation = a.rotation.t(), .position = -(a.rotation.t() * a.position)};
}

double angle_of_rad(const cv::Matx33d& rotation) {
  return std::acos(std::clamp((cv::trace(rotation) - 1) / 2, -1.0, 1.0));
}

Pose3 between(const Pose3& a, const Pose3& b, double t) {
  Eigen::Matrix3d from, to;
  cv::cv2eigen(a.rotation, from);
  cv::cv2eigen(b.rotation, to);
  const Eigen::Quaterniond q = Eigen::Quaterniond(from).slerp(t, Eigen::Quaterniond(to));
  Pose3 pose{.position = a.position * (1 - t) + b.position * t};
  cv::eigen2cv(Eigen::Matrix3d(q.toRotationMatrix()), pose.rotation);
  return pose;
}

/// A frame's pose as seen from a keyframe, so that it goes with it when that is adjusted.
struct Anchored {
  std::size_t keyframe = 0;
  Pose3 in_keyframe;
};

/// A frame of the segment that goes on.
struct SegmentFrame {
  std::size_t frame = 0;
  std::optional<Anchored> before, after;  ///< by the keyframes on either side; none: its pose is not known
  double sigma = 0;
};

/// A frame since the scene was begun, before there are landmarks.
struct WaitingFrame {
  std::size_t frame = 0;
  struct Seen {
    std::size_t landmark;
    ImagePoint at;
  };
  std::vector<Seen> seen;
  cv::Matx33d rotation;  ///< in the axes of the first, if all it did was turn
  double off_px = 0;     ///< how far points are from where that turn takes them, median
};

cv::Mat grey_of(const cv::Mat& frame, int width_px) {
  cv::Mat grey = frame;
  if (frame.channels() == 3) cv::cvtColor(frame, grey, cv::COLOR_BGR2GRAY);
  if (grey.cols <= width_px) return grey;
  cv::Mat small;
  const int height_px = static_cast<int>(std::lround(static_cast<double>(grey.rows) * width_px / grey.cols));
  cv::resize(grey, small, {width_px, std::max(1, height_px)}, 0, 0, cv::INTER_AREA);
  return small;
}

Camera camera_of(const cv::Mat& frame, const MonocularVoOptions& options) {
  if (!options.camera) return camera_from_fov(frame.cols, frame.rows, options.fov_deg);
  if (options.camera->width_px != frame.cols || options.camera->height_px != frame.rows) {
    throw Error("camera calibration",
                fmt::format("is of {}x{} pixels", options.camera->width_px, options.camera->height_px),
                fmt::format("{}x{}, as the recording", frame.cols, frame.rows));
  }
  return *options.camera;
}

/// Turn to the right between two poses: where the second looks, seen from the first.
double turn_between_rad(const cv::Matx33d& from, const cv::Matx33d& to) {
  const cv::Matx33d turn = from.t() * to;
  return std::atan2(turn(0, 2), turn(2, 2));
}

}  // namespace

class MonocularVo::Impl {
 public:
  explicit Impl(const MonocularVoOptions& options) : options_(options) {}

  void push(const cv::Mat& image, double time_s) {
    if (!camera_) {
      camera_ = resized(camera_of(image, options_), std::min(image.cols, options_.width_px));
      map_options_ = {.noise = options_.noise_px / camera_->fx_px,
                      .min_parallax_rad = options_.min_parallax_deg * kRadPerDeg,
                      .window = options_.window};
    }
    grey_ = grey_of(image, options_.width_px);
    const double before_s = time_s_.empty() ? time_s : time_s_.back();
    time_s_.push_back(time_s);
    KltPyramid pyramid = klt_pyramid(grey_, options_.klt);
    const bool first = track_.frames.empty();
    track_.frames.push_back({.valid = first, .segment = segment_});
    track_.poses.emplace_back();
    if (first) {
      start();
    } else if (time_s - before_s > options_.max_gap_s) {
      lose(TrackLoss::kGap);
    } else if (state_ == State::kLost) {
      lose(loss_);
    } else {
      follow_landmarks(pyramid);
      if (state_ == State::kStarting)
        wait();
      else
        track();
    }
    before_ = std::move(pyramid);
  }

  DisplacementTrack finish() {
    end_segment();
    return std::move(track_);
  }

 private:
  enum class State { kLost, kStarting, kTracking };

  [[nodiscard]] std::size_t now() const { return track_.frames.size() - 1; }
  [[nodiscard]] double fx() const { return camera_->fx_px; }

  [[nodiscard]] std::size_t followed() const {
    return static_cast<std::size_t>(std::ranges::count(map_.landmarks, true, &Landmark::followed));
  }

  // ---- following ----

  void add_corners() {
    std::vector<cv::Point2f> existing;
    for (const Landmark& landmark : map_.landmarks) {
      if (landmark.followed) existing.push_back(landmark.pixel);
    }
    const std::vector<cv::Point2f> corners = grid_corners(grey_, existing, options_.corners);
    std::vector<ImagePoint> pixels;
    for (const cv::Point2f& corner : corners) pixels.push_back({corner.x, corner.y});
    const std::vector<ImagePoint> at = undistort(*camera_, pixels);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      Landmark landmark{.pixel = corners[i], .at = at[i]};
      landmark.sightings.push_back({map_.keyframes.size() - 1, at[i]});
      map_.landmarks.push_back(std::move(landmark));
    }
  }

  void follow_landmarks(const KltPyramid& pyramid) {
    std::vector<Landmark*> landmarks;
    std::vector<cv::Point2f> from, guess;
    const Pose3 predicted = compose(pose_, motion_);
    for (Landmark& landmark : map_.landmarks) {
      if (!landmark.followed) continue;
      landmarks.push_back(&landmark);
      from.push_back(landmark.pixel);
      cv::Point2f flow = landmark.flow;
      if (state_ == State::kTracking && landmark.position) {
        if (const auto at = project(predicted, *landmark.position)) {
          flow = {static_cast<float>(fx() * (at->x - landmark.at.x)),
                  static_cast<float>(camera_->fy_px * (at->y - landmark.at.y))};
        }
      }
      guess.push_back(landmark.pixel + flow);
    }
    const auto found = follow(before_, pyramid, from, guess, options_.klt);
    std::vector<ImagePoint> pixels;
    for (const auto& at : found) pixels.push_back(at ? ImagePoint{at->x, at->y} : ImagePoint{});
    const std::vector<ImagePoint> at = undistort(*camera_, pixels);
    for (std::size_t i = 0; i < landmarks.size(); ++i) {
      Landmark& landmark = *landmarks[i];
      landmark.followed = found[i].has_value();
      if (!landmark.followed) continue;
      landmark.flow = *found[i] - landmark.pixel;
      landmark.pixel = *found[i];
      landmark.at = at[i];
    }
  }

  // ---- starting ----

  /// Begins a scene with this frame.
  void start() {
    map_ = {};
    waiting_.clear();
    map_.keyframes.push_back({now(), {}});
    add_corners();
    state_ = map_.landmarks.size() >= options_.min_points ? State::kStarting : State::kLost;
    loss_ = TrackLoss::kTooFewCorners;
  }

  /// This frame is lost; a scene is begun with it.
  void lose(TrackLoss loss) {
    if (state_ == State::kTracking) end_segment();
    if (state_ == State::kStarting) give_up_waiting();
    track_.frames.back().valid = false;
    track_.frames.back().loss = loss;
    start();
  }

  void wait() {
    WaitingFrame frame{.frame = now()};
    std::vector<ImagePoint> from, to;
    for (std::size_t i = 0; i < map_.landmarks.size(); ++i) {
      const Landmark& landmark = map_.landmarks[i];
      if (!landmark.followed) continue;
      frame.seen.push_back({i, landmark.at});
      from.push_back(landmark.sightings[0].at);
      to.push_back(landmark.at);
    }
    if (from.size() < options_.min_points) return lose(TrackLoss::kTooFewCorners);
    const ViewRotation turned = view_rotation(from, to, map_options_.noise);
    frame.rotation = turned.rotation;
    frame.off_px = median(turned.off) * fx();
    waiting_.push_back(std::move(frame));
    if (waiting_.back().off_px > options_.start_parallax_deg * kRadPerDeg * fx() && begin_map(from, to))
      return;
    constexpr double kLeastShare = 0.4;
    constexpr std::size_t kMostWaiting = 250;
    if (static_cast<double>(from.size()) < kLeastShare * static_cast<double>(map_.landmarks.size()) ||
        waiting_.size() >= kMostWaiting) {
      give_up_waiting();
      start();
    }
  }

  /// The frames that wait have no landmarks. They stood or only turned if their points moved as one; else
  /// they are lost.
  void give_up_waiting() {
    if (waiting_.empty()) return;
    const WaitingFrame& last = waiting_.back();
    const double seconds = time_s_[last.frame] - time_s_[map_.keyframes[0].frame];
    constexpr double kLeastSeconds = 0.5, kLeastTurn_rad = 10 * kRadPerDeg, kShareOfTurn = 0.02;
    const double turn_rad = angle_of_rad(last.rotation);
    const double still_px = 2 * options_.noise_px + kShareOfTurn * turn_rad * fx();
    const bool still = last.off_px <= still_px && (seconds >= kLeastSeconds || turn_rad >= kLeastTurn_rad);
    cv::Matx33d before = cv::Matx33d::eye();
    for (const WaitingFrame& frame : waiting_) {
      TrackedDisplacement& result = track_.frames[frame.frame];
      result.valid = still;
      result.loss = still ? TrackLoss::kNone : TrackLoss::kLowParallax;
      if (still) result.turn_rad = turn_between_rad(before, frame.rotation);
      before = frame.rotation;
    }
    waiting_.clear();
  }

  /// The first landmarks, from the first frame and this.
  bool begin_map(const std::vector<ImagePoint>& from, const std::vector<ImagePoint>& to) {
    const auto geometry = two_view_geometry(from, to, {.noise = map_options_.noise, .seed = options_.seed});
    if (!geometry || geometry->parallax_rad < options_.start_parallax_deg * kRadPerDeg) return false;
    std::vector<double> depths;
    for (const auto& point : geometry->points) {
      if (point) depths.push_back((*point)[2]);
    }
    const double unit = median(depths);
    const WaitingFrame& last = waiting_.back();
    for (std::size_t i = 0; i < last.seen.size(); ++i) {
      if (geometry->points[i]) map_.landmarks[last.seen[i].landmark].position = *geometry->points[i] / unit;
    }
    Pose3 second = geometry->second;
    second.position /= unit;
    add_keyframe(map_, {now(), second});
    adjust_window(map_, map_options_);

    if (begun_) ++segment_;
    begun_ = true;
    segment_frames_.assign(1, {.frame = map_.keyframes[0].frame, .before = Anchored{0, {}}});
    Pose3 pose;
    for (std::size_t i = 0; i + 1 < waiting_.size(); ++i) {
      std::vector<cv::Vec3d> points;
      std::vector<ImagePoint> seen;
      for (const WaitingFrame::Seen& one : waiting_[i].seen) {
        const auto& position = map_.landmarks[one.landmark].position;
        if (!position) continue;
        points.push_back(*position);
        seen.push_back(one.at);
      }
      const Resection found =
          resection(points, seen, pose, {.noise = map_options_.noise, .seed = options_.seed});
      SegmentFrame frame{.frame = waiting_[i].frame};
      if (found.inliers >= options_.min_landmarks) {
        pose = found.camera;
        frame.before = Anchored{0, pose};
        frame.after = Anchored{1, compose(inverse(map_.keyframes[1].pose), pose)};
      }
      segment_frames_.push_back(frame);
    }
    waiting_.clear();
    pose_ = map_.keyframes[1].pose;
    motion_ = compose(inverse(pose), pose_);
    segment_frames_.push_back({.frame = now(), .before = Anchored{1, {}}});
    after_keyframe();
    speeds_.clear();
    state_ = State::kTracking;
    return true;
  }

  // ---- tracking ----

  void track() {
    if (followed() < options_.min_points) return lose(TrackLoss::kTooFewCorners);
    std::vector<Landmark*> landmarks;
    std::vector<cv::Vec3d> points;
    std::vector<ImagePoint> seen;
    for (Landmark& landmark : map_.landmarks) {
      if (!landmark.followed || !landmark.position) continue;
      landmarks.push_back(&landmark);
      points.push_back(*landmark.position);
      seen.push_back(landmark.at);
    }
    const Resection found = resection(points, seen, compose(pose_, motion_),
                                      {.noise = map_options_.noise, .seed = options_.seed});
    if (found.inliers < options_.min_landmarks ||
        static_cast<double>(found.inliers) < options_.min_inlier_share * static_cast<double>(points.size())) {
      return lose(TrackLoss::kTooFewInliers);
    }
    std::vector<cv::Point2f> inliers;
    for (std::size_t i = 0; i < landmarks.size(); ++i) {
      if (found.fits[i])
        inliers.push_back(landmarks[i]->pixel);
      else
        landmarks[i]->followed = false;
    }
    if (cells_of(inliers) < options_.min_cells) return lose(TrackLoss::kPoorSpread);
    const Pose3 motion = compose(inverse(pose_), found.camera);
    if (is_jump(motion)) return lose(TrackLoss::kJump);
    motion_ = motion;
    pose_ = found.camera;
    const std::size_t last = map_.keyframes.size() - 1;
    const cv::Vec3d along = cv::normalize(pose_.rotation * motion.position);
    const double variance = (along.t() * found.position_covariance * along)[0];
    segment_frames_.push_back({.frame = now(),
                               .before = Anchored{last, compose(inverse(map_.keyframes[last].pose), pose_)},
                               .sigma = std::sqrt(std::max(0.0, 2 * variance))});
    const double travel = cv::norm(pose_.position - map_.keyframes[last].pose.position);
    if (travel > options_.keyframe_travel * median_depth_ ||
        static_cast<double>(found.inliers) <
            options_.keyframe_share * static_cast<double>(keyframe_landmarks_)) {
      make_keyframe();
    }
  }

  void make_keyframe() {
    const std::size_t last = map_.keyframes.size() - 1;
    const Pose3 new_from_last = compose(inverse(pose_), map_.keyframes[last].pose);
    for (std::size_t i = segment_frames_.size();
         i-- > 0 && segment_frames_[i].frame > map_.keyframes[last].frame;) {
      SegmentFrame& frame = segment_frames_[i];
      if (frame.before) frame.after = Anchored{last + 1, compose(new_from_last, frame.before->in_keyframe)};
    }
    segment_frames_.back().before = Anchored{last + 1, {}};
    segment_frames_.back().after.reset();
    add_keyframe(map_, {now(), pose_});
    place_landmarks(map_, map_options_);
    adjust_window(map_, map_options_);
    pose_ = map_.keyframes.back().pose;
    after_keyframe();
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
    add_corners();
  }

  [[nodiscard]] std::size_t cells_of(const std::vector<cv::Point2f>& points) const {
    constexpr int kColumns = 6, kRows = 4;
    std::vector<bool> taken(kColumns * kRows);
    for (const cv::Point2f& point : points) {
      const int column =
          std::clamp(static_cast<int>(point.x * kColumns / static_cast<float>(grey_.cols)), 0, kColumns - 1);
      const int row =
          std::clamp(static_cast<int>(point.y * kRows / static_cast<float>(grey_.rows)), 0, kRows - 1);
      taken[static_cast<std::size_t>(row * kColumns + column)] = true;
    }
    return static_cast<std::size_t>(std::ranges::count(taken, true));
  }

  /// No camera moves so between two frames.
  bool is_jump(const Pose3& motion) {
    if (angle_of_rad(motion.rotation) > options_.max_turn_deg * kRadPerDeg) return true;
    const double displacement = cv::norm(motion.position);
    constexpr std::size_t kRemembered = 25;
    constexpr double kSmall = 0.1;  // of the median depth: anything may begin so
    if (speeds_.size() >= kRemembered / 2 && displacement > kSmall * median_depth_ &&
        displacement > options_.max_speedup * median(speeds_)) {
      return true;
    }
    speeds_.push_back(displacement);
    if (speeds_.size() > kRemembered) speeds_.erase(speeds_.begin());
    return false;
  }

  // ---- results ----

  /// Writes down the frames of the segment, now that their keyframes are as good as they get.
  void end_segment() {
    if (state_ == State::kStarting) give_up_waiting();
    if (state_ == State::kTracking) {
      std::optional<Pose3> before;
      for (const SegmentFrame& frame : segment_frames_) {
        std::optional<Pose3> pose;
        TrackedDisplacement& result = track_.frames[frame.frame];
        const bool first = frame.frame == segment_frames_[0].frame;
        if (frame.before) {
          const auto of = [&](const Anchored& a) {
            return compose(map_.keyframes[a.keyframe].pose, a.in_keyframe);
          };
          pose = of(*frame.before);
          if (frame.after) {
            const std::size_t begin = map_.keyframes[frame.before->keyframe].frame;
            const std::size_t end = map_.keyframes[frame.after->keyframe].frame;
            const double t = static_cast<double>(frame.frame - begin) / static_cast<double>(end - begin);
            pose = between(*pose, of(*frame.after), t);
          }
        }
        if (!first) {
          result.segment = segment_;
          result.valid = pose && before;
          result.loss = result.valid ? TrackLoss::kNone : TrackLoss::kTooFewInliers;
          if (result.valid) {
            result.displacement = cv::norm(pose->position - before->position);
            result.sigma = frame.sigma;
            result.turn_rad = turn_between_rad(before->rotation, pose->rotation);
          }
        } else if (!result.valid) {
          result.segment = segment_;
        }
        if (!first || !track_.poses[frame.frame]) track_.poses[frame.frame] = pose;
        before = pose;
      }
      segment_frames_.clear();
    }
    state_ = State::kLost;
  }

  MonocularVoOptions options_;
  LandmarkMapOptions map_options_;
  std::optional<Camera> camera_;  // of the resized frames, known from the first
  cv::Mat grey_;
  KltPyramid before_;
  std::vector<double> time_s_;
  DisplacementTrack track_;
  LandmarkMap map_;
  std::vector<WaitingFrame> waiting_;
  std::vector<SegmentFrame> segment_frames_;
  State state_ = State::kLost;
  TrackLoss loss_ = TrackLoss::kNone;
  Pose3 pose_, motion_;
  std::vector<double> speeds_;
  std::size_t keyframe_landmarks_ = 0;
  double median_depth_ = 1;
  int segment_ = 0;
  bool begun_ = false;
};

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

bool MonocularVoOptions::is_valid(std::string* error) const {
  if (width_px < 1) return *error = fmt::format("width_px is {}; expected at least 1", width_px), false;
  return true;
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
