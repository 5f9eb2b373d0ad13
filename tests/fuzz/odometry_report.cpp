// What a report of odometry is drawn from: trajectory.tum, summary.json, frames.csv, steps.csv, activity.csv
// and report_data.json of a walk, between lines of %%.
#include "report/odometry_report.hpp"

#include "fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto parts = fuzz::parts({data, size}, 6);
  std::size_t i = 0;
  for (const char* name :
       {"trajectory.tum", "summary.json", "frames.csv", "steps.csv", "activity.csv", "report_data.json"}) {
    if (parts[i].empty()) {
      std::filesystem::remove(fuzz::folder() / name);
    } else {
      fuzz::write(name, parts[i]);
    }
    ++i;
  }
  constexpr std::size_t kPage = 1U << 20U;  // the page, its texts and axes
  const retrace::OdometryTruth truth{.map_path = {{0, 0}, {0, 10}}};
  fuzz::call_one(size,
                 {[] { retrace::odometry_report(fuzz::folder()); },
                  [&] { retrace::odometry_report(fuzz::folder(), &truth); }},
                 kPage);
  return 0;
}
