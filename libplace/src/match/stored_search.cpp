#include "place/match/stored_search.hpp"

#include "match/stored_shard.hpp"
#include "match/traverse_costs.hpp"
#include "place/match/descriptor_costs.hpp"
#include "place/match/summed_costs.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <vo/base/error.hpp>

namespace place {
namespace {

constexpr std::size_t kChunkBytes = 64 << 20;  // of descriptors read at a time, where memory is not limited

/// A matrix that is there already.
class GivenCosts final : public CostSource {
 public:
  explicit GivenCosts(CostMatrix costs) : costs_(std::move(costs)) {}

  [[nodiscard]] std::size_t queries() const override { return costs_.queries; }
  [[nodiscard]] std::size_t references() const override { return costs_.references; }
  [[nodiscard]] float unit() const override { return 1; }
  void compute(const Costs& block) const override {
    for (std::size_t q = 0; q < block.queries; ++q)
      std::ranges::copy(costs_.row(block.first_query + q).subspan(block.first_reference, block.references),
                        block.row(q).begin());
  }

 private:
  CostMatrix costs_;
};

/// Does what the first member asks for; false when it asks for nothing more.
bool perform(const ShardRequest& request, StoredShard& shard) {
  switch (request.task) {
    case ShardRequest::Task::kSettings:
      shard.use(request.settings, request.route_digest);
      return true;
    case ShardRequest::Task::kProject:
      shard.project(request);
      return true;
    case ShardRequest::Task::kCosts:
      shard.costs(request);
      return true;
    case ShardRequest::Task::kSearch:
      shard.search(request);
      return true;
    case ShardRequest::Task::kDone:
      break;
  }
  return false;
}

std::string memory_text(std::size_t bytes) {
  return bytes < (std::size_t{1} << 30U) ? fmt::format("{:.0f}M", static_cast<double>(bytes) / (1 << 20))
                                         : fmt::format("{:.1f}G", static_cast<double>(bytes) / (1 << 30));
}

}  // namespace

class StoredSearch::State {
 public:
  State(const std::filesystem::path& route, Team& team, std::optional<std::size_t> memory_bytes,
        const SearchCallback& callback)
      : team_(team),
        memory_bytes_(memory_bytes),
        callback_(callback),
        shard_(route, team,
               std::min(kChunkBytes, memory_bytes.value_or(kChunkBytes * kShareOfChunk) / kShareOfChunk),
               callback) {}

  void prepare(const Settings& resolved, const Route& route) {
    check(resolved, route);
    ShardRequest request{
        .task = ShardRequest::Task::kSettings, .settings = resolved, .route_digest = route.digest};
    tell(request);
    shard_.use(resolved, route.digest);
    for (const auto& descriptor : *shard_.options().descriptors) {
      const Metric metric = descriptor->traits().metric;
      if (metric != Metric::kCosine)
        throw vo::Error("descriptor-metric", "l1 and l2 cannot be searched in parts", "cosine");
    }
  }

  CostMatrix scale_costs(std::size_t traverse, const Descriptors& query) {
    const std::size_t count = shard_.keyframes(traverse);
    const std::vector<std::size_t> columns =
        count > kMostForScale ? shortlist(traverse, query, {}) : counted(count);
    return std::move(costs(traverse, {query}, columns).front());
  }

  Found search(std::size_t traverse, const SampledWalk& sampled, SearchOptions search) {
    const RouteMatchingOptions& options = shard_.options();
    std::vector<Descriptors> query;
    for (std::size_t kind = 0; kind < options.descriptors->size(); ++kind)
      query.push_back((*options.descriptors)[kind]->comparable(sampled.descriptors.at(kind)));
    const std::size_t queries = count_of(query.front()), count = shard_.keyframes(traverse);
    Found found;
    if (!uses_shortlist(options, queries, count)) {
      check_fits(queries, count, count);
      ShardRequest request{.task = ShardRequest::Task::kSearch};
      request.traverse = traverse;
      request.query = std::move(query);
      request.search = std::move(search);
      tell(request);
      return {counted(count), shard_.search(request)};
    }
    CandidateOptions candidates = options.candidates;
    candidates.margin = std::max(candidates.margin, search.sequence.length);
    found.columns = shortlist(traverse, query.front(), candidates);
    check_fits(queries, found.columns.size(), count);
    std::vector<CostMatrix> matrices = costs(traverse, query, found.columns);
    std::vector<SummedPart> parts;
    for (std::size_t kind = 0; kind < matrices.size(); ++kind)
      parts.push_back({std::make_unique<GivenCosts>(std::move(matrices[kind])),
                       (*options.descriptors)[kind]->traits().prior_queries});
    TraverseCosts compared{found.columns, parts.size() == 1 ? cost_matrix(*parts.front().costs)
                                                            : cost_matrix(SummedCosts(std::move(parts)))};
    enhance_compared(compared, traverse, options, callback_);
    search.gaps.reference = gaps_between(found.columns, search.gaps.reference);
    found.matches = search_surely(compared.enhanced, search_method(options.method), search);
    return found;
  }

  void finish() {
    if (!std::exchange(finished_, true)) tell(ShardRequest{.task = ShardRequest::Task::kDone});
  }

  [[nodiscard]] std::uint64_t bytes_read() const { return shard_.bytes_read(); }

