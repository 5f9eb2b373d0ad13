#pragma once

#include "place/describe/column_stack.hpp"
#include "place/describe/descriptor_options.hpp"
#include "place/describe/float_rows.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include <vo/image/image_stack.hpp>
#include <vo/io/frame_source.hpp>

namespace place {

/// Bytes whose meaning only the descriptor knows.
using Bytes = std::vector<std::uint8_t>;

/// What one pass over a walk kept of its keyframes.
struct KeyframeRecords {
  std::vector<std::size_t> frames;  ///< of the walk, increasing
  std::vector<double> time_s;       ///< of each, since the walk's first frame
  vo::ImageStack thumbnails;        ///< of each
  std::vector<Bytes> records;       ///< of each, from `Descriptor::record`; empty if it keeps none

  [[nodiscard]] std::size_t size() const { return frames.size(); }
};

/// One descriptor for each keyframe, in the form used for comparison: pixels by absolute difference, columns
/// by the cosine with a shift, rows of floats by `DescriptorTraits::metric`.
using Descriptors = std::variant<vo::ImageStack, ColumnStack, FloatRows>;

std::size_t count_of(const Descriptors& descriptors);
/// Size of one keyframe's descriptor in a route, bytes.
std::size_t bytes_of_each(const Descriptors& descriptors);

/// Those at `indices`, in that order. Throws `std::out_of_range` for an index past the end.
Descriptors select(const Descriptors& descriptors, std::span<const std::size_t> indices);

/// What a descriptor requires of the other stages.
struct DescriptorTraits {
  /// Largest shift of a view to either side without `--max-shift-px`, in columns of the descriptor or pixels
  /// of a thumbnail.
  int max_shift = 0;
  int columns = 0;                  ///< that a picture is divided into; 0 if it cannot be shifted
  double prior_queries = 0;         ///< `ContrastEnhancementOptions::prior_queries`
  Metric metric = Metric::kCosine;  ///< of `FloatRows`
  bool records_frames = false;      ///< `record` must be called for every frame
  int colour_width_px = 0;          ///< width of the colour pictures that `record` needs; 0: grey is enough
};

/// From keyframes to their descriptors.
using Describe = std::function<Descriptors(const KeyframeRecords&)>;

/// What keyframes are compared by.
///
/// Frames are seen once, before it is known which become keyframes, so there are three parts: `record` keeps
/// something compact of every frame; `learn` extracts from the keyframes of a route's first traverse what
/// needs a whole walk (a vocabulary, axes), which is stored in the route; a `describer` makes descriptors of
/// any walk's keyframes. To add a descriptor: a class like the others here, an entry in the table of
/// descriptor.cpp, and a test.
class Descriptor {
 public:
  virtual ~Descriptor() = default;

  [[nodiscard]] virtual DescriptorTraits traits() const = 0;

  /// What to keep of a frame. Called concurrently for frames of one walk.
  [[nodiscard]] virtual Bytes record(const vo::Frame& frame) const;

  /// What the descriptors of all walks on a route share. Throws `vo::Error` if the keyframes give nothing to
  /// learn from.
  [[nodiscard]] virtual Bytes learn(const KeyframeRecords& keyframes) const;

  /// Makes the descriptors of any walk's keyframes, the same bytes for any number of threads; it must not
  /// outlive the descriptor. `learned`: from `learn`, read once; throws `vo::Error` for other bytes.
  [[nodiscard]] virtual Describe describer(std::span<const std::uint8_t> learned) const = 0;

  /// The descriptors of one walk's keyframes.
  [[nodiscard]] Descriptors describe(const KeyframeRecords& keyframes,
                                     std::span<const std::uint8_t> learned) const {
    return describer(learned)(keyframes);
  }

  /// The form in which a route's or a walk's descriptors are compared: unchanged, unless the descriptor
  /// stores them differently.
  [[nodiscard]] virtual Descriptors comparable(const Descriptors& described) const;
};

/// The descriptors that keyframes are compared by, one or several.
using DescriptorSet = std::vector<std::unique_ptr<Descriptor>>;

/// The names of all descriptors, in the order in which help lists them.
std::vector<std::string> descriptor_names();

/// The descriptors with a name, or with several joined by '+', whose standardised matrices are summed. Throws
/// `vo::Error` for an unknown name.
std::shared_ptr<const DescriptorSet> make_descriptors(const DescriptorOptions& options);

}  // namespace place
