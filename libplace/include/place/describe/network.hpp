#pragma once

#include "place/describe/descriptor.hpp"
#include "place/describe/float_rows.hpp"

#include <memory>
#include <span>

namespace place {

/// Averages of a grid of rows x columns x channels (channels first, as networks give it) over pool_rows x
/// pool_columns parts of equal size; what lies on a border counts for both by its share. Returns a row of the
/// parts' channels, column after column, top to bottom. O(out * covered). Throws `std::invalid_argument` if
/// sizes disagree.
std::vector<float> pool_grid(std::span<const float> grid, int channels, int rows, int columns, int pool_rows,
                             int pool_columns);

/// The output of a layer of a convolutional network, averaged over a grid, standardised over the walk
/// (`standardise`), in bytes, with a shift of a quarter of its columns (Suenderhauf et al. 2015: middle
/// layers know places again in other light). By OpenCV's dnn module: ONNX, Darknet, Caffe.
///
/// Of every frame a JPEG of the network's input size is kept, some 15 kB, 1.4 GB for an hour at 25 frames/s,
/// so that the network sees keyframes alone. `learn` and `describe` throw `vo::Error`, in one line with what
/// to do, for a model that is not there or cannot be read, a layer that it does not have, an input or an
/// operator that it does not take.
std::unique_ptr<Descriptor> make_network(const DescriptorOptions& options);

}  // namespace place
