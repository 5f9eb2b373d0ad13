// A track: GPX, or CSV where it does not begin as XML does.
#include "fuzz.hpp"

#include <place/route/track.hpp>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto file = fuzz::write("track", {data, size});
  const auto read = [&](const place::TrackOptions& options) {
    return [&file, options] {
      const place::GeographicTrack track = place::read_track(file, options);
      const place::GeographicPoint& first = track.points.front();
      place::local_trajectory(track, {first.latitude_deg, first.longitude_deg});
    };
  };
  fuzz::call_one(size, {read({}), read({.track_name = "2"}),
                        read({.video_start_utc_s = 1.7e9, .video_duration_s = 60})});
  return 0;
}
