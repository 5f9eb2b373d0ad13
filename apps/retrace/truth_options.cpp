#include "truth_options.hpp"

#include <vo/base/error.hpp>
#include <vo/io/trajectory_io.hpp>

namespace retrace {

void add_truth_options(CLI::App& app, TruthOptions& options) {
  auto* truth = app.add_option_group("truth", "where the query truly was");
  truth->add_option("--pairs", options.pairs,
                    "landmarks: query_frame,reference_frame, interpolated between them");
  CLI::Option* query = truth->add_option("--query-truth", options.query_truth, "truth.csv of the query");
  truth->require_option(1);
  CLI::Option* reference =
      app.add_option("--reference-truth", options.reference_truth, "truth.csv of the reference");
  query->needs(reference);
  auto* tolerance = app.add_option_group("tolerance", "how far off is still right");
  tolerance->add_option("--tolerance-m", options.tolerance_m, "metres along the route [SSS 4.2: 4]")
      ->check(CLI::NonNegativeNumber);
  tolerance->add_option("--tolerance-frames", options.tolerance_frames, "reference frames")
      ->check(CLI::NonNegativeNumber);
  tolerance->require_option(1);
}

RunTruth read_truth(const TruthOptions& options) {
  RunTruth run;
  run.unit = options.tolerance_m ? place::ErrorUnit::kMetres : place::ErrorUnit::kFrames;
  run.tolerance = options.tolerance_m ? *options.tolerance_m : *options.tolerance_frames;
  place::GroundTruth& truth = run.truth;
  if (!options.reference_truth.empty())
    truth.reference_distance_m = vo::read_truth(options.reference_truth).distance_m;
  if (!options.pairs.empty()) {
    truth.pairs = place::read_pairs(options.pairs);
    if (options.tolerance_m && truth.reference_distance_m.empty()) {
      throw vo::Error("--tolerance-m", "needs distances, which --pairs has not",
                      "--tolerance-frames, or --reference-truth beside --pairs");
    }
  } else {
    vo::WalkTruth query = vo::read_truth(options.query_truth);
    truth.query_distance_m = std::move(query.distance_m);
    run.poses = std::move(query.poses);
  }
  return run;
}

const std::string& truth_file(const TruthOptions& options) {
  return options.pairs.empty() ? options.query_truth : options.pairs;
}

place::ScoredQuery judge(RunTruth& run, std::int64_t query_frame, std::optional<std::int64_t> reference_frame,
                         double score) {
  const place::PlaceError& error = run.errors.emplace_back(
      place::place_error(run.truth, query_frame, reference_frame, run.unit, run.tolerance));
  return {.score = reference_frame ? std::optional(score) : std::nullopt,
          .has_truth = error.has_truth,
          .error = error.error};
}

}  // namespace retrace
