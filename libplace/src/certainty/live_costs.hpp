#pragma once

#include "place/describe/descriptor.hpp"
#include "place/route/route.hpp"
#include "place/stage_options.hpp"

#include <memory>
#include <vector>

#include <vo/image/image_stack.hpp>
#include <vo/io/frame_source.hpp>

namespace place {

/// The enhanced costs of one picture after another against all keyframes of a route: the row of a cost matrix
/// that comes while walking. As `enhance_contrast` by `kStandardise`, but that a keyframe's mean and variance
/// are over the pictures up to now, and over keyframes of the route that stand for the first of them.
class LiveCosts {
 public:
  /// Keeps a reference to the route. Throws `vo::Error` if its descriptors come from a file.
  LiveCosts(const Route& route, const StageOptions& options);

  /// `thumbnail`: of the frame. Costs of all traverses' keyframes, one traverse after another. O(keyframes).
  std::vector<float> against(const vo::Frame& frame, const vo::ImageStack& thumbnail);

 private:
  /// Of one keyframe of the route, over pictures.
  struct Usual {
    double count = 0, sum = 0, squares = 0;
  };

  [[nodiscard]] std::vector<float> row(std::size_t traverse, const std::vector<Descriptors>& query) const;
  void see(std::size_t traverse, std::span<const float> row, double weight);

  const Route& route_;
  std::shared_ptr<const DescriptorSet> descriptors_;
  std::vector<Describe> describe_;  // by descriptor
  std::optional<int> max_shift_px_;
  std::vector<std::vector<Descriptors>> references_;  // by traverse and descriptor, comparable
  std::vector<std::vector<Usual>> usual_;             // by traverse and keyframe
};

}  // namespace place
