#include "follow_record.hpp"

#include "report/chart.hpp"
#include "report/page.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <place/route/named_places.hpp>

namespace retrace {
namespace {

using nlohmann::ordered_json;

constexpr std::size_t kMost = 600;  // 4 MB of pictures
constexpr double kSpeed = 2;        // of playing

std::vector<std::uint8_t> small_jpeg(const vo::Frame& frame) {
  constexpr int kWidth_px = 160, kQuality = 75;  // as previews of a route
  const cv::Mat& image = frame.colour.empty() ? frame.image : frame.colour;
  const double scale = std::min(1.0, static_cast<double>(kWidth_px) / image.cols);
  cv::Mat small;
  cv::resize(image, small, {}, scale, scale, cv::INTER_AREA);
  std::vector<std::uint8_t> jpeg;
  cv::imencode(".jpg", small, jpeg, {cv::IMWRITE_JPEG_QUALITY, kQuality});
  return jpeg;
}

ordered_json traverse_json(const place::Traverse& traverse) {
  std::vector<double> x, y;
  for (const place::Keyframe& keyframe : traverse.keyframes) {
    x.push_back(keyframe.pose ? keyframe.pose->x_m : NAN);
    y.push_back(keyframe.pose ? keyframe.pose->y_m : NAN);
  }
  return {{"name", traverse.name}, {"x", rounded(x)}, {"y", rounded(y)}};
}

/// Pictures of the route that moments show, each once.
class References {
 public:
  explicit References(const place::Route& route) : route_(route) {}

  std::optional<std::size_t> number(std::size_t traverse, std::size_t keyframe) {
    const std::vector<std::uint8_t>& jpeg = route_.traverses[traverse].keyframes[keyframe].preview_jpeg;
    if (jpeg.empty()) return {};
    const auto [entry, added] = numbers_.try_emplace({traverse, keyframe}, urls_.size());
    if (added) urls_.push_back(data_url(jpeg));
    return entry->second;
  }
  [[nodiscard]] const ordered_json& urls() const { return urls_; }

 private:
  const place::Route& route_;
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> numbers_;
  ordered_json urls_ = ordered_json::array();
};

ordered_json moment_json(const FollowRecord::Moment& moment, const place::Route& route,
                         References& references) {
  const place::Position& position = moment.position;
  ordered_json json{{"frame", position.frame},
                    {"time_s", rounded(position.time_s)},
                    {"state", place::name_of(position.state)},
                    {"query", data_url(moment.jpeg)}};
  if (!position.place) return json;
  const place::FollowedPlace& at = *position.place;
  const auto traverse = static_cast<std::size_t>(
      std::ranges::find(route.traverses, at.traverse, &place::Traverse::name) - route.traverses.begin());
  json["traverse"] = traverse;
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
  if (const auto number = references.number(traverse, at.keyframe)) json["reference"] = *number;
  return json;
}

}  // namespace

void FollowRecord::push(const place::Position& position, const vo::Frame& frame) {
  if (!moments_.empty() && position.time_s < moments_.back().position.time_s + interval_s_) return;
  moments_.push_back({position, small_jpeg(frame)});
  if (moments_.size() < kMost) return;
  std::vector<Moment> half;
  for (std::size_t i = 0; i < moments_.size(); i += 2) half.push_back(std::move(moments_[i]));
  moments_ = std::move(half);
  interval_s_ *= 2;
}

std::string FollowRecord::page(const place::Route& route, const std::string& walk) const {
  References references(route);
  ordered_json spec{{"speed", kSpeed},
                    {"traverses", ordered_json::array()},
                    {"places", ordered_json::array()},
                    {"samples", ordered_json::array()}};
  for (std::size_t t = 0; t < route.traverses.size(); ++t) {
    spec["traverses"].push_back(traverse_json(route.traverses[t]));
    for (const place::PlaceOnTraverse& place : place::places_on(route, t)) {
      if (place.traverse != t) continue;
      spec["places"].push_back({{"name", route.traverses[t].places[place.index].name},
                                {"traverse", t},
                                {"keyframe", std::lround(place.keyframe)}});
    }
  }
  std::size_t on_route = 0;
  for (const Moment& moment : moments_) {
    on_route += moment.position.place ? 1 : 0;
    spec["samples"].push_back(moment_json(moment, route, references));
  }
  spec["references"] = references.urls();
  Page page("The walk as it was followed", walk);
  page.headlines({{"Moments", std::to_string(moments_.size()), "shown here"},
                  {"On the route", std::to_string(on_route), "of them"}});
  page.player(
      spec.dump(-1, ' ', false, ordered_json::error_handler_t::replace),
      "The disc holds 90 % of the probability along the route. Space plays and pauses, arrows go on and "
      "back. Every moment shows what was known then.");
  return page.html();
}

}  // namespace retrace
