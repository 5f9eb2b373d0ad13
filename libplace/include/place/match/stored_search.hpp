#pragma once

#include "place/match/route_matching.hpp"
#include "place/match/team.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

namespace place {

/// Finds walks on a route whose descriptors stay in its database: they are read in chunks while they are
/// searched, and a team divides them (`shards_of`), so that a member reads and compares only its own part.
/// The result is that of `match_on_route` for a route in memory, and does not depend on the number of
/// members.
///
/// The first member makes one of these and gives it to `localise`; the others call `serve_shards` with the
/// same team until it is finished. Where a shortlist is used (`CandidateUse`), members project their parts,
/// and the first one searches the shortlist; otherwise all search, `path` and `lines` by messages of a few
/// values for each query.
class StoredSearch final : public TraverseSearch {
 public:
  /// `route`: the database; `memory_bytes`: what costs and descriptors may take. `callback`: receives this
  /// member's parts of the matrices. All must outlive this.
  StoredSearch(const std::filesystem::path& route, Team& team, std::optional<std::size_t> memory_bytes = {},
               const SearchCallback& callback = {});
  ~StoredSearch() override;

  /// Throws `vo::Error` for what cannot be done in parts: OpenSeqSLAM's search, `verify`, joined traverses,
  /// distances of float descriptors whose rounding depends on all of them; with several members also methods
  /// other than `path` and `lines`, and costs that are not enhanced.
  void prepare(const Settings& resolved, const Route& route) override;
  CostMatrix scale_costs(std::size_t traverse, const Descriptors& query) override;
  Found search(std::size_t traverse, const SampledWalk& sampled, const SearchOptions& search) override;

  /// Ends the search for all members, so that the first one can write. Without it, the others wait.
  void finish();
  /// Bytes of descriptors that this member read.
  [[nodiscard]] std::uint64_t bytes_read() const;

 private:
  class State;
  std::unique_ptr<State> state_;
};

/// What members but the first do: their part of every search, until it is finished. Returns the bytes of
/// descriptors read. `callback`: receives this member's parts of the matrices, and how many keyframes the
/// traverse has. Throws what fails; the caller must then end the team, or the other members wait for this
/// one.
std::uint64_t serve_shards(
    const std::filesystem::path& route, Team& team,
    const std::function<void(const SearchPart& part, std::size_t keyframes)>& callback = {});

}  // namespace place
