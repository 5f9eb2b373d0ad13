#include "follow_page.hpp"

#include "json_file.hpp"
#include "report/chart.hpp"
#include "report/page.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <place/route/named_places.hpp>

namespace retrace {

using nlohmann::ordered_json;

std::vector<std::uint8_t> follow_picture(const vo::Frame& frame) {
  constexpr int kQuality = 75;  // as previews of a route
  const cv::Mat& image = frame.colour.empty() ? frame.image : frame.colour;
  const double scale = std::min(1.0, static_cast<double>(kFollowPicture_px) / image.cols);
  cv::Mat small;
  cv::resize(image, small, {}, scale, scale, cv::INTER_AREA);
  std::vector<std::uint8_t> jpeg;
  cv::imencode(".jpg", small, jpeg, {cv::IMWRITE_JPEG_QUALITY, kQuality});
  return jpeg;
}

std::size_t traverse_of(const place::FollowedPlace& at, const place::Route& route) {
  const auto found = std::ranges::find(route.traverses, at.traverse, &place::Traverse::name);
  if (found == route.traverses.end())
    throw std::invalid_argument("traverse_of: a place on a traverse of the route expected");
  return static_cast<std::size_t>(found - route.traverses.begin());
}

ordered_json player_route(const place::Route& route) {
  ordered_json spec{{"traverses", ordered_json::array()}, {"places", ordered_json::array()}};
  for (std::size_t t = 0; t < route.traverses.size(); ++t) {
    const place::Traverse& traverse = route.traverses[t];
    std::vector<double> x, y;
    for (const place::Keyframe& keyframe : traverse.keyframes) {
      x.push_back(keyframe.pose ? keyframe.pose->x_m : NAN);
      y.push_back(keyframe.pose ? keyframe.pose->y_m : NAN);
    }
    spec["traverses"].push_back({{"name", traverse.name}, {"x", rounded(x)}, {"y", rounded(y)}});
    for (const place::PlaceOnTraverse& named : place::places_on(route, t)) {
      if (named.traverse != t) continue;
      spec["places"].push_back({{"name", traverse.places[named.index].name},
                                {"traverse", t},
                                {"keyframe", std::lround(named.keyframe)}});
    }
  }
  return spec;
}

ordered_json player_moment(const place::Position& position, const std::vector<std::uint8_t>& jpeg,
                           const place::Route& route) {
  ordered_json json{{"frame", position.frame},
                    {"time_s", rounded(position.time_s)},
                    {"state", place::name_of(position.state)},
                    {"query", data_url(jpeg)}};
  if (!position.place) return json;
  const place::FollowedPlace& at = *position.place;
  json["traverse"] = traverse_of(at, route);
  json["keyframe"] = at.keyframe;
  json["reference_frame"] = at.reference_frame;
  json["probability"] = rounded(at.probability);
  json["sd_keyframes"] = rounded(at.sd_keyframes);
  if (at.distance_m) json["distance_m"] = rounded(*at.distance_m);
  if (at.sd_m) json["sd_m"] = rounded(*at.sd_m);
  if (at.pose) {
    json["x"] = rounded(at.pose->x_m);
    json["y"] = rounded(at.pose->y_m);
  }
  return json;
}

std::string player_text(const ordered_json& json) {
  return json_text(json);
}

}  // namespace retrace
