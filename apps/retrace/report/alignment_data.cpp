#include "alignment_data.hpp"

#include "report/chart.hpp"
#include "report/page.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <vo/motion/difference_pictures.hpp>

namespace retrace {
namespace {

using nlohmann::ordered_json;

constexpr std::size_t kColumns = 1200;  // of a picture or a line: more than a screen shows

std::string as_png_url(const cv::Mat& picture) {
  std::vector<std::uint8_t> png;
  cv::imencode(".png", picture, png);
  return data_url(png);
}

/// Frames first .. second - 1 of each column.
std::vector<std::pair<std::size_t, std::size_t>> columns_of(std::size_t frames) {
  const std::size_t count = std::min(frames, kColumns);
  std::vector<std::pair<std::size_t, std::size_t>> columns;
  for (std::size_t c = 0; c < count; ++c) columns.emplace_back(c * frames / count, (c + 1) * frames / count);
  return columns;
}

/// Mean error over frames to the right and spans upwards, bright where it is high (SSS Fig. 1b, 10); pairs
/// that could not be compared are darkest.
std::string heat_url(const vo::AlignmentErrors& errors) {
  const auto columns = columns_of(errors.frames());
  const auto rows = static_cast<int>(errors.spans());
  cv::Mat heat(rows, static_cast<int>(columns.size()), CV_32FC1, cv::Scalar(0));
  for (std::size_t c = 0; c < columns.size(); ++c) {
    for (int k = 0; k < rows; ++k) {
      float sum = 0, count = 0;
      for (std::size_t i = columns[c].first; i < columns[c].second; ++i) {
        const vo::Comparison& compared = errors.by_span[static_cast<std::size_t>(k)][i];
        if (!compared.made()) continue;
        sum += compared.error;
        ++count;
      }
      if (count > 0) heat.at<float>(rows - 1 - k, static_cast<int>(c)) = sum / count;
    }
  }
  double most = 0;
  cv::minMaxLoc(heat, nullptr, &most);
  cv::Mat grey, coloured;
  heat.convertTo(grey, CV_8UC1, most > 0 ? 255 / most : 0);
  cv::applyColorMap(grey, coloured, cv::COLORMAP_VIRIDIS);
  return as_png_url(coloured);
}

/// SSS Fig. 1a, on one scale of brightness.
ordered_json pictures_json(const std::vector<vo::DifferencePicture>& pictures) {
  double most = 0;
  for (const vo::DifferencePicture& picture : pictures) most = std::max(most, std::ranges::max(picture.mean));
  ordered_json json = ordered_json::array();
  for (const vo::DifferencePicture& picture : pictures) {
    if (picture.pairs == 0) continue;
    constexpr int kEnlarge = 5;
    cv::Mat mean(picture.height, picture.width, CV_64FC1), grey;
    std::ranges::copy(picture.mean, mean.begin<double>());
    mean.convertTo(grey, CV_8UC1, most > 0 ? 255 / most : 0);
    cv::resize(grey, grey, {}, kEnlarge, kEnlarge, cv::INTER_NEAREST);
    cv::applyColorMap(grey, grey, cv::COLORMAP_VIRIDIS);
    json.push_back({{"seconds", rounded(picture.seconds)},
                    {"mean", rounded(cv::mean(mean)[0])},
                    {"most", rounded(most)},
                    {"picture", as_png_url(grey)}});
  }
  return json;
}

ordered_json spans_json(const std::vector<bool>& flags, const std::vector<double>& time_s) {
  ordered_json spans = ordered_json::array();
  for (std::size_t i = 0; i < flags.size(); ++i) {
    if (!flags[i]) continue;
    std::size_t end = i;
    while (end + 1 < flags.size() && flags[end + 1]) ++end;
    spans.push_back({rounded(time_s[i]), rounded(time_s[std::min(end + 1, flags.size() - 1)])});
    i = end;
  }
  return spans;
}

ordered_json means_json(const vo::MeanErrors& means) {
  return {{"seconds", rounded(means.seconds)}, {"error", rounded(means.error)}};
}

/// The learned relation, read at even errors (SSS Fig. 3, green).
ordered_json relation_json(const vo::MotionModel& model) {
  if (!model.learned()) return ordered_json::object();
  constexpr int kPoints = 100;
  std::vector<float> errors;
  for (int i = 0; i <= kPoints; ++i) errors.push_back(static_cast<float>(model.error.back() * i / kPoints));
  return {{"error", rounded({errors.begin(), errors.end()})},
          {"separation", rounded(vo::separation_of(model, errors))},
          {"knot_error", rounded(model.error)},
          {"knot_separation", rounded(model.separation)}};
}

/// The error of each column's middle frame; none where the walker stands.
ordered_json course_json(const vo::ErrorCourse& course, const std::vector<bool>& standing,
                         const std::vector<double>& time_s) {
  std::vector<double> at_s, relative, smoothed;
  for (const auto& [begin, end] : columns_of(time_s.size())) {
    const std::size_t i = (begin + end) / 2;
    at_s.push_back(time_s[i]);
    relative.push_back(course.relative[i]);
    smoothed.push_back(standing[i] ? NAN : course.smoothed[i]);
  }
  return {{"time_s", rounded(at_s)},
          {"relative", rounded(relative)},
          {"smoothed", rounded(smoothed)},
          {"limit", rounded(course.limit)}};
}

}  // namespace

ordered_json alignment_data(const vo::Walk& walk, const std::optional<vo::VisualMotion>& known,
                            const vo::VisualMotionOptions& options) {
  const std::optional<vo::VisualMotion> motion = known ? known : vo::visual_motion_if_any(walk, options);
  if (!motion) return ordered_json::object();
  const vo::AlignmentErrors& errors = motion->errors;
  const std::vector<bool> high =
      vo::high_error_windows(errors, walk.time_s, motion->standing, options.alignment);
  std::vector<bool> left_out = high;
  for (std::size_t i = 0; i < left_out.size(); ++i) left_out[i] = left_out[i] || motion->standing[i];
  std::vector<double> seconds;
  for (const auto& comparisons : errors.by_span) {
    double sum = 0, count = 0;
    for (const vo::Comparison& compared : comparisons) {
      if (!compared.made()) continue;
      sum += static_cast<double>(compared.seconds);
      ++count;
    }
    seconds.push_back(count > 0 ? sum / count : NAN);
  }
  return {{"end_s", rounded(walk.time_s.back())},
          {"seconds", rounded(seconds)},
          {"of_all", means_json(vo::mean_errors(errors))},
          {"of_the_rest", means_json(vo::mean_errors(errors, left_out))},
          {"relation", relation_json(motion->model)},
          {"course", course_json(vo::error_course(errors, walk.time_s, motion->standing, options.alignment),
                                 motion->standing, walk.time_s)},
          {"high", spans_json(high, walk.time_s)},
          {"standing", spans_json(motion->standing, walk.time_s)},
          {"heat", heat_url(errors)},
          {"pictures",
           pictures_json(vo::difference_pictures(walk.thumbnails, errors, vo::kPicturedSpans, left_out))}};
}

}  // namespace retrace
