#include "measured_odometry.hpp"

#include "json_file.hpp"
#include "report/odometry_report.hpp"
#include "run_directory.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <vo/base/error.hpp>
#include <vo/io/atomic_file.hpp>
#include <vo/io/csv.hpp>
#include <vo/io/trajectory_io.hpp>

namespace retrace {

OdometryMeasured measure_odometry(const std::filesystem::path& folder, const WalkTruthOptions& known,
                                  const place::OdometryEvaluationOptions& evaluation) {
  check_metres(folder);
  const WalkTruth truth = read_walk_truth(known.path, known.map_scale_m_per_px, known.steps);
  OdometryMeasured measured{.steps = vo::CsvTable::read(folder / "steps.csv").rows()};
  if (truth.steps) measured.counted = {{measured.steps, *truth.steps}};
  const vo::Trajectory trajectory = vo::read_tum(folder / "trajectory.tum");
  const auto pairs = truth.map_path.empty()
                         ? place::pair_by_time(truth.walk.poses, truth.walk.distance_m, trajectory)
                         : place::pair_by_share(truth.map_path, trajectory);
  measured.evaluation = place::evaluate_odometry(pairs, evaluation);
  if (measured.evaluation.segment_m == 0) {
    throw vo::Error(known.path,
                    fmt::format("and the trajectory share {:.1f} m", measured.evaluation.distance_m),
                    fmt::format("{} m or more", evaluation.at_m.front()));
  }
  StagedFiles staged(folder);
  vo::write_file(staged.path() / "odometry_metrics.json",
                 json_text(odometry_metrics_json(measured, evaluation), 2) + "\n");
  const OdometryTruth for_report{.poses = truth.walk.poses,
                                 .map_path = truth.map_path,
                                 .map_image = known.map_image,
                                 .map_scale_m_per_px = known.map_scale_m_per_px.value_or(0),
                                 .steps = truth.steps ? std::to_string(*truth.steps) : "",
                                 .evaluation = measured.evaluation};
  vo::write_file(staged.path() / "report.html", odometry_report(folder, &for_report));
  staged.commit();
  return measured;
}

}  // namespace retrace
