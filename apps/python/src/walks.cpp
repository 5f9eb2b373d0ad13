#include "arrays.hpp"
#include "bindings.hpp"
#include "settings_arguments.hpp"
#include "shared_route.hpp"
#include "unlocked.hpp"

#include <memory>
#include <numbers>
#include <optional>
#include <pybind11/stl.h>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <place/place.hpp>
#include <place/route/survey.hpp>
#include <place/stage_options.hpp>
#include <vo/io/trajectory_io.hpp>
#include <vo/motion/walk_motion.hpp>

namespace retrace_python {
namespace {

using Sources = std::variant<std::string, std::vector<std::string>>;

std::vector<std::string> list_of(const Sources& sources) {
  if (const auto* one = std::get_if<std::string>(&sources)) return {*one};
  return std::get<std::vector<std::string>>(sources);
}

/// A trajectory as arrays.
py::dict as_dict(const vo::Trajectory& trajectory) {
  py::dict result;
  result["time_s"] = array_of<double>(trajectory, [](const auto& p) { return p.time_s; });
  result["x_m"] = array_of<double>(trajectory, [](const auto& p) { return p.pose.x_m; });
  result["y_m"] = array_of<double>(trajectory, [](const auto& p) { return p.pose.y_m; });
  result["heading_deg"] =
      array_of<double>(trajectory, [](const auto& p) { return p.pose.heading_rad * 180 / std::numbers::pi; });
  return result;
}

vo::Walk read_walk(const Sources& sources, const SharedRoute* shared, const py::object& progress,
                   const py::kwargs& arguments) {
  const std::shared_ptr<const place::Route> route = shared == nullptr ? nullptr : shared->now;
  const place::Settings settings = settings_of(arguments);
  const std::vector<std::string> files = list_of(sources);
  const vo::ProgressCallback callback = progress_of(progress);
  return unlocked([&] {
    return route == nullptr ? place::read(files, settings, callback)
                            : place::read(files, *route, settings, callback);
  });
}

py::array_t<std::uint8_t> thumbnails_of(const vo::Walk& walk) {
  const vo::ImageStack& stack = walk.thumbnails;
  py::array_t<std::uint8_t> array({static_cast<py::ssize_t>(stack.size()),
                                   static_cast<py::ssize_t>(stack.height),
                                   static_cast<py::ssize_t>(stack.width)});
  std::copy(stack.pixels.begin(), stack.pixels.end(), array.mutable_data());
  return array;
}

std::vector<std::string> add(SharedRoute& shared, const std::string& name, const vo::Walk& walk,
                             const std::string& truth, const std::string& trajectory,
                             const std::string& track, bool replace, const py::kwargs& arguments) {
  place::Settings settings = settings_of(arguments);
  if ((truth.empty() ? 0 : 1) + (trajectory.empty() ? 0 : 1) + (track.empty() ? 0 : 1) > 1)
    throw py::value_error("one of truth, trajectory and track expected");
  const std::shared_ptr<const place::Route> before = shared.now;
  std::shared_ptr<place::Route> next;
  std::vector<std::string> warnings;
  unlocked([&] {
    next = std::make_shared<place::Route>(*before);
    const place::SurveyOptions form = place::survey_options(settings);
    std::optional<place::Survey> survey;
    if (!truth.empty()) survey = place::survey_from_truth(truth, walk);
    if (!trajectory.empty()) survey = place::survey_from_trajectory(trajectory, walk, form);
    if (!track.empty()) survey = place::survey_from_track(track, walk, *next, form);
    if (survey) warnings = survey->warnings;
    settings = place::settings_beside_survey(std::move(settings), !trajectory.empty(), !track.empty(),
                                             next->settings.motion);
    const place::AddedTraverse added = place::add(*next, name, walk, survey, settings, replace);
    warnings.insert(warnings.end(), added.warnings.begin(), added.warnings.end());
  });
  if (shared.now != before) throw py::value_error("Route.add: another thread added to it meanwhile");
  shared.now = next;
  return warnings;
}

/// A route of one walk.
SharedRoute build(const Sources& source, const std::string& name, const std::string& truth,
                  const std::string& trajectory, const std::string& track, const py::object& progress,
                  const py::kwargs& arguments) {
  const place::Settings of_walk = place::settings_beside_survey(settings_of(arguments), !trajectory.empty(),
                                                                !track.empty(), std::nullopt);
  const std::vector<std::string> files = list_of(source);
  const vo::ProgressCallback callback = progress_of(progress);
  SharedRoute route{std::make_shared<const place::Route>(place::new_route(of_walk))};
  const vo::Walk walk = unlocked([&] { return place::read(files, of_walk, callback); });
  add(route, name, walk, truth, trajectory, track, false, arguments);
  return route;
}

py::list traverses_of(const SharedRoute& shared) {
  const place::Route& route = *shared.now;
  py::list all;
  for (const place::Traverse& traverse : route.traverses) {
    const auto& keyframes = traverse.keyframes;
    py::dict one;
    one["name"] = traverse.name;
    one["source"] = traverse.source;
    one["frame"] = array_of<std::int64_t>(keyframes, [](const auto& k) { return k.frame; });
    one["time_s"] = array_of<double>(keyframes, [](const auto& k) { return k.time_s; });
    one["distance_m"] = array_of<double>(keyframes, [](const auto& k) { return or_nan(k.distance_m); });
    all.append(one);
  }
  return all;
}

place::Run localise(const SharedRoute& shared, const vo::Walk& walk, const py::kwargs& arguments) {
  const place::Settings settings = settings_of(arguments);
  const std::shared_ptr<const place::Route> route = shared.now;
  return unlocked([&] { return place::localise(*route, walk, settings); });
}

/// What `odometry` found.
struct Odometry {
  vo::Walk walk;
  vo::WalkMotion motion;
};

Odometry odometry(const Sources& sources, const py::object& progress, const py::kwargs& arguments) {
  const place::Settings settings = settings_of(arguments);
  const std::vector<std::string> files = list_of(sources);
  const vo::ProgressCallback callback = progress_of(progress);
  return unlocked([&] {
    place::StageOptions stages =
        place::stage_options(place::resolve(settings, {.purpose = place::Purpose::kOdometry}), true);
    stages.walk.preview_width_px = 0;
    Odometry result;
    result.walk = vo::read_walk(files, stages.walk, callback);
    result.motion = vo::motion_with_steps(result.walk, stages.sampling.source, stages.sampling.motion);
    return result;
  });
}

py::dict steps_of(const Odometry& odometry) {
  const std::vector<vo::Step>& steps = odometry.motion.pedestrian->detection.steps;
  py::dict result;
  result["frame"] =
      array_of<std::int64_t>(steps, [](const auto& s) { return static_cast<std::int64_t>(s.frame); });
  result["time_s"] = array_of<double>(steps, [](const auto& s) { return s.time_s; });
  result["left"] = array_of<bool>(steps, [](const auto& s) { return s.leg == vo::Leg::kLeft; });
  return result;
}

}  // namespace

void bind_walks(py::module_& module) {
  py::class_<vo::Walk>(module, "Walk", "What one pass over a recording kept of it.")
      .def_readonly("source", &vo::Walk::source)
      .def_property_readonly("frames", &vo::Walk::frames)
      .def_property_readonly(
          "time_s", [](const vo::Walk& w) { return array_of(w.time_s); },
          "float64 (frames,), seconds since the first")
      .def_property_readonly("thumbnails", &thumbnails_of, "uint8 (frames, height, width)")
      .def_readonly("warnings", &vo::Walk::warnings);

  py::class_<SharedRoute>(module, "Route", "A reference route: any number of traverses of it.")
      .def(py::init([](const py::kwargs& arguments) {
             return SharedRoute{
                 std::make_shared<const place::Route>(place::new_route(settings_of(arguments)))};
           }),
           "A route without traverses. Keywords: settings.")
      .def_static(
          "open",
          [](const std::string& path) {
            return unlocked(
                [&] { return SharedRoute{std::make_shared<const place::Route>(place::read_route(path))}; });
          },
          py::arg("path"), "Reads a route database.")
      .def(
          "save",
          [](const SharedRoute& shared, const std::string& path) {
            const std::shared_ptr<const place::Route> route = shared.now;
            unlocked([&] { place::write_route(path, *route); });
          },
          py::arg("path"), "Writes the route database, whole or not at all.")
      .def(
          "add", &add, py::arg("name"), py::arg("walk"), py::kw_only(), py::arg("truth") = "",
          py::arg("trajectory") = "", py::arg("track") = "", py::arg("replace") = false,
          "Samples a walk and puts it among the traverses, surveyed by one of the files: truth.csv, a "
          "trajectory (TUM), a "
          "GPS track (GPX). Returns what a user should know, a list of sentences. Keywords: settings of this "
          "walk.")
      .def_property_readonly("traverses", &traverses_of,
                             "a list of dicts: name, source, and of its keyframes frame, time_s, distance_m");

  py::class_<place::Run>(module, "Run",
                         "A walk found on a route; arrays have one entry for each keyframe of the walk.")
      .def_property_readonly("frame",
                             [](const place::Run& r) {
                               return array_of<std::int64_t>(r.matches,
                                                             [](const auto& m) { return m.query_frame; });
                             })
      .def_property_readonly("time_s",
                             [](const place::Run& r) {
                               return array_of<double>(r.matches,
                                                       [](const auto& m) { return m.query_time_s; });
                             })
      .def_property_readonly(
          "reference_frame",
          [](const place::Run& r) {
            return array_of<std::int64_t>(r.matches,
                                          [](const auto& m) { return m.place ? m.place->frame : -1; });
          },
          "int64, -1 for none")
      .def_property_readonly(
          "reference_distance_m",
          [](const place::Run& r) {
            return array_of<double>(
                r.matches, [](const auto& m) { return m.place ? or_nan(m.place->distance_m) : or_nan({}); });
          },
          "float64, NaN where not known")
      .def_property_readonly("score",
                             [](const place::Run& r) {
                               return array_of<double>(r.matches, [](const auto& m) { return m.score; });
                             })
      .def_property_readonly("probability",
                             [](const place::Run& r) {
                               return array_of<double>(r.matches,
                                                       [](const auto& m) { return or_nan(m.probability); });
                             })
      .def_property_readonly("sd_m",
                             [](const place::Run& r) {
                               return array_of<double>(r.matches,
                                                       [](const auto& m) { return or_nan(m.sd_m); });
                             })
      .def_property_readonly("accepted",
                             [](const place::Run& r) {
                               return array_of<bool>(r.matches, [](const auto& m) { return m.accepted; });
                             })
      .def_property_readonly(
          "trajectory",
          [](const place::Run& r) -> py::object {
            if (!r.trajectory) return py::none();
            return as_dict(*r.trajectory);
          },
          "the walk's odometry without its drift, as a dict of arrays time_s, x_m, y_m, heading_deg; None "
          "where there is none")
      .def_readonly("warnings", &place::Run::warnings);

  py::class_<Odometry>(module, "Odometry", "Steps and displacement of a walk.")
      .def_property_readonly(
          "time_s", [](const Odometry& o) { return array_of(o.walk.time_s); }, "float64 (frames,)")
      .def_property_readonly(
          "displacement", [](const Odometry& o) { return array_of(vo::displacements(o.motion)); },
          "float64 (frames,): of each frame since the one before")
      .def_property_readonly(
          "unit", [](const Odometry& o) { return std::string(o.motion.metric ? "m" : "mean_speed"); })
      .def_property_readonly("steps", &steps_of, "a dict of arrays: frame, time_s, left")
      .def_property_readonly("trajectory", [](const Odometry& o) { return as_dict(o.motion.trajectory); })
      .def_property_readonly("warnings", [](const Odometry& o) {
        std::vector<std::string> all = o.walk.warnings;
        all.insert(all.end(), o.motion.warnings.begin(), o.motion.warnings.end());
        return all;
      });

  module.def("read_walk", &read_walk, py::arg("source"), py::arg("route") = py::none(), py::kw_only(),
             py::arg("progress") = py::none(),
             "Reads a recording: a video, a folder of images, camera:N, or a list of files that are one "
             "walk; with a route as a "
             "walk that is to be found on it. `progress(stage, done, total)` returns False to stop early. "
             "Keywords: settings.");
  module.def("build", &build, py::arg("source"), py::arg("name") = "reference", py::kw_only(),
             py::arg("truth") = "", py::arg("trajectory") = "", py::arg("track") = "",
             py::arg("progress") = py::none(),
             "A route of one walk: `Route`, `read_walk` and `Route.add` in one call.");
  module.def("localise", &localise, py::arg("route"), py::arg("walk"),
             "Finds a walk on a route: a Run. Keywords: settings.");
  module.def("odometry", &odometry, py::arg("source"), py::kw_only(), py::arg("progress") = py::none(),
             "Steps, displacement and trajectory of a recording: an Odometry. Keywords: settings.");
}

}  // namespace retrace_python
