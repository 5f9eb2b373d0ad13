#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <place/match/cost_matrix.hpp>
#include <place/match/match.hpp>

namespace retrace {

/// A PNG of an enhanced cost matrix, dark where alike, query keyframes from left to right and reference
/// keyframes from bottom to top, with the matches against `traverse` over it: accepted ones filled, refused
/// ones small and hollow. Large matrices are shrunk, keeping the least cost of each block; small ones are
/// enlarged, to at most `side_px` along the longer side. `cell`: keyframes along the side of a cell, if the
/// matrix was already shrunk.
std::vector<std::uint8_t> matrix_picture(const place::CostMatrix& enhanced,
                                         const std::vector<place::Match>& matches,
                                         const std::string& traverse, int side_px = 900,
                                         std::size_t cell = 1);

/// A PNG of a cost matrix alone, a pixel per cell, in the same orientation; large ones are shrunk likewise.
std::vector<std::uint8_t> cost_picture(const place::CostMatrix& costs, int side_px = 1024);

}  // namespace retrace
