#include "place/describe/network.hpp"

#include "describe/standardised_columns.hpp"
#include "place/describe/standardise.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/dnn.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <vo/base/error.hpp>
#include <vo/base/parallel.hpp>

namespace place {
namespace {

constexpr int kJpegQuality = 90;
constexpr double kNetworkPriorQueries = 30;  // as for blocks

/// OpenCV prints errors on standard error before it throws them.
class Quiet {
 public:
  Quiet() : before_(cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT)) {}
  ~Quiet() { cv::utils::logging::setLogLevel(before_); }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

 private:
  cv::utils::logging::LogLevel before_;
};

/// The useful part of OpenCV's message: without file, line and version.
std::string reason_of(const cv::Exception& error) {
  const std::string text = error.err.empty() ? std::string(error.what()) : error.err;
  return text.substr(0, text.find('\n')).substr(0, 200);
}

cv::dnn::Net read_net(const NetworkOptions& options) {
  if (options.model.empty())
    throw vo::Error("model", "is missing", "a network's file, with descriptor network");
  for (const std::string& file : {options.model, options.model_config}) {
    if (!file.empty() && !std::filesystem::is_regular_file(file))
      throw vo::Error(file, "is no file", "an ONNX, Darknet or Caffe model");
  }
  const std::string ending = std::filesystem::path(options.model).extension().string();
  const bool darknet = ending == ".weights", caffe = ending == ".caffemodel";
  if (!darknet && !caffe && ending != ".onnx")
    throw vo::Error(options.model, fmt::format("ends in '{}'", ending), ".onnx, .weights or .caffemodel");
  if ((darknet || caffe) && options.model_config.empty())
    throw vo::Error("model-config", "is missing", darknet ? "the network's .cfg" : "the network's .prototxt");
  try {
    cv::dnn::Net net = darknet ? cv::dnn::readNetFromDarknet(options.model_config, options.model)
                       : caffe ? cv::dnn::readNetFromCaffe(options.model_config, options.model)
                               : cv::dnn::readNetFromONNX(options.model);
    if (net.empty()) throw vo::Error(options.model, "holds no layers", "a network");
    net.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
    return net;
  } catch (const cv::Exception& error) {
    throw vo::Error(
        options.model, fmt::format("is not understood by OpenCV {}: {}", CV_VERSION, reason_of(error)),
        "a whole model of operators that it has; export ONNX with opset 11 and a fixed input size");
  }
}

/// The layer's name; throws if there is no such layer.
std::string layer_of(cv::dnn::Net& net, const NetworkOptions& options) {
  const std::vector<std::string> names = net.getLayerNames();
  if (options.layer.empty()) return net.getUnconnectedOutLayersNames().back();
  if (std::ranges::find(names, options.layer) != names.end()) return options.layer;
  // OpenCV prefixes the names in an ONNX file with this.
  const std::string of_onnx = "onnx_node!" + options.layer;
  if (std::ranges::find(names, of_onnx) != names.end()) return of_onnx;
  // The names most similar to the one asked for; otherwise the last ones.
  std::vector<std::string> alike;
  for (const std::string& name : names)
    if (name.find(options.layer) != std::string::npos) alike.push_back(name);
  if (alike.empty()) alike = names;
  constexpr std::size_t kShown = 5;
  const std::size_t first = alike.size() - std::min(kShown, alike.size());
  throw vo::Error(
      "layer", fmt::format("'{}' is none of the {} of {}", options.layer, names.size(), options.model),
      fmt::format("for example {}",
                  fmt::join(alike.begin() + static_cast<std::ptrdiff_t>(first), alike.end(), ", ")));
}

std::vector<float> pooled_output(cv::dnn::Net& net, const std::string& layer, const Bytes& jpeg,
                                 const NetworkOptions& options) {
  const cv::Mat picture = cv::imdecode(jpeg, cv::IMREAD_COLOR);
  if (picture.empty())
    throw vo::Error("a keyframe", "has no picture for the network", "a record of the descriptor network");
  const cv::Size size(options.input_width, options.input_height);
  const cv::Scalar mean(options.mean[0], options.mean[1], options.mean[2]);
  cv::Mat out;
  try {
    net.setInput(cv::dnn::blobFromImage(picture, options.scale, size, mean, options.swap_rb));
    out = net.forward(layer);
  } catch (const cv::Exception& error) {
    throw vo::Error(
        options.model,
        fmt::format("does not take a picture of {}x{}: {}", size.width, size.height, reason_of(error)),
        "the size that it was made for (input), fixed when it was exported");
  }
  if (out.type() != CV_32F || out.dims < 2 || out.size[0] != 1)
    throw vo::Error("layer", fmt::format("'{}' gives no grid of one picture", layer),
                    "a convolution, or what follows one");
  const int channels = out.size[1], rows = out.dims > 2 ? out.size[2] : 1,
            columns = out.dims > 3 ? out.size[3] : 1;
  if (out.dims > 4)
    throw vo::Error("layer", fmt::format("'{}' has {} dimensions", layer, out.dims), "at most 4");
  const std::span<const float> values(out.ptr<float>(), out.total());
  if (!std::ranges::all_of(values, [](float value) { return std::isfinite(value); }))
    throw vo::Error("layer", fmt::format("'{}' gives numbers that are not finite", layer),
                    "finite ones; look at scale and mean");
  return pool_grid(values, channels, rows, columns, options.pool_rows, options.pool_columns);
}

class Network final : public Descriptor {
 public:
  /// Reads the model once, so that its errors are reported before a walk is read.
  explicit Network(NetworkOptions options) : options_(std::move(options)) {
    const Quiet quiet;
    cv::dnn::Net net = read_net(options_);
    layer_of(net, options_);
  }

