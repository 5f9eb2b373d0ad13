#include "truth_options.hpp"

#include <fmt/format.h>

#include <vo/base/error.hpp>
#include <vo/io/trajectory_io.hpp>

namespace retrace {

namespace {

struct TruthArguments {
  Argument pairs, query, metres, frames;
};

TruthArguments declare_files_and_tolerance(Arguments& arguments, TruthOptions& options) {
  const Argument pairs = arguments.option(
      "--pairs", options.pairs, "landmarks: query_frame,reference_frame, interpolated between them");
  Argument query = arguments.option("--query-truth", options.query_truth, "truth.csv of the query");
  const Argument reference =
      arguments.option("--reference-truth", options.reference_truth, "truth.csv of the reference");
  query.needs(reference);
  Argument metres = arguments.option("--tolerance-m", options.tolerance.tolerance_m,
                                     "metres along the route within which a match is right [SSS 4.2: 4]");
  Argument frames = arguments.option("--tolerance-frames", options.tolerance.tolerance_frames,
                                     "the same, reference frames");
  return {pairs, query, metres.non_negative(), frames.non_negative()};
}

}  // namespace

void declare_truth(Arguments& arguments, TruthOptions& options) {
  const auto [pairs, query, metres, frames] = declare_files_and_tolerance(arguments, options);
  arguments.exactly_one({pairs, query});
  arguments.exactly_one({metres, frames});
}

void declare_optional_truth(Arguments& arguments, TruthOptions& options) {
  declare_files_and_tolerance(arguments, options);
}

std::string what_truth_lacks(const TruthOptions& options) {
  const place::Tolerance& tolerance = options.tolerance;
  if (options.pairs.empty() == options.query_truth.empty()) return "one of pairs and query-truth";
  if (!options.query_truth.empty() && options.reference_truth.empty())
    return "reference-truth beside query-truth";
  if (tolerance.tolerance_m.has_value() == tolerance.tolerance_frames.has_value())
    return "one of tolerance-m and tolerance-frames";
  return {};
}

Truth read_truth(const TruthOptions& options) {
  Truth truth;
  place::GroundTruth& places = truth.places;
  if (!options.reference_truth.empty())
    places.reference_distance_m = place::distances_on(options.reference_truth);
  if (options.pairs.empty()) {
    vo::WalkTruth query = vo::read_truth(options.query_truth);
    truth.poses = vo::poses_of(query);
    places.query_distance_m = std::move(query.distance_m);
    return truth;
  }
  places.pairs = place::read_pairs(options.pairs);
  if (options.tolerance.tolerance_m && places.reference_distance_m.empty()) {
    throw vo::Error("--tolerance-m", "needs distances, which --pairs has not",
                    "--tolerance-frames, or --reference-truth beside --pairs");
  }
  return truth;
}

const std::string& truth_file(const TruthOptions& options) {
  return options.pairs.empty() ? options.query_truth : options.pairs;
}

std::string tolerance_text(const place::Tolerance& tolerance) {
  return tolerance.tolerance_m ? fmt::format("{:g} metres", *tolerance.tolerance_m)
                               : fmt::format("{:g} reference frames", *tolerance.tolerance_frames);
}

}  // namespace retrace
