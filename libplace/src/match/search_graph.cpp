#include "place/match/search_graph.hpp"

#include "match/row_minimum.hpp"
#include "place/match/search_method.hpp"

#include <algorithm>
#include <cmath>
#include <queue>
#include <stdexcept>
#include <unordered_map>
#include <vector>

#include <fmt/format.h>

#include <vo/base/stopping.hpp>

namespace place {
namespace {

/// A reached node: the cost of the cheapest path to it, and the reference that path came from.
struct Reached {
  double path_cost = 0;
  std::size_t from = 0;
};

/// An entry of the frontier. The cheapest comes first; among equals the later query, then the lower
/// reference.
struct Entry {
  double path_cost;
  std::size_t query, reference;

  bool operator<(const Entry& other) const {
    if (path_cost != other.path_cost) return path_cost > other.path_cost;
    if (query != other.query) return query < other.query;
    return reference > other.reference;
  }
};

/// The search over one stretch of the query.
class LazySearch {
 public:
  LazySearch(const CostView& enhanced, const SearchOptions& options, Stretch queries,
             const std::vector<Stretch>& references)
      : enhanced_(enhanced),
        settings_(options.graph),
        queries_(queries),
        reached_(queries.end - queries.begin),
        bounds_(enhanced.references) {
    for (const Stretch& stretch : references)
      std::fill(bounds_.begin() + static_cast<std::ptrdiff_t>(stretch.begin),
                bounds_.begin() + static_cast<std::ptrdiff_t>(stretch.end), stretch);
  }

  /// The reference of each query on the best path.
  std::vector<std::size_t> path() {
    start(queries_.begin);
    for (std::size_t q = queries_.begin + 1; q < queries_.end; ++q) {
      if (is_lost()) {
        start(q);
      } else {
        advance_to(q);
      }
    }
    finish();
    std::vector<std::size_t> references(reached_.size());
    std::size_t at = best_.reference;
    for (std::size_t i = reached_.size(); i-- > 0;) {
      references[i] = at;
      at = reached_[i].at(at).from;
    }
    return references;
  }

  [[nodiscard]] std::size_t looked_at() const {
    std::size_t count = whole_rows_ * enhanced_.references;
    for (std::size_t i = 0; i < reached_.size(); ++i) {
      if (!is_whole_[i]) count += reached_[i].size();
    }
    return count;
  }

 private:
  [[nodiscard]] bool is_hidden(std::size_t query, std::size_t reference) const {
    return !(enhanced_.at(query, reference) <= settings_.hidden_cost);
  }
  [[nodiscard]] double weight(std::size_t query, std::size_t reference) const {
    return std::exp(is_hidden(query, reference) ? settings_.hidden_cost
                                                : static_cast<double>(enhanced_.at(query, reference)));
  }

  /// Looks at a whole row, starting from the best path so far.
  void start(std::size_t query) {
    frontier_ = {};
    const Entry from = best_;
    ++whole_rows_;
    is_whole_.resize(reached_.size());
    is_whole_[query - queries_.begin] = true;
    for (std::size_t r = 0; r < enhanced_.references; ++r) {
      if (!is_hidden(query, r)) reach(query, r, from.path_cost, from.reference);
    }
    if (frontier_.empty()) {
      const std::size_t least = row_minimum(enhanced_.row(query)).reference;
      reach(query, std::min(least, enhanced_.references - 1), from.path_cost, from.reference);
    }
  }

  void reach(std::size_t query, std::size_t reference, double path_cost, std::size_t from) {
    const double cost = path_cost + weight(query, reference);
    const auto [node, is_new] = reached_[query - queries_.begin].try_emplace(reference, Reached{cost, from});
    if (!is_new) {
      if (!(cost < node->second.path_cost)) return;
      node->second = {cost, from};
    }
    const Entry entry{cost, query, reference};
    frontier_.push(entry);
    const bool is_better = query > best_.query || cost < best_.path_cost ||
                           (cost == best_.path_cost && reference < best_.reference);
    if (!has_best_ || (query >= best_.query && is_better)) best_ = entry;
    has_best_ = true;
  }

  /// Expands nodes until one of the query before has been expanded.
  void advance_to(std::size_t query) {
    while (!frontier_.empty() && !(expand_next() && last_expanded_ + 1 == query)) {
    }
  }

  /// Expands the nodes that may still reach the last query more cheaply than the best path.
  void finish() {
    while (!frontier_.empty() && frontier_.top().query + 1 < queries_.end) expand_next();
  }

