#pragma once

#include "place/describe/column_stack.hpp"
#include "place/describe/descriptor_options.hpp"
#include "place/describe/float_rows.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include <vo/image/image_stack.hpp>
#include <vo/io/frame_source.hpp>

namespace place {

/// Bytes, whose meaning is the descriptor's own.
using Bytes = std::vector<std::uint8_t>;

/// What one pass over a walk kept of its keyframes.
struct KeyframeRecords {
  std::vector<std::size_t> frames;  ///< of the walk, increasing
  std::vector<double> time_s;       ///< of each, since the walk's first frame
  vo::ImageStack thumbnails;        ///< of each
  std::vector<Bytes> records;       ///< of each, by `Descriptor::record`; empty where it keeps none

  [[nodiscard]] std::size_t size() const { return frames.size(); }
};

/// One descriptor for each keyframe, in the form that its comparison takes: pixels by absolute difference,
/// columns by the cosine with a shift, rows of floats by `DescriptorTraits::metric`.
using Descriptors = std::variant<vo::ImageStack, ColumnStack, FloatRows>;

std::size_t count_of(const Descriptors& descriptors);
/// Bytes that the descriptor of one keyframe takes in a route.
std::size_t bytes_of_each(const Descriptors& descriptors);

/// Those at `indices`, in that order. Throws `std::out_of_range` for an index past the end.
Descriptors select(const Descriptors& descriptors, std::span<const std::size_t> indices);

/// What a descriptor asks of the stages around it.
struct DescriptorTraits {
  /// Columns of the descriptor, or pixels of a thumbnail, that a view is moved to either side at most where
  /// `--max-shift-px` does not say.
  int max_shift = 0;
  int columns = 0;                  ///< that a picture is divided into; 0 where nothing can be shifted
  double prior_queries = 0;         ///< `ContrastEnhancementOptions::prior_queries`
  Metric metric = Metric::kCosine;  ///< of `FloatRows`
  bool records_frames = false;      ///< `record` is to be called for every frame
  int colour_width_px = 0;  ///< width of the pictures in colour that `record` asks for; 0: grey will do
};

/// What a keyframe is compared by.
///
/// Frames are seen once, before it is known which become keyframes, so work comes in three parts: `record`
/// keeps something compact of every frame; `learn` takes from the keyframes of a route's first traverse what
/// needs a whole walk (a vocabulary, axes), to be stored in the route; `describe` makes descriptors of the
/// keyframes of any walk. A new descriptor is a class like those beside it, an entry in the table of
/// descriptor.cpp, and its test.
class Descriptor {
 public:
  virtual ~Descriptor() = default;

  [[nodiscard]] virtual DescriptorTraits traits() const = 0;

  /// What to keep of a frame. Called for frames of one walk at the same time.
  [[nodiscard]] virtual Bytes record(const vo::Frame& frame) const;

  /// What the descriptors of all walks on a route share. Throws `vo::Error` where the keyframes give nothing
  /// to learn from.
  [[nodiscard]] virtual Bytes learn(const KeyframeRecords& keyframes) const;

  /// The descriptors of a walk's keyframes. `learned`: of `learn`; throws `vo::Error` for bytes that are
  /// not. The same bytes for any number of threads.
  [[nodiscard]] virtual Descriptors describe(const KeyframeRecords& keyframes,
                                             std::span<const std::uint8_t> learned) const = 0;

  /// What of a route's or a walk's descriptors is compared: they themselves, unless the descriptor keeps them
  /// in another form.
  [[nodiscard]] virtual Descriptors comparable(const Descriptors& described) const;
};

/// The descriptors that keyframes are compared by, one or several together.
using DescriptorSet = std::vector<std::unique_ptr<Descriptor>>;

/// The names of all descriptors, in the order in which help lists them.
std::vector<std::string> descriptor_names();

/// The descriptors of a name, or of several joined by '+', whose standardised matrices are summed. Throws
/// `vo::Error` for a name that is none.
std::shared_ptr<const DescriptorSet> make_descriptors(const DescriptorOptions& options);

}  // namespace place
