#include "place/route/track.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <fstream>
#include <initializer_list>
#include <pugixml.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vo/base/error.hpp>
#include <vo/base/iso_time.hpp>
#include <vo/io/csv.hpp>
#include <vo/io/frame_source.hpp>
#include <vo/io/picture_tags.hpp>
#include <vo/io/text_file.hpp>
#include <vo/io/time_unit.hpp>
#include <vo/io/video_positions.hpp>

namespace place {
namespace {

/// A point as in the file.
struct FilePoint {
  double time_s = 0;
  GeographicPoint place;
  std::size_t segment = 0;
};

/// One track of a file, and how much of it is unusable.
struct FileTrack {
  std::string name;
  std::vector<FilePoint> points;
  std::size_t all = 0, without_place = 0, without_time = 0, segments = 0;

  [[nodiscard]] double begin_s() const { return points.front().time_s; }
  [[nodiscard]] double end_s() const { return points.back().time_s; }
};

bool on_earth(const GeographicPoint& p) {
  return std::abs(p.latitude_deg) <= 89 && std::abs(p.longitude_deg) <= 360;
}

/// A node's name without the prefix of its name space.
std::string_view local_name(const pugi::xml_node& node) {
  const std::string_view name = node.name();
  return name.substr(name.rfind(':') + 1);
}

pugi::xml_node child(const pugi::xml_node& node, std::string_view name) {
  return node.find_child([&](const pugi::xml_node& n) { return local_name(n) == name; });
}

bool holds(const pugi::xml_node& node, std::string_view name) {
  return node.find_node([&](const pugi::xml_node& n) { return local_name(n) == name; });
}

void add_point(FileTrack& track, const pugi::xml_node& node) {
  ++track.all;
  const auto latitude = vo::parse_number(node.attribute("lat").value(), true);
  const auto longitude = vo::parse_number(node.attribute("lon").value(), true);
  // Receivers write 0, 0 before they know where they are.
  const bool nowhere = latitude == 0.0 && longitude == 0.0;
  if (!latitude || !longitude || nowhere || !on_earth({*latitude, *longitude})) {
    ++track.without_place;
    return;
  }
  const auto time_s = vo::parse_iso_time(vo::trimmed(child(node, "time").child_value()));
  if (!time_s) {
    ++track.without_time;
    return;
  }
  track.points.push_back({*time_s, {*latitude, *longitude}, track.segments});
}

FileTrack track_of(const pugi::xml_node& node, std::size_t number) {
  FileTrack track{.name = std::string(vo::trimmed(child(node, "name").child_value()))};
  if (track.name.empty()) track.name = std::to_string(number);
  for (const pugi::xml_node& segment : node) {
    if (local_name(segment) != "trkseg") continue;
    for (const pugi::xml_node& point : segment) {
      if (local_name(point) == "trkpt") add_point(track, point);
    }
    ++track.segments;
  }
  std::ranges::stable_sort(track.points, {}, &FilePoint::time_s);
  return track;
}

/// Seconds of a track that were recorded during the video.
double overlap_s(const FileTrack& track, const TrackOptions& options) {
  const double begin = *options.video_start_utc_s, end = begin + options.video_duration_s;
  return std::min(track.end_s(), end) - std::max(track.begin_s(), begin);
}

/// The track to read of several.
std::size_t chosen(const std::vector<FileTrack>& tracks, const TrackOptions& options, const std::string& path,
                   std::vector<std::string>& warnings) {
  std::vector<std::string> names;
  for (const FileTrack& track : tracks) names.push_back(fmt::format("'{}'", track.name));
  if (!options.track_name.empty()) {
    for (std::size_t i = 0; i < tracks.size(); ++i) {
      if (tracks[i].name == options.track_name) return i;
    }
    for (std::size_t i = 0; i < tracks.size(); ++i) {
      if (std::to_string(i + 1) == options.track_name) return i;
    }
    throw vo::Error(path, fmt::format("has no track '{}'", options.track_name),
                    fmt::format("one of {}", fmt::join(names, ", ")));
  }
  std::vector<std::size_t> usable;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    if (!tracks[i].points.empty()) usable.push_back(i);
  }
  if (usable.size() < 2) return usable.empty() ? 0 : usable[0];
  std::size_t best =
      *std::ranges::max_element(usable, {}, [&](std::size_t i) { return tracks[i].begin_s(); });
  std::string_view why = "the latest";
  if (options.video_start_utc_s) {
    const auto during =
        std::ranges::max_element(usable, {}, [&](std::size_t i) { return overlap_s(tracks[i], options); });
    if (overlap_s(tracks[*during], options) > 0) {
      best = *during;
      why = "recorded during the video";
    }
  }
  std::vector<std::string> shown;
  for (const std::size_t i : usable)
    shown.push_back(fmt::format("{} of {}", names[i], vo::iso_time(tracks[i].begin_s())));
  warnings.push_back(fmt::format("{}: has {} tracks ({}); {} is taken, {}; choose another by --track-name",
                                 path, usable.size(), fmt::join(shown, ", "), names[best], why));
  return best;
}

/// Points in order, each time once, and the number left out.
GeographicTrack in_order(const FileTrack& from, const std::string& path, std::vector<std::string> warnings) {
  GeographicTrack track{.warnings = std::move(warnings)};
  std::size_t doubled = 0;
  for (const FilePoint& point : from.points) {
    if (!track.time_s.empty() && point.time_s <= track.time_s.back()) {
      ++doubled;
      continue;
    }
    track.time_s.push_back(point.time_s);
    track.points.push_back(point.place);
    track.segment.push_back(point.segment);
  }
  const std::size_t left_out = from.without_place + from.without_time + doubled;
  if (track.points.size() < 2) {
    if (from.all > 0 && from.without_time == from.all)
      throw vo::Error(path, "has no times", "a recorded track, each point with a <time>");
    throw vo::Error(path, fmt::format("has {} usable points of {}", track.points.size(), from.all),
                    "a track of two points or more, each with a place and a time");
  }
  if (left_out > 0) {
    track.warnings.push_back(
        fmt::format("{}: {} of {} points are left out: {} without a place, {} without a time, {} at a time "
                    "that is there already",
                    path, left_out, from.all, from.without_place, from.without_time, doubled));
  }
  return track;
}

GeographicTrack read_gpx(const std::filesystem::path& file, const TrackOptions& options) {
  const std::string path = file.string();
  pugi::xml_document document;
  const pugi::xml_parse_result parsed = document.load_file(file.c_str());
  if (parsed.status == pugi::status_file_not_found || parsed.status == pugi::status_io_error)
    throw vo::Error(path, "cannot be read", "a GPX file");
  std::vector<FileTrack> tracks;
  std::vector<std::string> warnings;
  // Tracks at any depth: if a logger died, the end of the file is missing and the tree ends there.
  struct Finder : pugi::xml_tree_walker {
    bool for_each(pugi::xml_node& node) override {
      if (local_name(node) == "trk") found.push_back(node);
      return true;
    }
    std::vector<pugi::xml_node> found;
  };
  Finder finder;
  document.traverse(finder);
  tracks.reserve(finder.found.size());
  for (const pugi::xml_node& node : finder.found) tracks.push_back(track_of(node, tracks.size() + 1));
  if (tracks.empty()) {
    if (!parsed && !holds(document, "gpx"))
      throw vo::Error(path, fmt::format("is no XML: {}", parsed.description()), "a GPX file");
    if (holds(document, "rte")) throw vo::Error(path, "has a route and no track", "a recorded track (<trk>)");
    if (holds(document, "wpt"))
      throw vo::Error(path, "has waypoints and no track", "a recorded track (<trk>)");
    throw vo::Error(path, "has no track", "a recorded track (<trk>)");
  }
  if (!parsed) {
    warnings.push_back(fmt::format("{}: is cut off or broken ({}); what was read before is used", path,
                                   parsed.description()));
  }
  const std::size_t choice = chosen(tracks, options, path, warnings);
  GeographicTrack track = in_order(tracks[choice], path, std::move(warnings));
  constexpr double kDay_s = 86400;  // our own file without a start counts from 1970
  const double first_s = track.time_s.front() < kDay_s ? 0 : track.time_s.front();
  if (first_s > 0) track.start_utc_s = first_s;
  for (double& time_s : track.time_s) time_s -= first_s;
  return track;
}

/// Whether a file's text begins with a `<`, whatever it is called.
bool begins_as_xml(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  for (char c = 0; file.get(c);) {
    const bool mark = static_cast<unsigned char>(c) >= 0x80 || c == '\0';  // of an encoding
    if (!mark && std::isspace(static_cast<unsigned char>(c)) == 0) return c == '<';
  }
  return false;
}

/// Brings the times of a CSV file to seconds, and clocks that count from 1970 to its first point.
void take_seconds(GeographicTrack& track, const std::string& path) {
  double length_m = 0;
  for (std::size_t i = 1; i < track.points.size(); ++i) {
    const GeographicOrigin before{track.points[i - 1].latitude_deg, track.points[i - 1].longitude_deg};
    const vo::Pose2 step = local_at(before, track.points[i]);
    length_m += std::hypot(step.x_m, step.y_m);
  }
  const vo::TimeUnit unit = vo::time_unit(track.time_s, length_m);
  if (!unit.name.empty())
    track.warnings.push_back(fmt::format("{}: times in {}, converted to seconds", path, unit.name));
  for (double& time_s : track.time_s) time_s /= unit.per_second;
  constexpr double kSince1970_s = 1e9;
  if (track.time_s.front() < kSince1970_s) return;
  track.start_utc_s = track.time_s.front();
  for (double& time_s : track.time_s) time_s -= *track.start_utc_s;
}

/// The first of a column's names that the table has; the first of all if it has none.
std::string_view column(const vo::CsvTable& table, std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names)
    if (table.has(name)) return name;
  return *names.begin();
}

