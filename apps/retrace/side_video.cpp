#include "side_video.hpp"

#include "side_view.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include <vo/base/degrees.hpp>
#include <vo/base/median.hpp>
#include <vo/geometry/turned_view.hpp>
#include <vo/io/video_writer.hpp>

namespace retrace {
namespace {

constexpr double kBlink_s = 0.5;

/// 83.5 s: "1:23.5".
std::string clock(double time_s) {
  const auto tenths = static_cast<std::int64_t>(std::floor(time_s * 10 + 1e-6));
  return fmt::format("{}:{:02}.{}", tenths / 600, tenths / 10 % 60, tenths % 10);
}

double rate_hz(const std::vector<place::Match>& matches) {
  std::vector<double> frame_s;
  for (std::size_t i = 1; i < matches.size(); ++i) {
    frame_s.push_back((matches[i].query_time_s - matches[i - 1].query_time_s) /
                      static_cast<double>(matches[i].query_frame - matches[i - 1].query_frame));
  }
  const double usual_s = frame_s.empty() ? 0 : vo::median(std::move(frame_s));
  return usual_s > 0 ? 1 / usual_s : vo::kImageRate_hz;
}

/// How far along its traverse a place is, 0 to 1.
double share_of(const place::Traverse& traverse, double keyframe) {
  return traverse.keyframes.size() < 2 ? 0 : keyframe / static_cast<double>(traverse.keyframes.size() - 1);
}

std::string status_of(const place::Match& match, const place::ReferenceMoment* here) {
  const std::string sure = match.probability ? fmt::format("probability {:.2f}", *match.probability)
                                             : fmt::format("score {:.2f}", match.score);
  if (here == nullptr) return match.place ? fmt::format("off route   best match: {}", sure) : "off route";
  return here->distance_m ? fmt::format("{:.1f} m   {}", *here->distance_m, sure)
                          : fmt::format("keyframe {:.1f}   {}", here->keyframe, sure);
}

std::string end_of(const place::Route& route, const place::Traverse& traverse) {
  const place::Keyframe& last = traverse.keyframes.back();
  if (last.distance_m) return fmt::format("{:.1f} m", *last.distance_m);
  return route.metric ? fmt::format("{:.1f} m", last.displacement)
                      : fmt::format("{} keyframes", traverse.keyframes.size());
}

/// The reference's side of the view.
void add_reference(SideVideo& video, const place::ReferenceMoment& here, SideView& view) {
  const place::Traverse& traverse = video.route.traverses[here.traverse];
  ShownTraverse& shown = video.traverses[here.traverse];
  const std::int64_t frame = std::llround(here.frame);
  const WalkPicture picture = shown.pictures->at(frame);
  view.reference = picture.image;
  view.reference_caption = fmt::format("reference '{}'   {}   frame {}{}", traverse.name,
                                       clock(picture.time_s), frame, shown.previews ? "   (preview)" : "");
  const bool turned =
      video.query_camera && shown.camera && here.yaw_rad && std::abs(*here.yaw_rad) < std::numbers::pi / 2;
  if (!turned) return;
  const cv::Matx33d homography =
      vo::turned_view(vo::resized(*shown.camera, picture.image.cols),
                      vo::resized(*video.query_camera, view.query.cols), *here.yaw_rad);
  cv::Mat warped;  // the picture itself may be shown again
  cv::warpPerspective(picture.image, warped, homography, view.query.size(), cv::INTER_LINEAR);
  view.reference = warped;
  view.reference_caption += fmt::format("   turned {:+.1f} deg", *here.yaw_rad * vo::kDegPerRad);
}

SideView view_of(SideVideo& video, std::size_t frame) {
  const place::QueryMoment& moment = video.timeline[frame];
  const place::ReferenceMoment* here = moment.reference ? &*moment.reference : nullptr;
  const place::Traverse& traverse = video.route.traverses[here != nullptr ? here->traverse : 0];
  const WalkPicture query = video.query->at(static_cast<std::int64_t>(frame));
  SideView view{.query = query.image,
                .reference = {},
                .query_caption = fmt::format("query   {}   frame {}", clock(query.time_s), frame),
                .reference_caption = {},
                .along = {},
                .status = status_of(video.matches[moment.match], here),
                .route_end = end_of(video.route, traverse)};
  if (here == nullptr) return view;
  view.along = share_of(traverse, here->keyframe);
  add_reference(video, *here, view);
  if (video.blink && static_cast<std::int64_t>(query.time_s / kBlink_s) % 2 == 1) {
    view.reference = view.query;
    view.reference_caption = "query";
  }
  return view;
}

cv::Size largest_picture(const place::Route& route) {
  cv::Size largest;
  for (const place::Traverse& traverse : route.traverses) {
    const cv::Size size(traverse.frame_width_px, traverse.frame_height_px);
    if (largest.empty() || size.height * largest.width > largest.height * size.width) largest = size;
  }
  return largest;
}

}  // namespace

double write_side_video(const std::filesystem::path& path, SideVideo& video,
                        const vo::ProgressCallback& progress) {
  const double rate = rate_hz(video.matches);
  const SideViewLayout layout =
      side_view_layout(video.query->at(0).image.size(), largest_picture(video.route), video.width_px);
  vo::VideoWriter writer(path, layout.size(), rate);
  const auto frames = static_cast<std::int64_t>(video.timeline.size());
  for (std::int64_t frame = 0; frame < frames; ++frame) {
    writer.write(draw_side_view(view_of(video, static_cast<std::size_t>(frame)), layout));
    if (progress) progress({"drawing the video", frame + 1, frames});
  }
  writer.finish();
  return rate;
}

}  // namespace retrace