  /// Takes the cheapest node from the frontier; false if it is not worth expanding.
  bool expand_next() {
    vo::stop_if_asked();
    const Entry node = frontier_.top();
    frontier_.pop();
    if (reached_[node.query - queries_.begin].at(node.reference).path_cost < node.path_cost) return false;
    if (!is_worth_expanding(node)) return false;
    const auto fan = static_cast<std::size_t>(settings_.fan_out);
    const std::size_t past = std::min(bounds_[node.reference].end, node.reference + fan + 1);
    for (std::size_t r = node.reference; r < past; ++r)
      reach(node.query + 1, r, node.path_cost, node.reference);
    last_expanded_ = node.query;
    return true;
  }

  [[nodiscard]] bool is_worth_expanding(const Entry& node) const {
    const auto nodes = static_cast<double>(best_.query - queries_.begin + 1);
    const auto behind = static_cast<double>(best_.query - node.query);
    return node.path_cost + behind * settings_.expansion_rate * best_.path_cost / nodes <= best_.path_cost;
  }

  /// Whether all of the best path's last nodes are hidden.
  [[nodiscard]] bool is_lost() const {
    constexpr std::size_t kNodes = 5;  // as long as their sliding window
    if (best_.query + 1 - queries_.begin < kNodes) return false;
    std::size_t hidden = 0, at = best_.reference;
    for (std::size_t i = 0; i < kNodes; ++i) {
      const std::size_t query = best_.query - i;
      hidden += static_cast<std::size_t>(is_hidden(query, at));
      at = reached_[query - queries_.begin].at(at).from;
    }
    return hidden == kNodes;
  }

  CostView enhanced_;
  const GraphSearchOptions& settings_;
  Stretch queries_;
  std::vector<std::unordered_map<std::size_t, Reached>> reached_;  // by query
  std::vector<Stretch> bounds_;                                    // the stretch that each reference lies in
  std::vector<bool> is_whole_;                                     // queries whose whole row was looked at
  std::size_t whole_rows_ = 0;
  std::priority_queue<Entry> frontier_;
  Entry best_{0, 0, 0};
  std::size_t last_expanded_ = 0;
  bool has_best_ = false;
};

/// Matches along a path over the queries from `begin` on.
void match_path(const CostView& enhanced, const SearchOptions& options, std::size_t begin,
                const std::vector<std::size_t>& path, std::vector<SequenceMatch>& matches) {
  const double hidden = options.graph.hidden_cost;
  const int length = options.sequence.length;
  const auto count = static_cast<std::ptrdiff_t>(path.size());
  const auto below_hidden = [&](std::ptrdiff_t i) {
    const auto at = static_cast<std::size_t>(i);
    return std::max(0.0, hidden - static_cast<double>(enhanced.at(begin + at, path[at])));
  };
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const float own = enhanced.at(begin + at, path[at]);
    if (!(static_cast<double>(own) <= hidden)) continue;
    double sum = 0;
    int terms = 0;
    for (int k = 0; k < length; ++k) {
      const std::ptrdiff_t along = i + k - length / 2;
      if (along < 0 || along >= count) continue;
      sum += below_hidden(along);
      ++terms;
    }
    matches[begin + at] = {.reference = path[at],
                           .cost = own,
                           .score = static_cast<float>(sum / std::sqrt(1.0 * terms * length)),
                           .terms = terms};
  }
}

}  // namespace

bool GraphSearchOptions::is_valid(std::string* reason) const {
  const auto invalid = [&](std::string text) {
    if (reason != nullptr) *reason = std::move(text);
    return false;
  };
  if (fan_out < 1) return invalid(fmt::format("fan-out is {}; at least 1 expected", fan_out));
  if (!std::isfinite(hidden_cost)) return invalid("hidden cost is not finite; a finite one expected");
  if (!(expansion_rate >= 0 && expansion_rate <= 1))
    return invalid(fmt::format("expansion rate is {}; 0 <= rate <= 1 expected", expansion_rate));
  return true;
}

SearchResult search_graph(const CostView& enhanced, const SearchOptions& options) {
  std::string reason;
  if (!options.graph.is_valid(&reason) || !options.sequence.is_valid(&reason))
    throw std::invalid_argument("search_graph: " + reason);
  SearchResult result;
  result.matches.resize(enhanced.queries);
  if (enhanced.values.empty()) return result;
  const std::vector<Stretch> references = stretches_between(options.gaps.reference, enhanced.references);
  std::size_t looked_at = 0;
  for (const Stretch& queries : stretches_between(options.gaps.query, enhanced.queries)) {
    LazySearch search(enhanced, options, queries, references);
    match_path(enhanced, options, queries.begin, search.path(), result.matches);
    looked_at += search.looked_at();
  }
  result.looked_at = static_cast<double>(looked_at) / static_cast<double>(enhanced.values.size());
  return result;
}

}  // namespace place