GeographicTrack read_csv(const std::filesystem::path& path, const TrackOptions& options) {
  if (!options.track_name.empty())
    throw vo::Error(path.string(), "is no GPX file",
                    "no --track-name, which chooses among a GPX file's tracks");
  const vo::CsvTable table = vo::CsvTable::read(path, vo::UnevenRows::kLeaveOut);
  const std::string_view time = column(table, {"time_s", "time", "timestamp"});
  const auto times = table.text(time);
  auto time_s = table.numbers_where_they_are(time);
  for (std::size_t i = 0; i < time_s.size(); ++i)
    if (!time_s[i]) time_s[i] = vo::parse_iso_time(times[i]);
  const auto latitude_deg =
      table.numbers_where_they_are(column(table, {"latitude_deg", "lat_deg", "latitude", "lat"}));
  const auto longitude_deg =
      table.numbers_where_they_are(column(table, {"longitude_deg", "lon_deg", "longitude", "lon", "lng"}));
  FileTrack track{.all = table.rows() + table.left_out(), .without_place = table.left_out()};
  for (std::size_t i = 0; i < table.rows(); ++i) {
    if (!latitude_deg[i] || !longitude_deg[i] || !on_earth({*latitude_deg[i], *longitude_deg[i]})) {
      ++track.without_place;
    } else if (!time_s[i]) {
      ++track.without_time;
    } else {
      track.points.push_back({*time_s[i], {*latitude_deg[i], *longitude_deg[i]}});
    }
  }
  std::ranges::stable_sort(track.points, {}, &FilePoint::time_s);
  GeographicTrack read = in_order(track, path.string(), {});
  take_seconds(read, path.string());
  return read;
}

