#include "recorder.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <fstream>
#include <string>
#include <system_error>

#include <fmt/format.h>
#include <opencv2/videoio.hpp>

#include <vo/base/error.hpp>
#include <vo/base/parallel.hpp>
#include <vo/io/atomic_file.hpp>
#include <vo/io/partial_path.hpp>

namespace simulate {
namespace {

namespace fs = std::filesystem;

constexpr int kBatch = 16;  // frames drawn at a time, while the batch before is encoded

vo::Error cannot_be_written(const fs::path& file) {
  return {file.string(), "cannot be written", "a folder with room for it"};
}

/// False if it could not be written.
bool write_truth(const WalkSimulator& walk, int frames, const fs::path& file) {
  std::ofstream out(file);
  out << "frame,time_s,x_m,y_m,heading_deg,distance_m,steps\n";
  for (int i = 0; i < frames; ++i) {
    const TruthRow row = walk.truth(i);
    out << fmt::format("{},{:.9g},{:.4f},{:.4f},{:.4f},{:.4f},{}\n", row.frame, row.time_s, row.x_m, row.y_m,
                       row.heading_deg, row.distance_m, row.steps);
  }
  out.close();
  return !out.fail();
}

}  // namespace

Recording simulate_walk(const Options& options, const fs::path& directory, bool overwrite,
                        const vo::ProgressCallback& progress) {
  validate(options);
  std::error_code failure;
  std::vector<fs::path> missing;  // the innermost first
  for (fs::path at = directory.has_filename() ? directory : directory.parent_path();
       !at.empty() && !fs::exists(at, failure); at = at.parent_path())
    missing.push_back(at);
  std::deque<vo::PartialPath> made;  // unless files come into them; the innermost goes first
  for (const fs::path& path : missing) made.emplace_back(path, vo::Removal::kIfEmpty);
  fs::create_directories(directory, failure);
  if (failure)
    throw vo::Error(directory.string(), "cannot be made: " + failure.message(), "a folder one may write to");
  constexpr const char* kVideo = "walk.mp4";
  constexpr const char* kTruth = "truth.csv";
  for (const char* name : {kVideo, kTruth}) {
    if (fs::exists(directory / name) && !overwrite)
      throw vo::Error((directory / name).string(), "exists already", "a new folder, or --force to overwrite");
  }
  // Both are written to a hidden folder, from which they appear together, or not at all.
  vo::remove_abandoned(directory / "walk");
  vo::PartialPath staged(vo::partial_name(directory / "walk"));
  if (!fs::create_directory(staged.path(), failure)) throw cannot_be_written(directory);

  const WalkSimulator walk(options);
  cv::VideoWriter writer((staged.path() / kVideo).string(), cv::CAP_FFMPEG,
                         cv::VideoWriter::fourcc('m', 'p', '4', 'v'), options.frame_rate_hz, options.size);
  if (!writer.isOpened()) throw cannot_be_written(directory / kVideo);

  const int total = walk.frame_count();
  Recording recording;
  std::vector<cv::Mat> drawn, encoded;
  const auto encode = [&] {
    for (const cv::Mat& frame : encoded) writer.write(frame);
    recording.frames += static_cast<int>(encoded.size());
  };
  bool going_on = true;
  for (int begin = 0; begin < total && going_on; begin += kBatch) {
    drawn.assign(static_cast<std::size_t>(std::min(kBatch, total - begin)), {});
    vo::parallel_for(drawn.size() + 1, [&](std::size_t i) {
      if (i == 0) {
        encode();
      } else {
        drawn[i - 1] = walk.render(begin + static_cast<int>(i) - 1);
      }
    });
    encoded.swap(drawn);
    if (progress) going_on = progress({"drawing the walk", begin, total});
  }
  encode();
  writer.release();
  // OpenCV does not report a failed write; the file shows it.
  if (cv::VideoCapture written((staged.path() / kVideo).string(), cv::CAP_FFMPEG);
      !written.isOpened() || std::lround(written.get(cv::CAP_PROP_FRAME_COUNT)) != recording.frames)
    throw cannot_be_written(directory / kVideo);
  if (progress && going_on) progress({"drawing the walk", total, total});

  if (!write_truth(walk, recording.frames, staged.path() / kTruth))
    throw cannot_be_written(directory / kTruth);
  staged.release_into(directory);
  recording.last = walk.truth(recording.frames - 1);
  return recording;
}

}  // namespace simulate
