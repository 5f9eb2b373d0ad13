#include "sweep_axes.hpp"

#include <algorithm>

#include <fmt/format.h>

#include <vo/base/error.hpp>

namespace retrace {

void declare_swept(Arguments& arguments, SweepOptions& options) {
  const auto list = [&](const char* flag, std::vector<std::string>& values, const char* description) {
    arguments.option(flag, values, description).comma_separated().group("Swept");
  };
  list("--motion", options.motions, "sad, steps, hybrid, vo, none: what walks are resampled by");
  list("--sequence-length", options.lengths, "keyframes on a line [5,10,20,40; SSS 4.2]");
  list("--sequence-length-m", options.lengths_m, "metres on a line, instead; needs --reference-truth");
  list("--search-range-rad", options.ranges, "radians either side of pi/4 [SSS Fig. 8]");
  arguments.option("--vary", options.vary, "NAME=a,b,c: any further setting; may be repeated").group("Swept");
  list("--compare", options.compare, "swept settings whose values make the methods that are compared");
  arguments
      .flag("--equal-keyframes", options.equal_keyframes,
            "as many keyframes, within 5 %, in every cell as with none, or else as in the first cell")
      .group("Swept");
}

std::vector<place::SweepAxis> swept_axes(const SweepOptions& options) {
  const bool metres = !options.lengths_m.empty();
  if (metres && !options.lengths.empty())
    throw vo::Error("--sequence-length-m", "is given beside --sequence-length", "one of both");
  std::vector<std::string> lengths = metres ? options.lengths_m : options.lengths;
  if (lengths.empty()) lengths = {"5", "10", "20", "40"};
  std::vector<place::SweepAxis> axes{{"motion", options.motions},
                                     {metres ? "sequence-length-m" : "sequence-length", lengths},
                                     {"search-range-rad", options.ranges}};
  for (const std::string& text : options.vary) {
    axes.push_back(place::parse_axis(text));
    const auto same = std::ranges::find(axes, axes.back().setting, &place::SweepAxis::setting);
    if (same != axes.end() - 1)
      throw vo::Error("--vary " + text, "varies a setting twice",
                      fmt::format("one list of {}", same->setting));
  }
  return axes;
}

}  // namespace retrace
