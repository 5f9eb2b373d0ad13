#pragma once

#include "kernels/descriptor.hpp"
#include "kernels/distance.hpp"
#include "kernels/hessian.hpp"
#include "kernels/orientation.hpp"

namespace vo::kernels {

/// All kernels over one kind of lanes.
template <class Lanes>
inline constexpr Kernels kTable{
    .hessian_row = hessian_row<Lanes>,
    .maxima_row = maxima_row<Lanes>,
    .orientation_moments = orientation_moments<Lanes>,
    .descriptor_sums =
        [](const Raster& raster, const Grid& grid, const DescriptorWeights& weights, bool extended,
           float* out) {
          extended ? descriptor_sums<Lanes, true>(raster, grid, weights, out)
                   : descriptor_sums<Lanes, false>(raster, grid, weights, out);
        },
    .squared_distances = squared_distances<Lanes>,
};

}  // namespace vo::kernels
