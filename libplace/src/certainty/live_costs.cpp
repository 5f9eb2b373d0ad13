#include "certainty/live_costs.hpp"

#include "place/match/descriptor_costs.hpp"

#include <algorithm>
#include <cmath>

#include <vo/base/error.hpp>

namespace place {
namespace {

// Pictures that must be seen before a keyframe's own mean counts as much as none; the descriptors' own number
// (`DescriptorTraits::prior_queries`) is for whole walks, of which a walker has seen only a part.
constexpr double kPriorPictures = 100;
// Keyframes of a traverse that play queries beforehand, and how many pictures of a real walk they count for:
// they were taken in the same light as those they are compared with.
constexpr std::size_t kOwnQueries = 200;
constexpr double kOwnWeight = 30;

/// To mean 0 and deviation 1; all 0 where all are equal.
void standardise(std::span<float> row) {
  double sum = 0, squares = 0;
  for (const float value : row) {
    sum += static_cast<double>(value);
    squares += static_cast<double>(value) * static_cast<double>(value);
  }
  const auto count = static_cast<double>(row.size());
  const double mean = sum / count, variance = squares / count - mean * mean;
  const double scale = variance > 1e-12 ? 1 / std::sqrt(variance) : 0;
  for (float& value : row) value = static_cast<float>((static_cast<double>(value) - mean) * scale);
}

}  // namespace

LiveCosts::LiveCosts(const Route& route, const StageOptions& options)
    : route_(route),
      descriptors_(options.sampling.descriptors),
      max_shift_px_(options.matching.max_shift_px) {
  if (!descriptors_) descriptors_ = make_descriptors({.name = "thumbnail", .patch = options.matching.patch});
  if (route.settings.descriptor && route.settings.descriptor->find("file") != std::string::npos)
    throw vo::Error("the route", "is described by a file, which has no row for a new picture",
                    "a route built with another descriptor");
  for (std::size_t k = 0; k < descriptors_->size(); ++k)
    describe_.push_back((*descriptors_)[k]->describer(route.learned.at(k)));
  for (const Traverse& traverse : route.traverses) {
    std::vector<Descriptors>& references = references_.emplace_back();
    for (std::size_t k = 0; k < descriptors_->size(); ++k)
      references.push_back((*descriptors_)[k]->comparable(traverse.descriptors.at(k)));
    usual_.emplace_back(traverse.keyframes.size());
  }
  for (std::size_t t = 0; t < route.traverses.size(); ++t) {
    const std::size_t count = route.traverses[t].keyframes.size(), queries = std::min(count, kOwnQueries);
    for (std::size_t i = 0; i < queries; ++i) {
      const std::size_t at = i * count / queries;
      std::vector<Descriptors> query;
      for (const Descriptors& references : references_[t]) query.push_back(select(references, {{at}}));
      see(t, row(t, query), kOwnWeight / static_cast<double>(queries));
    }
  }
}

std::vector<float> LiveCosts::row(std::size_t traverse, const std::vector<Descriptors>& query) const {
  std::vector<float> total(route_.traverses[traverse].keyframes.size(), 0.0F);
  for (std::size_t k = 0; k < descriptors_->size(); ++k) {
    CostMatrix costs = cost_matrix(
        *descriptor_costs(query[k], references_[traverse][k], (*descriptors_)[k]->traits(), max_shift_px_));
    standardise(costs.row(0));
    for (std::size_t r = 0; r < total.size(); ++r) total[r] += costs.values[r];
  }
  if (descriptors_->size() > 1) standardise(total);
  return total;
}

void LiveCosts::see(std::size_t traverse, std::span<const float> row, double weight) {
  for (std::size_t r = 0; r < row.size(); ++r) {
    const auto value = static_cast<double>(row[r]);
    Usual& usual = usual_[traverse][r];
    usual.count += weight;
    usual.sum += weight * value;
    usual.squares += weight * value * value;
  }
}

std::vector<float> LiveCosts::against(const vo::Frame& frame, const vo::ImageStack& thumbnail) {
  KeyframeRecords records{.frames = {0}, .time_s = {frame.time_s}, .thumbnails = thumbnail, .records = {}};
  std::vector<Descriptors> query;
  for (std::size_t k = 0; k < descriptors_->size(); ++k) {
    const Descriptor& descriptor = *(*descriptors_)[k];
    records.records.clear();
    if (descriptor.traits().records_frames) records.records.push_back(descriptor.record(frame));
    query.push_back(descriptor.comparable(describe_[k](records)));
  }
  std::vector<float> all;
  for (std::size_t t = 0; t < references_.size(); ++t) {
    const std::vector<float> costs = row(t, query);
    see(t, costs, 1);
    for (std::size_t r = 0; r < costs.size(); ++r) {
      const Usual& usual = usual_[t][r];
      const double mean = usual.sum / usual.count;
      const double variance = std::max(0.0, usual.squares / usual.count - mean * mean);
      const double w = usual.count / (usual.count + kPriorPictures);
      all.push_back(
          static_cast<float>((static_cast<double>(costs[r]) - w * mean) / std::sqrt(w * variance + 1 - w)));
    }
  }
  return all;
}

}  // namespace place
