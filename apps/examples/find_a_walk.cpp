// Finds one walk on another: find_a_walk DAY.mp4 DAY.csv NIGHT.mp4 NIGHT.csv, with the truth of both.
#include <cstdio>

#include <place/place.hpp>
#include <place/route/survey.hpp>
#include <vo/io/atomic_file.hpp>
#include <vo/io/trajectory_io.hpp>

int main(int, char** argv) {
  place::Settings settings;
  settings.motion = "steps";  // keyframes so many metres apart, by the steps seen in the videos
  place::Route route = place::new_route(settings);
  const vo::Walk day = place::read(argv[1], settings);
  place::add(route, "day", day, place::survey_from_truth(argv[2], day));
  place::write_route("route.db", route);

  const place::Run run = place::localise(route, place::read(argv[3], route));
  const place::RunEvaluation found = place::evaluate(run, place::truth(argv[4], argv[2]), {.tolerance_m = 4});
  std::printf("%zu keyframes, max-F1 %.3f\n", run.matches.size(), found.evaluation.best.f1);
  if (run.trajectory) vo::write_file("night.tum", vo::to_tum(*run.trajectory));
}
