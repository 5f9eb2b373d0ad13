// Trajectories: TUM's, KITTI's and EuRoC's files, with KITTI's times after a line of %%.
#include "fuzz.hpp"

#include <array>
#include <cstdlib>

#include <vo/io/pose_series_io.hpp>
#include <vo/io/trajectory_io.hpp>
#include <vo/motion/external_trajectory.hpp>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto parts = fuzz::parts({data, size}, 2);
  const auto poses = fuzz::write("poses", parts[0]);
  const std::array<double, 4> walk_s{0, 0.1, 0.2, 5};
  const auto as_survey = [&] {
    const vo::PoseSeries series = vo::read_pose_series(poses);
    const bool timed = series.frames == 0;
    if (series.poses.size() != (timed ? series.time_s.size() : series.frame.size())) std::abort();
    vo::external_trajectory(series, walk_s);
    if (timed) vo::planar(series);
  };
  const auto as_trajectory = [&] { vo::to_tum(vo::read_tum(poses)); };
  if (parts[1].empty()) {
    fuzz::call_one(size, {as_survey, as_trajectory});
  } else {
    const auto times = fuzz::write("times", parts[1]);
    fuzz::call(size, [&] { vo::read_pose_series(poses, {.kitti_times = times}); });
  }
  return 0;
}
