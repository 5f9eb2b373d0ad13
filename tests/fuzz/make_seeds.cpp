// Writes what the fuzzers begin with: make_seeds FOLDER makes a folder for each target, of files as the
// project's own writers and other programs write them, and the dictionary of the settings' names.
#include "report/run_data.hpp"
#include "run_summary.hpp"
#include "settings_file.hpp"
#include "support/exif_pictures.hpp"

#include <cstdio>
#include <fstream>
#include <map>

#include <fmt/format.h>
#include <sqlite3.h>

#include <place/describe/npy.hpp>
#include <place/match/match_io.hpp>
#include <place/route/route_database.hpp>
#include <vo/io/trajectory_io.hpp>

namespace {

namespace fs = std::filesystem;

void put(const fs::path& path, const std::string& bytes) {
  fs::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << bytes;
}

/// report_data.json of a walk's odometry.
constexpr const char* kAlignment =
    R"({"alignment": {"end_s": 2, "seconds": [0.04, 0.08], "heat": "data:image/png;base64,AA",)"
    R"( "pictures": [{"picture": "data:image/png;base64,AA", "seconds": 0.04, "mean": 3, "most": 9}],)"
    R"( "course": {"time_s": [0, 1], "smoothed": [1, 1.2], "relative": [0.9, null], "limit": 1.1},)"
    R"( "high": [[0, 1]], "standing": [[1, 2]], "of_the_rest": {"seconds": [0, 0.04], "error": [0, 0.3]},)"
    R"( "of_all": {"seconds": [0, 0.04], "error": [0, 0.4]},)"
    R"( "relation": {"knot_error": [0], "knot_separation": [0], "error": [0, 1], "separation": [0, 1]}}})";

std::string contents(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Two short traverses with some of everything that a route may have.
place::Route small_route(bool full) {
  place::Route route;
  route.settings.motion = "none";
  route.settings.every = 3;
  route.unit = 0.5;
  route.metric = true;
  route.origin = {.latitude_deg = -33.85678, .longitude_deg = 151.21528};
  if (full) route.learned = {{1, 2, 250}, {7}};
  for (const char* name : {"day", "night"}) {
    place::Traverse& traverse = route.traverses.emplace_back();
    traverse.name = name;
    traverse.source = std::string(name) + ".mp4";
    traverse.frames = 30;
    traverse.duration_s = 1.2;
    traverse.frame_width_px = 640;
    traverse.frame_height_px = 360;
    traverse.pose_source = "truth.csv";
    traverse.settings.fov_deg = 64.4;
    constexpr std::size_t kKeyframes = 3;
    for (std::size_t i = 0; i < kKeyframes; ++i) {
      const auto k = static_cast<double>(i);
      traverse.keyframes.push_back({.frame = static_cast<std::int64_t>(10 * i),
                                    .time_s = 0.4 * k,
                                    .displacement = 0.5 * k,
                                    .distance_m = 0.5 * k,
                                    .pose = vo::Pose2{k, 2 * k, 0.1},
                                    .after_gap = i == 2,
                                    .preview_jpeg = {0xFF, 0xD8, 0xFF, 0xD9}});
      if (full) traverse.view_points.push_back({1, 2, 3});
    }
    if (!full) continue;
    traverse.places = {{"gate", 3, 0.25}, {"bridge", 20, {}}};
    traverse.thumbnails = vo::make_image_stack(4, 2, kKeyframes);
    traverse.descriptors = {vo::make_image_stack(4, 2, kKeyframes), place::make_float_rows(3, kKeyframes)};
  }
  return route;
}

/// The route's file with pages of 512 bytes, so that it is short.
std::string database_of(const place::Route& route, const fs::path& scratch) {
  fs::create_directories(scratch);
  const fs::path file = scratch / "seed.db";
  place::write_route(file, route);
  sqlite3* database = nullptr;
  const bool packed =
      sqlite3_open(file.c_str(), &database) == SQLITE_OK &&
      sqlite3_exec(database, "PRAGMA page_size = 512; VACUUM", nullptr, nullptr, nullptr) == SQLITE_OK;
  sqlite3_close(database);
  if (!packed) throw std::runtime_error("the route's file cannot be packed");
  std::string bytes = contents(file);
  fs::remove(file);
  return bytes;
}

std::vector<place::Match> some_matches() {
  const auto at = [](const char* traverse, std::int64_t frame) {
    return place::Place{.traverse = traverse, .frame = frame, .time_s = 0.04 * static_cast<double>(frame)};
  };
  return {{.query_frame = 0, .place = at("day", 0), .score = 1.5, .probability = 0.9, .accepted = true},
          {.query_frame = 12,
           .query_time_s = 0.4,
           .place = at("day", 10),
           .score = 2,
           .sd_m = 0.3,
           .yaw_rad = 0.1,
           .lateral_m = -0.5,
           .accepted = true},
          {.query_frame = 25, .query_time_s = 0.8, .place = at("night", 20), .score = 0.25},
          {.query_frame = 33, .query_time_s = 1.1}};
}

constexpr const char* kTruth =
    "frame,time_s,x_m,y_m,heading_deg,distance_m,steps\n0,0.0,0,0,90,0,0\n1,0.5,0.7,0,90,0.7,1\n"
    "2,1.0,,,,,\n3,1.5,2.1,0.1,89.5,2.1,3\n";
constexpr const char* kPairs = "query_frame,reference_frame\n0,0\n10,12.5\n20,30\n";
constexpr const char* kPlaces = "frame,name\n3,gate\n20,\"the \"\"old\"\" bridge\"\n";

constexpr const char* kTum =
    "# timestamp tx ty tz qx qy qz qw\n0.0 0 0 0 0 0 0 1\n0.1 0.1 0 0 0 0 0.1 0.99499\n"
    "0.2 0.2 0.01 0 0 0 0.2 0.9798\n";
constexpr const char* kKitti =
    "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 0.1 0 1 0 0 0 0 1 1\n1 0 0 0.2 0 1 0 0 0 0 1 2\n";
constexpr const char* kEuroc =
    "#timestamp, p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], q_RS_z []\n"
    "1403636580838555648,4.6,-1.7,0.7,0.5,-0.1,-0.8,-0.06\n1403636580843555328,4.6,-1.7,0.7,0.5,-0.1,-0.8,-0."
    "06\n";
constexpr const char* kHeadings = "time_s,x_m,y_m,heading_deg\n0,0,0,0\n0.1,0,0.5,5\n0.2,0.1,1,10\n";

constexpr const char* kGpx = R"(<?xml version="1.0" encoding="UTF-8"?>
<gpx version="1.1" xmlns="http://www.topografix.com/GPX/1/1"><wpt lat="1" lon="2"/>
<trk><name>one</name><trkseg>
<trkpt lat="48.1" lon="11.5"><ele>500</ele><time>2024-05-01T10:00:00Z</time></trkpt>
<trkpt lat="48.1001" lon="11.5001"><time>2024-05-01T10:00:01.5+02:00</time></trkpt></trkseg>
<trkseg><trkpt lat="48,2" lon="11,5"><time>2024-05-01T10:00:09Z</time></trkpt></trkseg></trk>
<trk><name>two &lt;&#228;</name><trkseg><trkpt lat="-33" lon="151"><time>1970-01-01T00:00:00Z</time></trkpt>
<trkpt lat="-33.1" lon="151"><time>1970-01-01T00:00:02Z</time></trkpt></trkseg></trk></gpx>
)";
constexpr const char* kTrackCsv =
    "time_s,lat_deg,lon_deg\n0,48.1,11.5\n1,48.1001,11.5\n2,,\n3,48.1003,11.5001\n";

const std::map<std::string, std::string> kCalibrations{
    {"opencv.yaml",
     "%YAML:1.0\n---\nimage_width: 640\nimage_height: 480\ncamera_matrix: !!opencv-matrix\n   rows: 3\n"
     "   cols: 3\n   dt: d\n   data: [ 500., 0., 320., 0., 500., 240., 0., 0., 1. ]\n"
     "distortion_coefficients: !!opencv-matrix\n   rows: 1\n   cols: 5\n   dt: d\n"
     "   data: [ 0.1, -0.2,\n       0., 0., 0.01 ]\n"},
    {"ros.yaml",
     "image_width: 640\nimage_height: 480\ncamera_name: chest\ncamera_matrix:\n  rows: 3\n  cols: 3\n"
     "  data: [500, 0, 320, 0, 500, 240, 0, 0, 1]\ndistortion_model: plumb_bob\n"
     "distortion_coefficients:\n  rows: 1\n  cols: 5\n  data: [0.1, -0.2, 0, 0, 0]\n"},
    {"kalibr.yaml",
     "cam0:\n  camera_model: pinhole\n  intrinsics: [500, 500, 320, 240]\n"
     "  distortion_model: equidistant\n  distortion_coeffs: [0.1, 0.01, 0, 0]\n  resolution: [640, 480]\n"},
    {"orb.yaml",
     "Camera.type: \"PinHole\"\nCamera.fx: 500.0\nCamera.fy: 500.0\nCamera.cx: 320.0\nCamera.cy: 240.0\n"
     "Camera.k1: 0.1\nCamera.k2: 0.0\nCamera.p1: 0.0\nCamera.p2: 0.0\nCamera.width: 640\nCamera.height: "
     "480\n"},
    {"sensor.yaml",
     "sensor_type: camera\nresolution: [752, 480]\ncamera_model: pinhole\n"
     "intrinsics: [458.6, 457.2, 367.2, 248.3] #fu, fv, cu, cv\ndistortion_model: radial-tangential\n"
     "distortion_coefficients:\n  - -0.28\n  - 0.07\n  - 0.0001\n  - 0.00001\n"},
    {"opencv.xml",
     "<?xml version=\"1.0\"?>\n<opencv_storage>\n<image_width>640</image_width>\n"
     "<image_height>480</image_height>\n<camera_matrix type_id=\"opencv-matrix\"><rows>3</rows><cols>3</cols>"
     "<dt>d</dt><data>500. 0. 320. 0. 500. 240. 0. 0. 1.</data></camera_matrix>\n"
     "<distortion_coefficients type_id=\"opencv-matrix\"><rows>1</rows><cols>4</cols><dt>d</dt>"
     "<data>0.1 0. 0. 0.</data></distortion_coefficients>\n</opencv_storage>\n"},
    {"opencv.json",
     "{\n  \"image_width\": 640, \"image_height\": 480,\n  \"camera_matrix\": {\"type_id\": "
     "\"opencv-matrix\", \"rows\": 3, \"cols\": 3, \"dt\": \"d\",\n    \"data\": [500.0, 0.0, 320.0, 0.0, "
     "500.0, 240.0, 0.0, 0.0, 1.0]}\n}\n"}};

constexpr const char* kReportData =
    R"({"motion":"steps","unit":0.5,"query":{"frame":[0,12,25,33],"time_s":[0,0.4,0.8,1.1],"displacement":[0,0.5,1,1.5]},)"
    R"("traverses":[{"name":"day","frame":[0,10,20],"time_s":[0,0.4,0.8],"displacement":[0,0.5,1],"distance_m":[0,0.5,1],)"
    R"("x_m":[0,1,2],"y_m":[0,null,1],"pictures":{"enhanced":"data:image/png;base64,AA==","raw":"data:image/png;base64,AA=="}},)"
    R"({"name":"night","frame":[0,10,20],"time_s":[],"displacement":[0,0.5,1],"distance_m":[],"x_m":[],"y_m":[],"pictures":{}}],)"
    R"("pairs":[{"keyframe":0,"query":"data:image/jpeg;base64,AA==","reference":"data:image/jpeg;base64,AA=="},{"keyframe":1}]})";
constexpr const char* kSummary =
    R"({"query":"night.mp4","route":"route.db","queries":4,"query_frames":40,"matched":3,"accepted":2,"partial":1,)"
    R"("partial_accepted":0,"sequence_length":5,"accept_score":1.5,"accept_probability":null,"relative_scale":1.02,)"
    R"("query_start_utc_s":1714557600.5,"query_frames_after_gaps":[25],"warnings":["a <b> warning"]})";

constexpr const char* kOdometrySummary =
    R"({"walk":"night.mp4","step_signal":"orientation","unit":"m","delta_min":0.5,"distance":12.5,"step_length_m":0.7,)"
    R"("duration_s":9.5,"frames":240,"frames_bridged":3,"steps_bridged":1,"warnings":["a <b> warning"]})";
constexpr const char* kFrames =
    "frame,time_s,displacement,unit,source,orientation_deg,dx_px,matches,heading_deg,step_signal,step_"
    "threshold,reliable,"
    "vo_displacement,sad_displacement\n0,0,0,m,steps,0,0,0,0,0,0.5,0,,\n1,0.5,0.1,m,vo,1.5,2,90,1,0.7,0.5,1,"
    "0.1,0.2\n"
    "2,1,0.1,m,held,-1.5,-2,80,2,-0.7,0.5,0,,0.1\n";
constexpr const char* kSteps =
    "step,frame,time_s,leg,x_m,y_m,heading_deg,bridged\n1,1,0.5,left,0,0.7,0,0\n2,2,1,right,0,1.4,1,1\n";
constexpr const char* kActivity =
    "time_s,activity,amplitude_deg,step_hz\n0,standing,0.1,0\n1,walking,1.5,1.8\n2,walking,1.4,1.9\n";

std::string y4m(const std::string& header, const std::string& frame_header, std::size_t bytes) {
  return "YUV4MPEG2 " + header + "\n" + frame_header + "\n" + std::string(bytes, '\x80') + frame_header +
         "\n" + std::string(bytes, '\x20');
}

void make_settings(const fs::path& folder) {
  place::Settings some;
  some.motion = "steps";
  some.every = 2;
  some.fov_deg = 64.4;
  some.crop = "0,0,640,300";
  put(folder / "settings/some.toml", retrace::to_toml(some));
  put(folder / "settings/short.toml",
      "[search]\n\n# a comment\nevery = 3\nmotion = 'none'  # why\nmask = \"a.png\"\n");
  put(folder / "settings/lists.toml", "every = [1, 2]\nfov-deg = 1e2\n\"motion\" = \"none\"\n");
  std::string dictionary;
  for (const place::Setting& setting : place::settings_table()) {
    dictionary += fmt::format("\"{} = \"\n", setting.name);
    if (!setting.choices.empty())
      dictionary += fmt::format("\"{}\"\n", setting.choices.substr(0, setting.choices.find('|')));
  }
  put(folder / "settings.dict", dictionary);
}

void make_all(const fs::path& folder) {
  put(folder / "route_database/full.db", database_of(small_route(true), folder));
  put(folder / "route_database/plain.db", database_of(small_route(false), folder));
  make_settings(folder);
  put(folder / "truth/truth.csv", kTruth);
  put(folder / "truth/pairs.csv", kPairs);
  put(folder / "truth/places.csv", kPlaces);
  put(folder / "truth/semicolons.csv",
      "sep=;\nframe;distance_m;time_s;x_m;y_m;heading_deg\n0;0,5;0;1,5;2;3\n");
  put(folder / "poses/tum", kTum);
  put(folder / "poses/kitti", std::string(kKitti) + "%%\n0\n0.1\n0.2\n");
  put(folder / "poses/euroc.csv", kEuroc);
  put(folder / "poses/headings.csv", kHeadings);
  put(folder / "track/two.gpx", kGpx);
  put(folder / "track/track.csv", kTrackCsv);
  for (const auto& [name, text] : kCalibrations) put(folder / "calibration" / name, text);
  const std::string matches = place::to_csv(some_matches());
  const std::string config = "every = 3\nmotion = \"none\"\n# fov-deg = 64.4\n";
  put(folder / "run/whole", matches + "%%\n" + config + "%%\n" + kSummary);
  put(folder / "report/whole",
      matches + "%%\n" + kReportData + "\n%%\n" + kSummary + "\n%%\n" + config + "%%\n" + kTum);
  put(folder / "report/alone", matches);
  place::FloatRows rows = place::make_float_rows(3, 2);
  rows.values = {1, -2.5F, 1e30F, 0, 0.1F, 7};
  put(folder / "odometry_report/whole", std::string(kTum) + "%%\n" + kOdometrySummary + "\n%%\n" + kFrames +
                                            "%%\n" + kSteps + "%%\n" + kActivity + "%%\n" + kAlignment);
  put(folder / "odometry_report/alone", kTum);
  put(folder / "npy/kept", "");  // so that the folder is there
  place::write_npy(folder / "npy/floats", rows);
  place::write_npy(folder / "npy/bytes",
                   std::span<const std::uint8_t>(std::vector<std::uint8_t>{1, 2, 3, 255}), 2);
  place::write_npy(folder / "npy/signed",
                   std::span<const std::int8_t>(std::vector<std::int8_t>{1, -2, 3, -128}), 2);
  put(folder / "gpmf/gps5", test_support::gps5_piece({{48.1, 11.5}, {-33.9, 151.2}}));
  const std::string gps9 =
      test_support::gpmf_entry("SCAL", 'l', 4, test_support::big_endian(10000000, 4)) +
      test_support::gpmf_entry("GPS9", '?', 32, std::string(30, '\x11') + std::string("\0\3", 2));
  put(folder / "gpmf/gps9", test_support::gpmf_container("DEVC", test_support::gpmf_container("STRM", gps9)));
  put(folder / "gpmf/accl", test_support::accl_piece({{0.5, -9.75, 2}, {0, 0, -1.25}}));
  fs::create_directories(folder / "exif");
  test_support::write_exif_picture(
      folder / "exif/whole", cv::Mat(4, 4, CV_8UC1, cv::Scalar(90)),
      {.time = "2024:05:31 14:00:00", .fraction = "25", .zone = "+02:00", .position_deg = {{48.1, 11.5}}});
  put(folder / "pairs/two.toml",
      "[park]\nquery = [\"a.mp4\", \"b.mp4\"]\nreference = \"c.mp4\"\npairs = \"p.csv\"\n"
      "tolerance-frames = 17\n\n[street]\nquery = \"d\"\nreference = \"e\"\nquery-truth = \"q.csv\"\n"
      "reference-truth = \"r.csv\"\ntolerance-m = 4.5\n");
  put(folder / "y4m/420", y4m("W8 H6 F25:1 Ip A1:1 C420jpeg XYSCSS=420JPEG", "FRAME", 72));
  put(folder / "y4m/mono", y4m("W6 H4 F30000:1001 Ip A0:0 Cmono", "FRAME Ip", 24));
  put(folder / "y4m/deep", y4m("W4 H4 F25:1 Ip A4:3 C444p10", "FRAME", 96));
}

}  // namespace

int main(int, char** arguments) {
  try {
    make_all(arguments[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "make_seeds: %s\n", error.what());
    return 1;
  }
  return 0;
}
