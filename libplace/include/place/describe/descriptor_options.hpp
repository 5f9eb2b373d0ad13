#pragma once

#include <array>
#include <optional>
#include <string>

#include <vo/image/patch_normalisation.hpp>

namespace place {

/// The width of the picture that settings of shifts count pixels of.
inline constexpr int kShiftWidth_px = 64;

/// How rows of floats are compared; lower is more alike.
enum class Metric {
  kCosine,  ///< 1 - cosine
  kL1,      ///< mean absolute difference
  kL2,      ///< Euclidean distance
};

/// Settings of the `network` descriptor.
struct NetworkOptions {
  std::string model;                          ///< ONNX, Darknet weights or Caffe model
  std::string model_config;                   ///< Darknet's .cfg, Caffe's .prototxt
  std::string layer;                          ///< whose output is taken; empty: the last
  int input_width = 320, input_height = 320;  ///< pixels
  int pool_rows = 5, pool_columns = 20;       ///< cells that the output is averaged to
  double scale = 1 / 255.0;                   ///< a pixel's value is multiplied by this, after ...
  std::array<double, 3> mean{};               ///< ... subtracting these, in the network's order of channels
  bool swap_rb = true;                        ///< the network expects red first
};

/// Settings of the `file` descriptor.
struct DescriptorFileOptions {
  std::string path;                 ///< NumPy's .npy: a row for each described frame; with a .csv next to it
  Metric metric = Metric::kCosine;  ///< of its rows
};

/// Which descriptor, and the settings of each.
struct DescriptorOptions {
  std::string name = "blocks";          ///< or several joined by '+'
  std::optional<int> max_shift_px;      ///< of a picture kShiftWidth_px wide; none: the descriptor's own
  vo::PatchNormalisationOptions patch;  ///< of `thumbnail`
  NetworkOptions network;
  DescriptorFileOptions file;
};

/// Whether a descriptor's name is `part`, or joins it with others.
inline bool has_part(const std::optional<std::string>& name, const std::string& part) {
  return name && ("+" + *name + "+").find("+" + part + "+") != std::string::npos;
}

}  // namespace place