 private:
  static constexpr std::size_t kShareOfChunk = 16;  // of the memory

  void tell(const ShardRequest& request) {
    if (team_.size() > 1) team_.exchange(message_of(request));
  }

  void check(const Settings& resolved, const Route& route) const {
    const char* const how =
        team_.size() > 1 ? "cannot be divided among processes" : "needs the route in memory";
    if (resolved.compat && resolved.compat != "none") throw vo::Error("compat", how, "none");
    if (resolved.verify.value_or(0) > 0) throw vo::Error("verify", how, "0");
    if (route.traverses.size() > 1 && resolved.fuse_traverses.value_or(true))
      throw vo::Error("fuse-traverses", fmt::format("{}, with {} traverses", how, route.traverses.size()),
                      "false, or a route of one traverse");
    // What a shift costs a thumbnail is learned from all references (`ThumbnailCosts`).
    if (resolved.max_shift_px.value_or(0) > 0 && has_part(resolved.descriptor, "thumbnail"))
      throw vo::Error("max-shift-px of thumbnails", how, "0");
    if (team_.size() == 1) return;
    if (search_method(resolved.search.value_or("path")).search_part == nullptr)
      throw vo::Error(fmt::format("search {}", *resolved.search), how, "path or lines");
    if (resolved.enhance == "none") throw vo::Error("enhance none", how, "standardise or local");
  }

  /// A matrix of costs, a second one for the walk played backwards, and what is kept of all keyframes.
  void check_fits(std::size_t queries, std::size_t columns, std::size_t keyframes) const {
    constexpr std::size_t kProgram = std::size_t{192} << 20U;
    if (!memory_bytes_) return;
    // A shortlist's projections are kept, copied for FLANN, and in the order of its tree; with pointers and
    // nodes.
    const bool shortlisted = columns < keyframes;
    const std::size_t projections =
        shortlisted
            ? 3 * sizeof(float) * static_cast<std::size_t>(shard_.options().candidates.dimensions) + 40
            : 0;
    const std::size_t of_keyframe = sizeof(Keyframe) + 32 + projections;
    const std::size_t needed =
        2 * sizeof(float) * queries * columns + of_keyframe * keyframes + *memory_bytes_ / 8 + kProgram;
    if (needed <= *memory_bytes_) return;
    throw vo::Error(fmt::format("--memory {}", memory_text(*memory_bytes_)),
                    fmt::format("is too little: the costs of {} x {} keyframes take {} with the rest",
                                queries, columns, memory_text(needed)),
                    shortlisted ? "more" : "more, or --candidates always");
  }

  std::vector<CostMatrix> costs(std::size_t traverse, std::vector<Descriptors> query,
                                std::vector<std::size_t> columns) {
    ShardRequest request{.task = ShardRequest::Task::kCosts};
    request.traverse = traverse;
    request.query = std::move(query);
    request.columns = std::move(columns);
    tell(request);
    return shard_.costs(request);
  }

  std::vector<std::size_t> shortlist(std::size_t traverse, const Descriptors& query,
                                     CandidateOptions candidates) {
    const std::size_t count = shard_.keyframes(traverse);
    const auto pictures = candidate_pictures(query, candidates);
    if (!pictures || all_are_candidates(count, candidates)) return counted(count);
    auto projected = projected_.find(traverse);
    if (projected == projected_.end()) {
      ShardRequest request{.task = ShardRequest::Task::kProject};
      request.traverse = traverse;
      request.query = {query};
      tell(request);
      projected = projected_.emplace(traverse, shard_.project(request)).first;
    }
    return projected->second.finder.find(*pictures, projected->second.references, candidates);
  }

  Team& team_;
  std::optional<std::size_t> memory_bytes_;
  SearchCallback callback_;
  StoredShard shard_;
  std::map<std::size_t, StoredShard::Projected> projected_;
  bool finished_ = false;
};

StoredSearch::StoredSearch(const std::filesystem::path& route, Team& team,
                           std::optional<std::size_t> memory_bytes, const SearchCallback& callback)
    : state_(std::make_unique<State>(route, team, memory_bytes, callback)) {}
StoredSearch::~StoredSearch() = default;

void StoredSearch::prepare(const Settings& resolved, const Route& route) {
  state_->prepare(resolved, route);
}

CostMatrix StoredSearch::scale_costs(std::size_t traverse, const Descriptors& query) {
  return state_->scale_costs(traverse, query);
}

TraverseSearch::Found StoredSearch::search(std::size_t traverse, const SampledWalk& sampled,
                                           const SearchOptions& search) {
  return state_->search(traverse, sampled, search);
}

void StoredSearch::finish() {
  state_->finish();
}

std::uint64_t StoredSearch::bytes_read() const {
  return state_->bytes_read();
}

std::uint64_t serve_shards(const std::filesystem::path& route, Team& team,
                           const std::function<void(const SearchPart&, std::size_t)>& callback) {
  StoredShard* self = nullptr;
  SearchCallback with_keyframes;
  if (callback)
    with_keyframes = [&](const SearchPart& part) { callback(part, self->keyframes(part.traverse)); };
  StoredShard shard(route, team, kChunkBytes, with_keyframes);
  self = &shard;
  while (perform(read_request(team.exchange({}).front()), shard)) {
  }
  return shard.bytes_read();
}

}  // namespace place
