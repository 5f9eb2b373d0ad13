#pragma once

#include "match/shard_request.hpp"
#include "place/certainty/sure_search.hpp"
#include "place/match/candidates.hpp"
#include "place/match/route_matching.hpp"
#include "place/route/stored_descriptors.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <vector>

namespace place {

/// A member's work on its shard of each traverse, read from the route database. Every member performs the
/// same requests; what is collected is given to the first.
class StoredShard {
 public:
  /// `chunk_bytes`: of descriptors read at a time.
  StoredShard(std::filesystem::path route, Team& team, std::size_t chunk_bytes, SearchCallback callback);

  /// `route_digest`: of the route that the first member has read, which the file must still be;
  /// none: made in memory, and not compared.
  void use(const Settings& resolved, const std::optional<std::int64_t>& route_digest);
  [[nodiscard]] const RouteMatchingOptions& options() const { return options_; }
  [[nodiscard]] std::size_t keyframes(std::size_t traverse) { return stored(traverse).size(); }

  /// The projections of a traverse's descriptors, and what made them.
  struct Projected {
    CandidateFinder finder;
    std::vector<float> references;
  };
  Projected project(const ShardRequest& request);
  /// The costs of the columns, a matrix for each kind of descriptors in the request.
  std::vector<CostMatrix> costs(const ShardRequest& request);
  SureMatches search(const ShardRequest& request);

  [[nodiscard]] std::uint64_t bytes_read() const;

 private:
  StoredDescriptors& stored(std::size_t traverse);
  [[nodiscard]] Shard own(std::size_t traverse);
  /// Keyframes [begin, end) in parts that begin at multiples of a block.
  template <typename Body>
  void in_parts(std::size_t each, std::size_t begin, std::size_t end, const Body& body) const;
  Descriptors comparable(std::size_t kind, Descriptors read) const;
  /// The costs of keyframes [begin, end), a block at a time; for several kinds, standardised and summed.
  CostMatrix costs_of_part(const ShardRequest& request, std::size_t begin, std::size_t end);

  std::filesystem::path route_;
  Team& team_;
  std::size_t chunk_bytes_;
  SearchCallback callback_;
  RouteMatchingOptions options_;
  std::optional<std::int64_t> route_digest_;
  std::map<std::size_t, StoredDescriptors> stored_;
};

}  // namespace place
