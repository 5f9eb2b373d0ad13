#include "follow_record.hpp"

#include "follow_page.hpp"
#include "report/page.hpp"

#include <map>
#include <optional>
#include <utility>

#include <nlohmann/json.hpp>

namespace retrace {
namespace {

using nlohmann::ordered_json;

constexpr std::size_t kMost = 600;  // 4 MB of pictures
constexpr double kSpeed = 2;        // of playing

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

}  // namespace

void FollowRecord::push(const place::Position& position, const vo::Frame& frame) {
  if (!moments_.empty() && position.time_s < moments_.back().position.time_s + interval_s_) return;
  moments_.push_back({position, follow_picture(frame)});
  if (moments_.size() < kMost) return;
  std::vector<Moment> half;
  for (std::size_t i = 0; i < moments_.size(); i += 2) half.push_back(std::move(moments_[i]));
  moments_ = std::move(half);
  interval_s_ *= 2;
}

std::string FollowRecord::page(const place::Route& route, const std::string& walk) const {
  References references(route);
  ordered_json spec = player_route(route);
  spec["speed"] = kSpeed;
  spec["samples"] = ordered_json::array();
  std::size_t on_route = 0;
  for (const Moment& moment : moments_) {
    ordered_json sample = player_moment(moment.position, moment.jpeg, route);
    if (const std::optional<place::FollowedPlace>& at = moment.position.place) {
      ++on_route;
      if (const auto number = references.number(traverse_of(*at, route), at->keyframe))
        sample["reference"] = *number;
    }
    spec["samples"].push_back(std::move(sample));
  }
  spec["references"] = references.urls();
  Page page("The walk as it was followed", walk == "-" ? "standard input" : walk);
  page.headlines({{"Moments", std::to_string(moments_.size()), "shown here"},
                  {"On the route", std::to_string(on_route), "of them"}});
  page.player(
      player_text(spec),
      "The disc holds 90 % of the probability along the route. Space plays and pauses, arrows go on and "
      "back. Every moment shows what was known then.");
  return page.html();
}

}  // namespace retrace
