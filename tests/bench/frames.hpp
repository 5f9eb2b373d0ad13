#pragma once

#include "support/shared_data.hpp"

#include <string>
#include <vector>

#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include <simulate/simulator.hpp>

namespace bench {

struct NamedFrame {
  std::string name;
  cv::Mat grey;  ///< 640 x 360
};

inline cv::Mat grey_640x360(const cv::Mat& bgr) {
  cv::Mat grey, resized;
  cv::cvtColor(bgr, grey, cv::COLOR_BGR2GRAY);
  cv::resize(grey, resized, {640, 360}, 0, 0, cv::INTER_AREA);
  return resized;
}

/// Two consecutive frames of a simulated street.
inline std::vector<cv::Mat> street_frames() {
  const simulate::WalkSimulator walk(simulate::Options{.length_m = 30});
  const int middle = walk.frame_count() / 2;
  return {grey_640x360(walk.render(middle)), grey_640x360(walk.render(middle + 1))};
}

/// Frames of two simulated walks and, where the recordings are, one from the middle of each of three videos.
inline std::vector<NamedFrame> assorted_frames() {
  std::vector<NamedFrame> frames;
  for (const auto scene : {simulate::Scene::kStreet, simulate::Scene::kCorridor}) {
    const simulate::WalkSimulator walk(simulate::Options{.scene = scene, .length_m = 30});
    frames.push_back({scene == simulate::Scene::kStreet ? "street" : "corridor",
                      grey_640x360(walk.render(walk.frame_count() / 2))});
  }
  const auto folder = test_support::data_folder();
  if (!folder) return frames;
  for (const char* const name :
       {"gopro_footpath/reference.mp4", "kitti_03/drive.mp4", "sim/corridor_a.mp4"}) {
    cv::VideoCapture video((*folder / name).string());
    cv::Mat bgr;
    video.set(cv::CAP_PROP_POS_FRAMES, video.get(cv::CAP_PROP_FRAME_COUNT) / 2);
    if (video.read(bgr)) frames.push_back({name, grey_640x360(bgr)});
  }
  return frames;
}

}  // namespace bench
