// What people write by hand or with a spreadsheet: truth.csv, pairs of landmarks, names of places.
#include "fuzz.hpp"

#include <place/evaluation/run_evaluation.hpp>
#include <place/route/named_places.hpp>
#include <vo/io/trajectory_io.hpp>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto file = fuzz::write("table.csv", {data, size});
  const std::vector<place::Match> matches{
      {.query_frame = 0, .place = place::Place{.frame = 0}, .score = 1, .accepted = true},
      {.query_frame = 3, .place = place::Place{.frame = 2}, .score = 2, .probability = 0.5}};
  fuzz::call_one(size, {[&] {
                          const vo::WalkTruth truth = vo::read_truth(file);
                          vo::poses_along_route(truth);
                          vo::steps_in_all(truth);
                        },
                        [&] {
                          const place::GroundTruth truth = place::truth(file, file);
                          place::evaluate(matches, truth, {.tolerance_m = 2});
                          place::evaluate(matches, truth, {.tolerance_frames = 2});
                        },
                        [&] {
                          const place::GroundTruth truth{.pairs = place::read_pairs(file)};
                          place::evaluate(matches, truth, {.tolerance_frames = 2});
                        },
                        [&] {
                          const place::GroundTruth truth{.pairs = place::read_pairs(file),
                                                         .reference_distance_m = {0, 1, 1, 4}};
                          place::evaluate(matches, truth, {.tolerance_m = 2});
                        },
                        [&] { place::read_place_names(file); }});
  return 0;
}
