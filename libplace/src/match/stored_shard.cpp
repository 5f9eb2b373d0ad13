#include "match/stored_shard.hpp"

#include "certainty/part_certainty.hpp"
#include "match/messages.hpp"
#include "match/traverse_costs.hpp"
#include "place/match/descriptor_costs.hpp"
#include "place/match/sequence_searcher.hpp"
#include "place/match/summed_costs.hpp"
#include "place/stage_options.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <memory>
#include <numeric>
#include <utility>

#include <vo/base/error.hpp>

namespace place {
namespace {

/// The costs of one kind of descriptors, computed from the file chunk by chunk whenever they are needed.
class ReadCosts final : public CostSource {
 public:
  using Compute = std::function<void(std::size_t first, std::size_t count, const Costs& block)>;

  ReadCosts(std::size_t queries, std::size_t references, Compute compute)
      : queries_(queries), references_(references), compute_(std::move(compute)) {}

  [[nodiscard]] std::size_t queries() const override { return queries_; }
  [[nodiscard]] std::size_t references() const override { return references_; }
  [[nodiscard]] float unit() const override { return 1; }
  void compute(const Costs& block) const override {
    if (block.queries > 0 && block.references > 0) compute_(block.first_reference, block.references, block);
  }

 private:
  std::size_t queries_, references_;
  Compute compute_;
};

/// References beside a shard that its own matches need: where lines reach, the window and the slopes of a
/// match's neighbourhood, and what local enhancement leaves undefined.
std::size_t margin_of(const RouteMatchingOptions& options, const SearchOptions& search) {
  const std::vector<SearchLine> lines = search_lines(search.sequence);
  double steepest = 1;
  for (const SearchLine& line : lines) steepest = std::max(steepest, line.slope);
  const auto beside_match = static_cast<std::size_t>(search.sequence.uniqueness_window) +
                            2 * static_cast<std::size_t>(std::ceil(steepest));
  const std::size_t reach = options.method == "lines" ? reach_of(lines) + SequenceSearcher::kPart : 0;
  const ContrastEnhancer enhancer(0, 0, options.enhancement);
  constexpr std::size_t kAlign = ContrastEnhancer::kAlign;
  return (std::max(reach, beside_match) + kAlign - 1) / kAlign * kAlign + enhancer.margin();
}

}  // namespace

StoredShard::StoredShard(std::filesystem::path route, Team& team, std::size_t chunk_bytes,
                         SearchCallback callback)
    : route_(std::move(route)), team_(team), chunk_bytes_(chunk_bytes), callback_(std::move(callback)) {}

void StoredShard::use(const Settings& resolved, const std::optional<std::int64_t>& route_digest) {
  options_ = stage_options(resolved).matching;
  route_digest_ = route_digest;
}

StoredDescriptors& StoredShard::stored(std::size_t traverse) {
  const auto found = stored_.find(traverse);
  if (found != stored_.end()) return found->second;
  StoredDescriptors& opened = stored_.emplace(traverse, StoredDescriptors(route_, traverse)).first->second;
  if (route_digest_ && opened.digest() != route_digest_)
    throw vo::Error(route_.string(), "has changed since it was read", "no build on it meanwhile");
  return opened;
}

std::uint64_t StoredShard::bytes_read() const {
  std::uint64_t bytes = 0;
  for (const auto& [traverse, stored] : stored_) bytes += stored.bytes_read();
  return bytes;
}

Shard StoredShard::own(std::size_t traverse) {
  return shards_of(stored(traverse).size(), team_.size())[team_.rank()];
}

template <typename Body>
void StoredShard::in_parts(std::size_t each, std::size_t begin, std::size_t end, const Body& body) const {
  const std::size_t together = std::max<std::size_t>(1, chunk_bytes_ / each / kShardBlock) * kShardBlock;
  for (std::size_t first = begin; first < end;) {
    const std::size_t past = std::min(end, (first / kShardBlock * kShardBlock) + together);
    body(first, past);
    first = past;
  }
}

Descriptors StoredShard::comparable(std::size_t kind, Descriptors read) const {
  return (*options_.descriptors)[kind]->comparable(read);
}

StoredShard::Projected StoredShard::project(const ShardRequest& request) {
  StoredDescriptors& from = stored(request.traverse);
  const Shard mine = own(request.traverse);
  CandidateOptions options = options_.candidates;
  // Everyone learns the components from everyone's part of the sample.
  std::vector<std::size_t> sample;
  for (const std::size_t keyframe : candidate_sample(from.size(), options))
    if (mine.begin <= keyframe && keyframe < mine.end) sample.push_back(keyframe);
  const auto pictures = [&](Descriptors read) {
    CandidateOptions unused = options_.candidates;
    return candidate_pictures(comparable(0, std::move(read)), unused).value();
  };
  candidate_pictures(request.query.front(), options);
  vo::ImageStack all = pictures(from.read(0, sample));
  const vo::ImageStack own_sample = std::exchange(all, vo::make_image_stack(all.width, all.height, 0));
  for (const auto& pixels : exchange_all(team_, std::span<const std::uint8_t>(own_sample.pixels)))
    all.pixels.insert(all.pixels.end(), pixels.begin(), pixels.end());
  Projected projected{CandidateFinder(all, options), {}};
  std::vector<float> own_rows;
  own_rows.reserve(mine.size() * projected.finder.dimensions());
  in_parts(from.bytes_of_each(0), mine.begin, mine.end, [&](std::size_t first, std::size_t past) {
    const std::vector<float> rows = projected.finder.project(pictures(from.read(0, first, past)));
    own_rows.insert(own_rows.end(), rows.begin(), rows.end());
  });
  if (team_.size() == 1) {
    projected.references = std::move(own_rows);
    return projected;
  }
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(own_rows.data());
  for (const Team::Message& rows : team_.collect({bytes, own_rows.size() * sizeof(float)})) {
    const std::size_t at = projected.references.size();
    projected.references.resize(at + rows.size() / sizeof(float));
    if (!rows.empty()) std::memcpy(projected.references.data() + at, rows.data(), rows.size());
  }
  return projected;
}

std::vector<CostMatrix> StoredShard::costs(const ShardRequest& request) {
  StoredDescriptors& from = stored(request.traverse);
  const Shard mine = own(request.traverse);
  const auto own_columns = [&](const Shard& shard) {
    const auto begin = std::ranges::lower_bound(request.columns, shard.begin);
    return std::span(begin, std::ranges::lower_bound(request.columns, shard.end));
  };
  const auto columns = own_columns(mine);
  std::vector<CostMatrix> result;
  for (std::size_t kind = 0; kind < request.query.size(); ++kind) {
    const Descriptors& query = request.query[kind];
    const std::size_t queries = count_of(query);
    const DescriptorTraits traits = (*options_.descriptors)[kind]->traits();
    CostMatrix part = make_cost_matrix(queries, columns.size());
    in_parts(from.bytes_of_each(kind), 0, columns.size(), [&](std::size_t first, std::size_t past) {
      const Descriptors some = comparable(kind, from.read(kind, columns.subspan(first, past - first)));
      const Costs block = block_of(part).columns(first, past - first);
      descriptor_costs(query, some, traits, options_.max_shift_px)
          ->compute({0, queries, 0, block.references, block.values, block.stride});
    });
    if (team_.size() == 1) {
      result.push_back(std::move(part));
      continue;
    }
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(part.values.data());
    const std::vector<Team::Message> parts = team_.collect({bytes, part.values.size() * sizeof(float)});
    if (parts.empty()) continue;
    CostMatrix& whole = result.emplace_back(make_cost_matrix(queries, request.columns.size()));
    const std::vector<Shard> shards = shards_of(from.size(), team_.size());
    std::size_t first = 0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const std::size_t count = own_columns(shards[i]).size();
      for (std::size_t q = 0; q < queries && count > 0; ++q)
        std::memcpy(whole.row(q).data() + first, parts[i].data() + q * count * sizeof(float),
                    count * sizeof(float));
      first += count;
    }
  }
  return result;
}

