#include "follow_view.hpp"

#include "follow_lines.hpp"
#include "follow_page.hpp"
#include "report/page.hpp"

#include <charconv>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace retrace {
namespace {

constexpr std::chrono::milliseconds kBetween(100);
constexpr double kShown_s = 6;  // of what was announced
constexpr std::string_view kReferences = "/references/";

std::string view_page(const place::Route& route, const std::string& walk) {
  nlohmann::ordered_json spec = player_route(route);
  spec["live"] = true;
  spec["speed"] = 2;
  spec["samples"] = nlohmann::ordered_json::array();
  Page page("Where the walk is now", walk == "-" ? "standard input" : walk);
  page.player(player_text(spec),
              "The disc holds 90 % of the probability along the route. Arrows go back over the last minutes "
              "and on, End to what is now.");
  return page.html();
}

/// Takes a number off the front of a text.
std::optional<std::size_t> number_at(std::string_view& text) {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc()) return {};
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return number;
}

}  // namespace

void declare_view(Arguments& arguments, FollowViewOptions& options) {
  const Argument view =
      arguments
          .option("--view", options.port,
                  "port at which this machine's browser sees the walk; 0: any, which is printed")
          .range(0, 65535);
  arguments
      .option("--view-address", options.address,
              "address to serve the page at; another than the default is for others to see it too")
      .needs(view);
}

FollowView::FollowView(const place::Route& route, const std::string& walk, const FollowViewOptions& options)
    : route_(route),
      page_(view_page(route, walk)),
      server_(options.address, static_cast<int>(options.port.value()),
              [this](const std::string& path) { return file(path); }) {}

/// The page, or the picture of a keyframe: /references/TRAVERSE/KEYFRAME.jpg.
std::optional<ServedFile> FollowView::file(const std::string& path) const {
  if (path == "/") return ServedFile{"text/html; charset=utf-8", page_};
  if (!path.starts_with(kReferences)) return {};
  std::string_view rest = std::string_view(path).substr(kReferences.size());
  const std::optional<std::size_t> traverse = number_at(rest);
  if (!traverse || *traverse >= route_.traverses.size() || !rest.starts_with('/')) return {};
  rest.remove_prefix(1);
  const std::optional<std::size_t> keyframe = number_at(rest);
  const std::vector<place::Keyframe>& keyframes = route_.traverses[*traverse].keyframes;
  if (!keyframe || *keyframe >= keyframes.size() || rest != ".jpg") return {};
  const std::vector<std::uint8_t>& jpeg = keyframes[*keyframe].preview_jpeg;
  if (jpeg.empty()) return {};
  return ServedFile{"image/jpeg", {reinterpret_cast<const char*>(jpeg.data()), jpeg.size()}};
}

void FollowView::push(const place::Position& position, const vo::Frame& frame,
                      const std::vector<place::FollowEvent>& events) {
  if (!events.empty()) said_ = events.back();
  const auto now = std::chrono::steady_clock::now();
  if (!server_.anyone() || (sent_ && now < *sent_ + kBetween)) return;
  sent_ = now;
  nlohmann::ordered_json moment = player_moment(position, follow_picture(frame), route_);
  if (const std::optional<place::FollowedPlace>& at = position.place) {
    const std::size_t traverse = traverse_of(*at, route_);
    if (!route_.traverses[traverse].keyframes[at->keyframe].preview_jpeg.empty())
      moment["reference"] = fmt::format("references/{}/{}.jpg", traverse, at->keyframe);
  }
  if (said_ && position.time_s < said_->time_s + kShown_s)
    moment["said"] = nlohmann::ordered_json::parse(event_line(*said_));
  server_.publish(player_text(moment));
}

}  // namespace retrace