  [[nodiscard]] DescriptorTraits traits() const override {
    return {.max_shift = options_.pool_columns / 4,
            .columns = options_.pool_columns,
            .prior_queries = kNetworkPriorQueries,
            .metric = Metric::kCosine,
            .records_frames = true,
            .colour_width_px = options_.input_width};
  }

  [[nodiscard]] Bytes record(const vo::Frame& frame) const override {
    const cv::Mat& image = frame.colour.empty() ? frame.image : frame.colour;
    const cv::Size size(options_.input_width, options_.input_height);
    cv::Mat small;
    cv::resize(image, small, size, 0, 0, image.cols > size.width ? cv::INTER_AREA : cv::INTER_LINEAR);
    Bytes jpeg;
    cv::imencode(".jpg", small, jpeg, {cv::IMWRITE_JPEG_QUALITY, kJpegQuality});
    return jpeg;
  }

  [[nodiscard]] Bytes learn(const KeyframeRecords& keyframes) const override {
    return pack_spread(spread_of(rows_of(keyframes)));
  }

  [[nodiscard]] Describe describer(std::span<const std::uint8_t> learned) const override {
    return [this, learned = Bytes(learned.begin(), learned.end())](
               const KeyframeRecords& keyframes) -> Descriptors {
      if (keyframes.records.empty()) return ColumnStack{};
      return standardised_columns(rows_of(keyframes), learned, options_.pool_columns);
    };
  }

 private:
  [[nodiscard]] FloatRows rows_of(const KeyframeRecords& keyframes) const {
    const Quiet quiet;
    std::vector<std::vector<float>> outputs(keyframes.records.size());
    constexpr std::size_t kTogether = 32;  // keyframes processed for each reading of the model
    vo::parallel_for((outputs.size() + kTogether - 1) / kTogether, [&](std::size_t part) {
      cv::dnn::Net net = read_net(options_);
      const std::string layer = layer_of(net, options_);
      for (std::size_t i = part * kTogether; i < std::min(outputs.size(), (part + 1) * kTogether); ++i)
        outputs[i] = pooled_output(net, layer, keyframes.records[i], options_);
    });
    FloatRows rows{.width = outputs.empty() ? 0 : outputs.front().size(), .values = {}};
    for (const std::vector<float>& output : outputs)
      rows.values.insert(rows.values.end(), output.begin(), output.end());
    return rows;
  }

  NetworkOptions options_;
};

/// For each of `parts` equal parts of `cells` in a row: the cells it covers and how much of each.
std::vector<std::vector<std::pair<int, float>>> covered(int cells, int parts) {
  std::vector<std::vector<std::pair<int, float>>> of(static_cast<std::size_t>(parts));
  for (int part = 0; part < parts; ++part) {
    const std::int64_t begin = std::int64_t{part} * cells, end = begin + cells;  // in parts of a cell
    for (std::int64_t cell = begin / parts; cell * parts < end; ++cell) {
      const std::int64_t overlap = std::min((cell + 1) * parts, end) - std::max(cell * parts, begin);
      of[static_cast<std::size_t>(part)].emplace_back(
          static_cast<int>(cell), static_cast<float>(overlap) / static_cast<float>(cells));
    }
  }
  return of;
}

}  // namespace

std::vector<float> pool_grid(std::span<const float> grid, int channels, int rows, int columns, int pool_rows,
                             int pool_columns) {
  if (channels < 1 || rows < 1 || columns < 1 || pool_rows < 1 || pool_columns < 1 ||
      grid.size() != static_cast<std::size_t>(channels) * static_cast<std::size_t>(rows) *
                         static_cast<std::size_t>(columns)) {
    throw std::invalid_argument("pool_grid: a grid of its size, and parts, expected");
  }
  const auto down = covered(rows, pool_rows), across = covered(columns, pool_columns);
  std::vector<float> out;
  out.reserve(down.size() * across.size() * static_cast<std::size_t>(channels));
  for (const auto& in_x : across) {
    for (const auto& in_y : down) {
      for (int channel = 0; channel < channels; ++channel) {
        float sum = 0;
        for (const auto& [y, of_row] : in_y)
          for (const auto& [x, of_column] : in_x)
            sum += of_row * of_column * grid[static_cast<std::size_t>((channel * rows + y) * columns + x)];
        out.push_back(sum);
      }
    }
  }
  return out;
}

std::unique_ptr<Descriptor> make_network(const DescriptorOptions& options) {
  return std::make_unique<Network>(options.network);
}

}  // namespace place