CostMatrix StoredShard::costs_of_part(const ShardRequest& request, std::size_t begin, std::size_t end) {
  StoredDescriptors& from = stored(request.traverse);
  std::vector<SummedPart> parts;
  for (std::size_t kind = 0; kind < request.query.size(); ++kind) {
    const Descriptors& query = request.query[kind];
    const DescriptorTraits traits = (*options_.descriptors)[kind]->traits();
    const auto compute = [&, kind, traits](std::size_t first, std::size_t count, const Costs& block) {
      in_parts(from.bytes_of_each(kind), begin + first, begin + first + count,
               [&](std::size_t low, std::size_t high) {
                 const Descriptors some = comparable(kind, from.read(kind, low, high));
                 const Costs to = block.columns(low - begin, high - low);
                 descriptor_costs(query, some, traits, options_.max_shift_px)
                     ->compute({to.first_query, to.queries, 0, to.references, to.values, to.stride});
               });
    };
    parts.push_back(
        {std::make_unique<ReadCosts>(count_of(query), end - begin, compute), traits.prior_queries});
  }
  if (parts.size() == 1) return cost_matrix(*parts.front().costs);
  const SummedCosts summed(std::move(parts), from.size(), own(request.traverse), begin, team_);
  CostMatrix costs = make_cost_matrix(summed.queries(), summed.references());
  constexpr std::size_t kTogether = 8 * kShardBlock;  // each block has matrices of its own
  for (std::size_t first = 0; first < summed.references(); first += kTogether)
    summed.compute(block_of(costs).columns(first, std::min(kTogether, summed.references() - first)));
  return costs;
}

SureMatches StoredShard::search(const ShardRequest& request) {
  const std::size_t total = stored(request.traverse).size();
  const Shard mine = own(request.traverse);
  const std::size_t margin = margin_of(options_, request.search);
  const std::size_t first = mine.size() > 0 ? mine.begin - std::min(mine.begin, margin) : mine.begin;
  const std::size_t past = mine.size() > 0 ? std::min(total, mine.end + margin) : mine.end;
  CostMatrix enhanced = costs_of_part(request, first, past);
  const auto show = [&](bool is_enhanced) {
    if (!callback_) return;
    std::vector<std::size_t> keyframes(past - first);
    std::iota(keyframes.begin(), keyframes.end(), first);
    callback_({request.traverse, is_enhanced,
               block_of(std::as_const(enhanced)).columns(mine.begin - first, mine.size()), keyframes});
  };
  show(false);
  ContrastEnhancementOptions enhancement = options_.enhancement;
  enhancement.prior_queries = prior_queries_of(options_);
  ContrastEnhancer enhancer(enhanced.queries, total, enhancement, mine, first);
  if (enhancement.method == Enhancement::kStandardise)
    enhancer.survey(block_of(std::as_const(enhanced)).columns(mine.begin - first, mine.size()), mine.size());
  enhancer.share(team_);
  enhancer.enhance(block_of(enhanced));
  show(true);
  const SearchMethod& method = search_method(options_.method);
  if (team_.size() == 1) {
    if (enhancement.method == Enhancement::kNone) standardise_as_a_whole(enhanced);
    return search_surely(enhanced, method, request.search);
  }
  return search_surely_part({enhanced, first, mine, total}, method, request.search, team_);
}

}  // namespace place
