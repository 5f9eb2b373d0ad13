#include "follow_lines.hpp"

#include "json_file.hpp"

#include <cmath>
#include <cstdio>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <vo/base/degrees.hpp>
#include <vo/base/error.hpp>

namespace retrace {
namespace {

using nlohmann::ordered_json;

double rounded_to(double value, double per_unit) {
  return std::round(value * per_unit) / per_unit;
}

constexpr double kMillimetres = 1000, kHundredths = 100, kTenThousandths = 1e4;

double heading_deg(double heading_rad) {
  return std::fmod(rounded_to(vo::compass_deg(heading_rad), kHundredths), 360);  // 359.996 is 0
}

void put_place(ordered_json& json, const place::FollowedPlace& place) {
  json["traverse"] = place.traverse;
  json["reference_frame"] = place.reference_frame;
  if (place.distance_m) json["distance_m"] = rounded_to(*place.distance_m, kMillimetres);
  if (place.sd_m) json["sd_m"] = rounded_to(*place.sd_m, kMillimetres);
  json["sd_keyframes"] = rounded_to(place.sd_keyframes, kMillimetres);
  json["probability"] = rounded_to(place.probability, kTenThousandths);
  if (!place.pose) return;
  json["x_m"] = rounded_to(place.pose->x_m, kMillimetres);
  json["y_m"] = rounded_to(place.pose->y_m, kMillimetres);
  json["heading_deg"] = heading_deg(place.pose->heading_rad);
}

}  // namespace

std::string follow_line(const place::Position& position) {
  ordered_json json{{"frame", position.frame},
                    {"time_s", rounded_to(position.time_s, kMillimetres)},
                    {"state", place::name_of(position.state)}};
  if (position.place) put_place(json, *position.place);
  if (position.lag_frame) {
    ordered_json earlier{{"frame", *position.lag_frame}};
    if (position.lag_place) put_place(earlier, *position.lag_place);
    json["lag"] = std::move(earlier);
  }
  return json_text(json);
}

std::string event_line(const place::FollowEvent& event) {
  ordered_json json{{"event", place::name_of(event.kind)},
                    {"frame", event.frame},
                    {"time_s", rounded_to(event.time_s, kMillimetres)}};
  if (!event.name.empty()) json["name"] = event.name;
  if (event.distance_m) json["distance_m"] = rounded_to(*event.distance_m, kHundredths);
  if (event.turn_deg) json["turn_deg"] = rounded_to(*event.turn_deg, 1);
  return json_text(json);
}

FollowLines::FollowLines(const std::filesystem::path& folder) : folder_(folder) {
  if (!folder_.empty()) file_.open(folder_ / "follow.jsonl");
}

void FollowLines::write(const std::string& line) {
  fmt::print("{}\n", line);
  std::fflush(stdout);
  if (!folder_.empty()) file_ << line << '\n';
}

void FollowLines::finish() {
  if (folder_.empty()) return;
  file_.close();
  if (!file_) throw vo::Error((folder_ / "follow.jsonl").string(), "cannot be written", "a disk with room");
}

}  // namespace retrace
