/// What a shortlist loses and gains: `candidate_table` prints, for references of 10^4 to 10^6 keyframes, the
/// recall of the true places among the candidates, how often the search finds them with all references and
/// with candidates, and the processor time of both. Needs the recordings (RETRACE_DATA).
///
/// The reference is the summer journey of Nordland, and after it made-up journeys until there are enough: the
/// summer's views mirrored, each blended by a third to two thirds with the view of another place some fixed
/// way off, in another contrast and with noise, in an order that goes on as a journey does. The query is
/// every view of a stretch of the winter journey.

#include "support/shared_data.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <vector>

#include <place/match/candidates.hpp>
#include <place/match/streamed_search.hpp>
#include <vo/base/parallel.hpp>
#include <vo/base/rng.hpp>
#include <vo/image/patch_normalisation.hpp>
#include <vo/odometry.hpp>

namespace {

constexpr std::size_t kFirstQuery = 600, kQueries = 400;

double processor_s() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

vo::ImageStack lengthened(const vo::ImageStack& real, std::size_t count) {
  vo::ImageStack all = vo::make_image_stack(real.width, real.height, count);
  std::ranges::copy(real.pixels, all.pixels.begin());
  const std::size_t journeys = count / real.size() + 1, width = static_cast<std::size_t>(real.width);
  vo::parallel_for(journeys, [&](std::size_t journey) {
    if (journey == 0) return;
    vo::Rng rng(journey);
    const std::size_t way_off = 1 + rng.index(real.size() - 1);
    const double share = rng.uniform(1.0 / 3, 2.0 / 3), contrast = rng.uniform(0.6, 1.4);
    for (std::size_t i = 0; i < real.size() && journey * real.size() + i < count; ++i) {
      const auto here = real[i], there = real[(i + way_off) % real.size()];
      const auto out = all[journey * real.size() + i];
      for (std::size_t k = 0; k < out.size(); ++k) {
        const std::size_t mirrored = k - k % width + (width - 1 - k % width);
        const double value = share * here[mirrored] + (1 - share) * there[mirrored];
        out[k] = static_cast<std::uint8_t>(
            std::clamp(128 + contrast * (value - 128) + static_cast<double>(rng.index(21)) - 10, 0.0, 255.0));
      }
    }
  });
  return all;
}

/// Share of the queries found within two keyframes of their place.
double share_found(const std::vector<place::SequenceMatch>& matches,
                   const std::vector<std::size_t>& columns) {
  std::size_t right = 0;
  for (std::size_t q = 0; q < matches.size(); ++q) {
    if (!matches[q].reference) continue;
    const auto r = columns.empty() ? *matches[q].reference : columns[*matches[q].reference];
    right += std::llabs(static_cast<long long>(r) - static_cast<long long>(kFirstQuery + q)) <= 2 ? 1 : 0;
  }
  return static_cast<double>(right) / static_cast<double>(matches.size());
}

}  // namespace

int main() {
  const auto data = test_support::data_folder();
  if (!data) {
    std::puts("no data folder: set RETRACE_DATA");
    return 0;
  }
  const auto thumbnails = [&](const char* name) {
    return vo::read_walk((*data / "nordland_64x32" / name).string(), {.preview_width_px = 0}).thumbnails;
  };
  const vo::ImageStack summer = thumbnails("summer"), winter = thumbnails("winter");
  std::vector<std::size_t> stretch(kQueries);
  for (std::size_t q = 0; q < kQueries; ++q) stretch[q] = kFirstQuery + q;
  const vo::ImageStack query = vo::patch_normalise(vo::select(winter, stretch), {});

  std::puts(
      "| references | candidates | recall among them | found, all | found, candidates | s, all | s, "
      "candidates |");
  std::puts("|---|---|---|---|---|---|---|");
  for (const std::size_t count : {10'000, 100'000, 1'000'000}) {
    vo::ImageStack reference = lengthened(summer, count);
    reference = vo::patch_normalise(reference, {});
    double began = processor_s();
    const double all = share_found(place::search_streamed(query, reference, {}), {});
    const double all_s = processor_s() - began;
    began = processor_s();
    const auto columns = place::candidates(query, reference);
    const double some =
        share_found(place::search_streamed(query, vo::select(reference, columns), {}), columns);
    const double some_s = processor_s() - began;
    std::size_t among = 0;
    for (const std::size_t place : stretch) among += std::ranges::binary_search(columns, place) ? 1 : 0;
    std::printf("| %zu | %zu | %.3f | %.3f | %.3f | %.2f | %.2f |\n", count, columns.size(),
                static_cast<double>(among) / kQueries, all, some, all_s, some_s);
    std::fflush(stdout);
  }
}
