#include "support/shared_data.hpp"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <place/evaluation/evaluation.hpp>
#include <place/match/contrast_enhancement.hpp>
#include <place/match/cost_matrix.hpp>
#include <place/match/sequence_search.hpp>
#include <vo/base/parallel.hpp>
#include <vo/image/patch_normalisation.hpp>
#include <vo/odometry.hpp>

namespace {

vo::ImageStack thumbnails_of(const std::filesystem::path& folder) {
  return vo::read_walk(folder.string(), {.preview_width_px = 0}).thumbnails;
}

/// The cost matrix without rounding to bytes.
place::CostMatrix unrounded_costs(const vo::ImageStack& query, const vo::ImageStack& reference) {
  const auto normalised = [](const vo::ImageStack& images) {
    std::vector<std::vector<float>> all(images.size(), std::vector<float>(images.image_size()));
    vo::parallel_for(images.size(), [&](std::size_t i) {
      vo::patch_normalise(images[i], images.width, images.height, {}, all[i]);
    });
    return all;
  };
  const auto q = normalised(query), r = normalised(reference);
  place::CostMatrix costs = place::make_cost_matrix(q.size(), r.size());
  vo::parallel_for(q.size(), [&](std::size_t i) {
    for (std::size_t j = 0; j < r.size(); ++j) {
      float sum = 0;
      for (std::size_t k = 0; k < q[i].size(); ++k) sum += std::abs(q[i][k] - r[j][k]);
      costs.row(i)[j] = sum / static_cast<float>(q[i].size());
    }
  });
  return costs;
}

/// Max-F1 where the true reference has the query's index, within 2.
double max_f1(place::CostMatrix costs, place::Enhancement enhancement, int length) {
  place::enhance_contrast(costs, {.method = enhancement});
  std::vector<place::ScoredQuery> queries;
  for (const place::SequenceMatch& match : place::search_sequences(costs, {.length = length})) {
    place::ScoredQuery query{.has_truth = true};
    if (match.reference) {
      query.score = match.score;
      query.error = std::abs(static_cast<double>(*match.reference) - static_cast<double>(queries.size()));
    }
    queries.push_back(query);
  }
  return place::evaluate(queries, 2).best.f1;
}

TEST(Quantisation, ChangesNoResultToSpeakOf) {
  const auto data = test_support::data_folder();
  if (!data) GTEST_SKIP() << "no data folder: set RETRACE_DATA";
  for (const auto& [reference_folder, query_folder] :
       {std::pair{"nordland_64x32/summer", "nordland_64x32/winter"},
        std::pair{"corridor/reference", "corridor/query"}}) {
    const vo::ImageStack reference = thumbnails_of(*data / reference_folder);
    const vo::ImageStack query = thumbnails_of(*data / query_folder);
    const place::CostMatrix bytes =
        place::cost_matrix(vo::patch_normalise(query, {}), vo::patch_normalise(reference, {}));
    const place::CostMatrix floats = unrounded_costs(query, reference);
    for (const auto enhancement : {place::Enhancement::kLocal, place::Enhancement::kStandardise}) {
      for (const int length : {10, 20}) {
        const double exact = max_f1(floats, enhancement, length),
                     rounded = max_f1(bytes, enhancement, length);
        std::printf("%s length %d %s: max-F1 unrounded %.4f, bytes %.4f\n", query_folder, length,
                    enhancement == place::Enhancement::kLocal ? "local" : "standardise", exact, rounded);
        // Two queries more or less of the corridor's 111: near ties may fall either way.
        EXPECT_NEAR(rounded, exact, 2.0 / 111);
      }
    }
  }
}

}  // namespace
