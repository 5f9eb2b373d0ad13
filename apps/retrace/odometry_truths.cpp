#include "odometry_truths.hpp"

#include "odometry_arguments.hpp"

#include <fmt/format.h>

#include <vo/base/error.hpp>

namespace retrace {

Argument declare_odometry_truths(Arguments& arguments, OdometryTruths& truths) {
  const Argument truth = arguments.option(
      "--truth", truths.paths,
      "of each walk: truth.csv, or the path as a line on a map: x_px,y_px, y downwards, north up");
  const Argument kitti = arguments.option(
      "--kitti-poses", truths.kitti_poses,
      "true poses in KITTI's form: its errors of visual odometry alone, which `retrace odometry "
      "--visual-odometry` wrote");
  arguments.exactly_one({truth, kitti});
  Argument scale =
      arguments.option("--map-scale-m-per-px", truths.map_scale_m_per_px, "metres of one pixel of that map");
  scale.positive().excludes(kitti);
  arguments.option("--map-image", truths.map_image, "that map, PNG or JPEG, to draw the trajectory over")
      .existing_file()
      .needs(scale);
  arguments.option("--true-steps", truths.true_steps, "steps counted on each walk, where the truth has none")
      .excludes(kitti);
  return kitti;
}

std::vector<WalkTruthOptions> truth_of_each(const OdometryTruths& truths, std::size_t walks) {
  const std::vector<std::size_t>& steps = truths.true_steps;
  const bool kitti = !truths.kitti_poses.empty();
  if (kitti && walks > 1)
    throw vo::Error("--kitti-poses", fmt::format("is of one walk and {} are given", walks), "one folder");
  if (!kitti) check_one_for_each("--truth", truths.paths.size(), walks);
  if (!steps.empty() && steps.size() != walks)
    throw vo::Error("--true-steps", fmt::format("has {} numbers for {} walks", steps.size(), walks),
                    "one for each, in their order");
  std::vector<WalkTruthOptions> each;
  for (const std::string& path : truths.paths) {
    each.push_back({.path = path,
                    .map_scale_m_per_px = truths.map_scale_m_per_px,
                    .map_image = truths.map_image,
                    .steps = {}});
    if (!steps.empty()) each.back().steps = steps[each.size() - 1];
  }
  return each;
}

}  // namespace retrace
