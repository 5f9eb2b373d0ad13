#include "arrays.hpp"
#include "bindings.hpp"
#include "settings_arguments.hpp"
#include "shared_route.hpp"
#include "unlocked.hpp"

#include <memory>
#include <mutex>
#include <pybind11/stl.h>
#include <string>
#include <utility>
#include <vector>

#include <opencv2/core/mat.hpp>

#include <place/certainty/follower.hpp>
#include <vo/base/degrees.hpp>

namespace retrace_python {
namespace {

/// A follower that counts the frames it is given, by one thread after another.
struct PythonFollower {
  std::shared_ptr<const place::Route> route;  ///< as it was when it began
  place::Follower follower;
  std::unique_ptr<std::mutex> mutex = std::make_unique<std::mutex>();
  std::int64_t frames = 0;
};

py::dict as_dict(const place::FollowedPlace& at) {
  py::dict result;
  result["traverse"] = at.traverse;
  result["reference_frame"] = at.reference_frame;
  result["probability"] = at.probability;
  result["sd_keyframes"] = at.sd_keyframes;
  if (at.distance_m) result["distance_m"] = *at.distance_m;
  if (at.sd_m) result["sd_m"] = *at.sd_m;
  if (!at.pose) return result;
  result["x_m"] = at.pose->x_m;
  result["y_m"] = at.pose->y_m;
  result["heading_deg"] = vo::compass_deg(at.pose->heading_rad);
  return result;
}

py::dict push(PythonFollower& self, const Bytes& image, double time_s) {
  if (image.ndim() != 2 && !(image.ndim() == 3 && image.shape(2) == 3))
    throw py::value_error(
        "image: uint8 (height, width) or (height, width, 3) in the order blue, green, red expected");
  place::Position position;
  {
    const int kind = image.ndim() == 2 ? CV_8UC1 : CV_8UC3;
    // OpenCV has no pictures that are only read; this one is.
    const cv::Mat view(static_cast<int>(image.shape(0)), static_cast<int>(image.shape(1)), kind,
                       const_cast<std::uint8_t*>(image.data()));
    // Not to be stopped within a frame, which takes milliseconds: half a step would be taken for the next.
    const py::gil_scoped_release released;
    const std::lock_guard one_at_a_time(*self.mutex);
    position = self.follower.push({.index = self.frames, .time_s = time_s, .image = view, .colour = {}});
    ++self.frames;
  }
  py::dict result = position.place ? as_dict(*position.place) : py::dict();
  result["frame"] = position.frame;
  result["time_s"] = position.time_s;
  result["state"] = place::name_of(position.state);
  result["off_route"] = position.off_route;
  if (!position.lag_frame) return result;
  py::dict lag = position.lag_place ? as_dict(*position.lag_place) : py::dict();
  lag["frame"] = *position.lag_frame;
  result["lag"] = lag;
  return result;
}

py::list finish(const PythonFollower& self) {
  std::vector<place::EarlierPlace> last;
  {
    const py::gil_scoped_release released;
    const std::lock_guard one_at_a_time(*self.mutex);
    last = self.follower.finish();
  }
  py::list all;
  for (const place::EarlierPlace& earlier : last) {
    py::dict one = earlier.place ? as_dict(*earlier.place) : py::dict();
    one["frame"] = earlier.frame;
    all.append(one);
  }
  return all;
}

}  // namespace

void bind_follower(py::module_& module) {
  py::class_<PythonFollower>(module, "Follower", "Says where on a route a walker is, frame by frame.")
      .def(py::init([](const SharedRoute& shared, double lag_s, const py::kwargs& arguments) {
             const place::Settings settings = settings_of(arguments);
             std::shared_ptr<const place::Route> route = shared.now;
             place::Follower follower =
                 unlocked([&] { return place::Follower(*route, settings, {.lag_s = lag_s}); });
             return PythonFollower{.route = std::move(route), .follower = std::move(follower)};
           }),
           py::arg("route"), py::kw_only(), py::arg("lag_s") = 0.0,
           "`lag_s`: seconds that a second, surer answer looks back by; 0: none.")
      .def("push", &push, py::arg("image"), py::arg("time_s"),
           "The next picture, uint8 (height, width) or BGR (height, width, 3), and its time, later than the "
           "one before. A dict "
           "like a line of `retrace follow`: frame, time_s, state ('searching', 'on_route', 'off_route'), "
           "off_route (the "
           "probability of being off it), and on the route traverse, reference_frame, distance_m, sd_m, "
           "probability, x_m, y_m, "
           "heading_deg.")
      .def("finish", &finish,
           "After the last picture: the surer answers that no later one has brought, oldest first, as dicts "
           "of frame and, where it was on the route, what `push` gives of a place.");
}

}  // namespace retrace_python
