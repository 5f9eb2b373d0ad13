#pragma once

#include "place/describe/descriptor.hpp"

#include <memory>
#include <span>

namespace place {

/// Histograms of oriented gradients (Dalal and Triggs 2005): blocks of 2 x 2 neighbouring cells, each divided
/// by its length, clipped at 0.2 and divided again. `cells`: of `gradient_cells` over 8 x 16 cells of 8
/// pixels and 12 directions. Returns 15 columns of 7 blocks, 5040 values, column after column.
std::vector<float> hog_of(std::span<const float> cells);

/// The descriptor: `hog_of`, standardised over the walk (`standardise`), in bytes, with a shift of up to 4
/// of 15 columns. Keeps 1536 bytes of every frame: 140 MB for an hour at 25 frames/s.
std::unique_ptr<Descriptor> make_hog(const DescriptorOptions& options);

}  // namespace place
