#include "match/messages.hpp"
#include "match/part_searches.hpp"
#include "match/search_by_stretches.hpp"
#include "match/search_stretch.hpp"
#include "place/match/sequence_searcher.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>

#include <vo/base/parallel.hpp>

namespace place {
namespace {

/// What is known of the costs of some blocks of references.
struct BlockRange {
  double sum = 0;
  float least = kUnreached, most = -kUnreached;

  BlockRange& operator+=(const BlockRange& more) {
    sum += more.sum;
    least = std::min(least, more.least);
    most = std::max(most, more.most);
    return *this;
  }
};

/// Eight of each at a time, which compilers vectorise.
void take_row(std::span<const float> row, BlockRange& range) {
  constexpr std::size_t kEight = 8;
  std::array<double, kEight> sums{};
  std::array<float, kEight> least, most;
  least.fill(range.least);
  most.fill(range.most);
  const auto take = [&](std::size_t i, std::size_t k) {
    sums[k] += static_cast<double>(row[i]);
    least[k] = row[i] < least[k] ? row[i] : least[k];
    most[k] = row[i] > most[k] ? row[i] : most[k];
  };
  const std::size_t whole = row.size() - row.size() % kEight;
  for (std::size_t i = 0; i < whole; i += kEight) {
    for (std::size_t k = 0; k < kEight; ++k) take(i + k, k);
  }
  for (std::size_t i = whole; i < row.size(); ++i) take(i, i - whole);
  for (const double sum : sums) range.sum += sum;
  range.least = *std::ranges::min_element(least);
  range.most = *std::ranges::max_element(most);
}

/// Of the whole matrix.
BlockRange range_of_team(const MatrixPart& part, Team& team) {
  std::vector<BlockRange> blocks((part.own.size() + kShardBlock - 1) / kShardBlock);
  vo::parallel_for(blocks.size(), [&](std::size_t b) {
    const std::size_t first = b * kShardBlock, count = std::min(kShardBlock, part.own.size() - first);
    for (std::size_t q = 0; q < part.queries(); ++q)
      take_row(part.own_row(q).subspan(first, count), blocks[b]);
  });
  TreeSum<BlockRange> own(part.own.begin / kShardBlock);
  for (const BlockRange& block : blocks) own.add(block);
  return sum_of_team(team, own).total();
}

using OnShard = SequenceSearcher::OnShard;

Team::Message message_of(const std::vector<OnShard>& shard) {
  MessageWriter message;
  for (const OnShard& query : shard) {
    message.put(query.best);
    message.put(query.elsewhere);
    message.put_all(query.head);
    message.put_all(query.tail);
    message.put(query.after_head);
    message.put(query.before_tail);
  }
  return message.bytes();
}

OnShard read_shard(MessageReader& message) {
  OnShard query;
  query.best = message.get<SequenceMatch>();
  query.elsewhere = message.get<float>();
  query.head = message.get_all<float>();
  query.tail = message.get_all<float>();
  query.after_head = message.get<float>();
  query.before_tail = message.get<float>();
  return query;
}

float least_in(std::span<const float> costs) {
  return costs.empty() ? kUnreached : *std::ranges::min_element(costs);
}

/// The least cost of a shard outside the window about a reference on another shard.
float least_outside(const OnShard& query, const Shard& shard, std::size_t reference, std::size_t window) {
  if (reference < shard.begin) {
    const std::size_t taken = reference + window + 1 - std::min(reference + window + 1, shard.begin);
    if (taken >= shard.size()) return kUnreached;
    return std::min(query.after_head, least_in(std::span(query.head).subspan(taken)));
  }
  const std::size_t taken = shard.end + window - std::min(shard.end + window, reference);
  if (taken >= shard.size()) return kUnreached;
  return std::min(query.before_tail, least_in(std::span(query.tail).first(query.tail.size() - taken)));
}

/// The best match of all shards for a query, and how much more the best one elsewhere costs.
SequenceMatch merge(const std::vector<OnShard>& query, const std::vector<Shard>& shards, std::size_t window) {
  std::optional<std::size_t> at;
  for (std::size_t i = 0; i < query.size(); ++i) {
    if (query[i].best.reference && (!at || query[i].best.cost < query[*at].best.cost)) at = i;
  }
  if (!at) return {};
  SequenceMatch match = query[*at].best;
  float elsewhere = query[*at].elsewhere;
  for (std::size_t i = 0; i < query.size(); ++i) {
    if (i != *at && shards[i].size() > 0)
      elsewhere = std::min(elsewhere, least_outside(query[i], shards[i], *match.reference, window));
  }
  match.score = (elsewhere == kUnreached ? 0 : elsewhere) - match.cost;
  return match;
}

/// A shard's part of a stretch, numbered from the stretch's begin; searched parts begin at multiples of
/// `SequenceSearcher::kPart` there.
Shard part_within(const Stretch& stretch, const Shard& own) {
  const auto border = [&](std::size_t reference) {
    if (reference <= stretch.begin) return std::size_t{0};
    const std::size_t length = stretch.end - stretch.begin;
    constexpr std::size_t kPart = SequenceSearcher::kPart;
    return std::min(length, (reference - stretch.begin + kPart - 1) / kPart * kPart);
  };
  return {border(own.begin), border(own.end)};
}

/// Stretches of query and reference, searched by themselves.
std::vector<SequenceMatch> search_pair(const MatrixPart& part, const Stretch& queries,
                                       const Stretch& references, const CostRange& range,
                                       const SequenceSearchOptions& options, Team& team) {
  const std::size_t count = queries.end - queries.begin;
  SequenceSearcher searcher(count, references.end - references.begin, range, options);
  const Shard own = part_within(references, part.own);
  std::vector<OnShard> found(count, OnShard{.best = {},
                                            .elsewhere = kUnreached,
                                            .head = {},
                                            .tail = {},
                                            .after_head = kUnreached,
                                            .before_tail = kUnreached});
  if (own.size() > 0) {
    const std::size_t first = std::max(part.first, references.begin),
                      past = std::min(part.first + part.costs.references, references.end);
    const float* const values =
        part.costs.values.data() + queries.begin * part.costs.references + (first - part.first);
    found = searcher.search_shard(
        {0, count, first - references.begin, past - first, values, part.costs.references}, own);
  }
  std::vector<SequenceMatch> matches;
  if (team.size() == 1) {
    for (const OnShard& query : found) matches.push_back(query.best);
    for (SequenceMatch& match : matches)
      if (match.reference) *match.reference += references.begin;
    return matches;
  }
  // Everyone merges what all found.
  std::vector<Shard> shards;
  for (const std::vector<Shard>& other : exchange_all(team, std::span<const Shard>(&own, 1)))
    shards.push_back(other.front());
  const std::vector<Team::Message> messages = team.exchange(message_of(found));
  std::vector<MessageReader> readers(messages.begin(), messages.end());
  for (std::size_t q = 0; q < count; ++q) {
    std::vector<OnShard> query;
    for (MessageReader& reader : readers) query.push_back(read_shard(reader));
    matches.push_back(merge(query, shards, static_cast<std::size_t>(options.uniqueness_window)));
    if (matches.back().reference) *matches.back().reference += references.begin;
  }
  return matches;
}

}  // namespace

SearchResult search_lines_part(const MatrixPart& enhanced, const SearchOptions& options, Team& team) {
  const SequenceSearchOptions& sequence = options.sequence;
  const BlockRange blocks = range_of_team(enhanced, team);
  // All stretches are centred on one mean, so that they can be compared.
  CostRange range;
  if (const std::size_t cells = enhanced.queries() * enhanced.references; cells > 0) {
    range.centre = blocks.sum / static_cast<double>(cells);
    range.largest = std::max(static_cast<double>(blocks.most) - range.centre,
                             range.centre - static_cast<double>(blocks.least));
  }
  SearchResult result;
  result.matches.resize(enhanced.queries());
  const auto window = static_cast<std::size_t>(std::max(0, sequence.uniqueness_window));
  for (const Stretch& queries : stretches_between(options.gaps.query, enhanced.queries())) {
    for (const Stretch& references : stretches_between(options.gaps.reference, enhanced.references)) {
      const std::vector<SequenceMatch> found =
          search_pair(enhanced, queries, references, range, sequence, team);
      for (std::size_t q = 0; q < found.size(); ++q) {
        SequenceMatch& joined = result.matches[queries.begin + q];
        joined = join_stretches(joined, found[q], window);
      }
    }
  }
  if (sequence.score == MatchScore::kRatio && enhanced.queries() > 0 && enhanced.references > 0)
    score_by_ratio(result.matches, blocks.least - static_cast<float>(range.centre));
  return result;
}

}  // namespace place