/// The track that a camera recorded within its video.
GeographicTrack read_from_video(const std::filesystem::path& path, const TrackOptions& options) {
  if (!options.track_name.empty())
    throw vo::Error(path.string(), "is a video, which has one track", "no --track-name");
  const vo::VideoPositions recorded = vo::read_video_positions(path);
  FileTrack track{.all = recorded.positions.size() + recorded.without_fix,
                  .without_place = recorded.without_fix};
  for (const vo::RecordedPosition& p : recorded.positions) {
    const GeographicPoint place{p.latitude_deg, p.longitude_deg};
    if (on_earth(place)) {
      track.points.push_back({p.time_s, place});
    } else {
      ++track.without_place;
    }
  }
  std::vector<std::string> warnings;
  if (recorded.damaged > 0)
    warnings.push_back(fmt::format("{}: {} pieces of its GPS track are damaged and left out", path.string(),
                                   recorded.damaged));
  std::ranges::stable_sort(track.points, {}, &FilePoint::time_s);
  return in_order(track, path.string(), std::move(warnings));
}

/// The positions that a camera wrote into its pictures.
GeographicTrack read_from_pictures(const std::filesystem::path& path, const TrackOptions& options) {
  const std::string folder = path.string();
  if (!options.track_name.empty())
    throw vo::Error(folder, "is a folder of pictures, which is one track", "no --track-name");
  const std::vector<std::string> files = vo::image_files(folder);
  if (files.size() != options.picture_time_s.size()) {
    throw vo::Error(
        folder,
        fmt::format("has {} pictures, and the walk {} frames", files.size(), options.picture_time_s.size()),
        "the folder that the walk is read from, every picture readable");
  }
  FileTrack track{.all = files.size()};
  for (std::size_t i = 0; i < files.size(); ++i) {
    const auto position_deg = vo::read_picture_tags(files[i]).position_deg;
    const GeographicPoint place =
        position_deg ? GeographicPoint{position_deg->first, position_deg->second} : GeographicPoint{};
    if (position_deg && on_earth(place)) {
      track.points.push_back({options.picture_time_s[i], place});
    } else {
      ++track.without_place;
    }
  }
  return in_order(track, folder, {});
}

}  // namespace

