#include "route_settings.hpp"

#include <fmt/format.h>

#include <vo/base/error.hpp>

namespace retrace {
namespace {

template <typename T>
void take(const CLI::App& app, const std::string& path, const std::string& option, const T& of_route,
          T& of_user) {
  if (given(app, option) && of_user != of_route) {
    if constexpr (std::is_enum_v<T>) {
      throw vo::Error(path, fmt::format("was built with another {}", option), "the same, or leave it out");
    } else {
      throw vo::Error(path, fmt::format("was built with {} {}, not {}", option, of_route, of_user),
                      "the same, or leave it out");
    }
  }
  of_user = of_route;
}

}  // namespace

void take_from_route(const CLI::App& app, const std::string& path, const place::Route& route,
                     Settings& settings) {
  take(app, path, "--thumbnail-width", route.thumbnail.width, settings.walk.thumbnail.width);
  take(app, path, "--thumbnail-height", route.thumbnail.height, settings.walk.thumbnail.height);
  take(app, path, "--patch-px", route.patch.patch_px, settings.patch.patch_px);
  take(app, path, "--patch-shape", route.patch.shape, settings.patch.shape);
  take(app, path, "--patch-min-deviation", route.patch.min_deviation, settings.patch.min_deviation);
  take(app, path, "--patch-min-contrast", route.patch.min_contrast, settings.patch.min_contrast);

  place::Sampling& sampling = settings.sampling.sampling;
  if (!given(app, "--motion")) sampling.motion = route.sampling.motion;
  if (!given(app, "--every")) sampling.every = route.sampling.every;
  if (!given(app, "--sampling-n")) {
    sampling.n = route.sampling.n;
    sampling.unit = route.sampling.unit;
  } else if (route.sampling.unit > 0) {
    sampling.unit = route.sampling.unit / route.sampling.n * sampling.n;  // Eq. 4 is linear in n
  }
  if (sampling.motion != vo::MotionSource::kNone && sampling.motion != route.sampling.motion) {
    throw vo::Error(path,
                    fmt::format("was sampled with --motion {}, which has another unit than --motion {}",
                                name_of(route.sampling.motion), name_of(sampling.motion)),
                    "the same, or leave it out");
  }
  follow_motion(settings);
}

place::Route new_route(const Settings& settings) {
  place::Route route;
  route.thumbnail = settings.walk.thumbnail;
  route.patch = settings.patch;
  route.sampling = settings.sampling.sampling;
  return route;
}

}  // namespace retrace