GeographicTrack read_track(const std::filesystem::path& path, const TrackOptions& options) {
  std::error_code none;
  if (std::filesystem::is_directory(path, none)) return read_from_pictures(path, options);
  std::string extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
  constexpr std::array<std::string_view, 4> kVideos{".mp4", ".mov", ".lrv", ".360"};
  if (std::ranges::find(kVideos, extension) != kVideos.end()) return read_from_video(path, options);
  const bool xml = extension == ".gpx" || extension == ".xml" || begins_as_xml(path);
  return xml ? read_gpx(path, options) : read_csv(path, options);
}

vo::Trajectory local_trajectory(const GeographicTrack& track, const GeographicOrigin& origin,
                                double heading_m) {
  vo::Trajectory trajectory;
  for (std::size_t i = 0; i < track.points.size(); ++i)
    trajectory.push_back({track.time_s[i], local_at(origin, track.points[i])});
  vo::head_along_path(trajectory, heading_m);  // a segment of one point gets its heading from its neighbours
  for (std::size_t begin = 0; begin < track.segment.size();) {
    std::size_t end = begin + 1;
    while (end < track.segment.size() && track.segment[end] == track.segment[begin]) ++end;
    const auto at = [&](std::size_t i) { return trajectory.begin() + static_cast<std::ptrdiff_t>(i); };
    vo::Trajectory piece(at(begin), at(end));
    if (piece.size() > 1) vo::head_along_path(piece, heading_m);
    std::ranges::copy(piece, at(begin));
    begin = end;
  }
  return trajectory;
}

}  // namespace place
