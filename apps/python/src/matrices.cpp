#include "arrays.hpp"
#include "bindings.hpp"
#include "settings_arguments.hpp"
#include "unlocked.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <pybind11/stl.h>
#include <string>
#include <string_view>
#include <utility>

#include <place/certainty/match_probability.hpp>
#include <place/certainty/sure_search.hpp>
#include <place/match/contrast_enhancement.hpp>
#include <place/match/cost_matrix.hpp>
#include <place/match/float_costs.hpp>
#include <place/match/search_method.hpp>
#include <place/match/search_options.hpp>
#include <place/resolve.hpp>
#include <place/stage_options.hpp>
#include <vo/base/error.hpp>
#include <vo/image/patch_normalisation.hpp>

namespace retrace_python {
namespace {

py::array_t<float> patch_normalise(const Bytes& images, int patch_px, const std::string& shape,
                                   double min_contrast) {
  if (images.ndim() != 2 && images.ndim() != 3)
    throw py::value_error("images: uint8 (height, width) or (n, height, width) expected");
  if (shape != "grid" && shape != "window") throw py::value_error("shape: 'grid' or 'window' expected");
  const auto height = static_cast<int>(images.shape(images.ndim() - 2));
  const auto width = static_cast<int>(images.shape(images.ndim() - 1));
  const auto size = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  py::array_t<float> out(std::vector<py::ssize_t>(images.shape(), images.shape() + images.ndim()));
  const vo::PatchNormalisationOptions options{
      .patch_px = patch_px,
      .shape = shape == "grid" ? vo::PatchShape::kGrid : vo::PatchShape::kWindow,
      .min_contrast = min_contrast};
  const std::uint8_t* const from = images.data();
  float* const to = out.mutable_data();
  const std::size_t count = size == 0 ? 0 : static_cast<std::size_t>(images.size()) / size;
  unlocked([&] {
    for (std::size_t i = 0; i < count; ++i) {
      vo::stop_if_asked();
      vo::patch_normalise({from + i * size, size}, width, height, options, {to + i * size, size});
    }
  });
  return out;
}

place::Metric metric_of(const std::string& name) {
  if (name == "cosine") return place::Metric::kCosine;
  if (name == "l1") return place::Metric::kL1;
  if (name == "l2") return place::Metric::kL2;
  throw py::value_error("metric: 'cosine', 'l1' or 'l2' expected");
}

place::CostMatrix cost_matrix(const py::array& query, const py::array& reference, const std::string& metric) {
  using AnyBytes = py::array_t<std::uint8_t>;  // strided too; `Bytes` copies it
  const bool bytes = py::isinstance<AnyBytes>(query) && py::isinstance<AnyBytes>(reference);
  if (bytes && metric == "sad") {
    const Bytes queries(query), references(reference);
    const vo::ImageStackView query_images = image_stack(queries), reference_images = image_stack(references);
    return unlocked([&] { return place::cost_matrix(query_images, reference_images); });
  }
  if (metric == "sad")
    throw py::value_error("metric 'sad' takes uint8 arrays; for floats 'cosine', 'l1' or 'l2' expected");
  const Floats queries(query), references(reference);
  const place::FloatRowsView query_rows = float_rows(queries), reference_rows = float_rows(references);
  const place::Metric of_rows = metric_of(metric);
  return unlocked([&] { return place::cost_matrix(place::FloatCosts(query_rows, reference_rows, of_rows)); });
}

place::CostMatrix copy_of(const place::CostView& costs) {
  place::CostMatrix matrix = place::make_cost_matrix(costs.queries, costs.references);
  std::ranges::copy(costs.values, matrix.values.begin());
  return matrix;
}

place::CostMatrix enhance(const py::object& costs, const std::string& method, int window,
                          double prior_queries) {
  place::ContrastEnhancementOptions options{.window = window, .prior_queries = prior_queries};
  if (method == "local") {
    options.method = place::Enhancement::kLocal;
  } else if (method == "none") {
    options.method = place::Enhancement::kNone;
  } else if (method != "standardise") {
    throw py::value_error("method: 'standardise', 'local' or 'none' expected");
  }
  place::CostMatrix enhanced = copy_of(CostsArgument(costs).matrix());
  unlocked([&] { place::enhance_contrast(enhanced, options); });
  return enhanced;
}

/// The matches of `search` as arrays.
struct Found {
  py::array_t<std::int64_t> reference;
  py::array_t<double> score, probability, sd_keyframes;
};

Found search(const py::object& costs, const std::string& method, int sequence_length,
             std::optional<std::vector<double>> steps, const std::vector<std::size_t>& query_gaps,
             const std::vector<std::size_t>& reference_gaps, const py::kwargs& arguments) {
  place::Settings settings = settings_of(arguments);
  static constexpr std::array<std::string_view, 6> kOfMatrix{
      "search_range_rad", "v_min", "v_max", "min_fraction", "uniqueness_window", "score"};
  for (const auto& [key, value] : arguments)
    if (!value.is_none() && std::ranges::find(kOfMatrix, key.cast<std::string>()) == kOfMatrix.end())
      throw vo::Error(key.cast<std::string>(), "has no effect on the search of a matrix",
                      "search_range_rad, v_min, v_max, min_fraction, uniqueness_window or score");
  settings.search = method;
  settings.sequence_length = sequence_length;
  const place::StageOptions stages = place::stage_options(place::resolve(settings, {}));
  place::SearchOptions options{.sequence = stages.matching.search,
                               .graph = {},
                               .path = {},
                               .gaps = {.query = query_gaps, .reference = reference_gaps}};
  if (steps) options.path.steps = *steps;
  const CostsArgument argument(costs);
  const place::SureMatches found = unlocked(
      [&] { return place::search_surely(argument.matrix(), place::search_method(method), options); });
  const auto& all = found.matches;
  return {array_of<std::int64_t>(all,
                                 [](const place::SureMatch& m) {
                                   return m.match.reference ? static_cast<std::int64_t>(*m.match.reference)
                                                            : -1;
                                 }),
          array_of<double>(all, [](const place::SureMatch& m) { return static_cast<double>(m.match.score); }),
          array_of<double>(all, [](const place::SureMatch& m) { return or_nan(m.probability); }),
          array_of<double>(all, [](const place::SureMatch& m) { return or_nan(m.sd_keyframes); })};
}

py::array_t<double> calibrate(const Doubles& scores, const Doubles& decoys) {
  if (scores.ndim() != 1 || decoys.ndim() != 1)
    throw py::value_error("scores and decoys: arrays of one dimension expected");
  const place::MatchProbabilities found =
      place::match_probabilities({scores.data(), static_cast<std::size_t>(scores.size())},
                                 {decoys.data(), static_cast<std::size_t>(decoys.size())}, {});
  if (found.status != place::ProbabilityStatus::kGiven)
    throw py::value_error("scores and decoys: ten or more of each expected");
  return array_of(found.probability);
}

}  // namespace

void bind_matrices(py::module_& module) {
  py::class_<place::CostMatrix>(module, "CostMatrix", py::buffer_protocol(),
                                "Costs of queries (rows) by references, float32, lower is more alike. "
                                "numpy.asarray(matrix) looks at it without a copy.")
      .def(py::init([](const Floats& array) { return copy_of(CostsArgument(array).matrix()); }),
           py::arg("array"), "A copy of a float array (queries, references).")
      .def_property_readonly(
          "shape", [](const place::CostMatrix& m) { return py::make_tuple(m.queries, m.references); })
      .def_buffer([](place::CostMatrix& m) {
        return py::buffer_info(m.values.data(), sizeof(float), py::format_descriptor<float>::format(), 2,
                               {m.queries, m.references}, {sizeof(float) * m.references, sizeof(float)});
      });
  py::class_<Found>(module, "Matches", "What `search` found: one entry for each query, in arrays.")
      .def_readonly("reference", &Found::reference, "int64 (queries,): the matched reference, -1 for none")
      .def_readonly("score", &Found::score, "float64 (queries,): higher is surer")
      .def_readonly("probability", &Found::probability,
                    "float64 (queries,): that the match is right; NaN for none")
      .def_readonly("sd_keyframes", &Found::sd_keyframes,
                    "float64 (queries,): how exact it is, in references; NaN for none");
  module.def("patch_normalise", &patch_normalise, py::arg("images"), py::kw_only(), py::arg("patch_px") = 8,
             py::arg("shape") = "grid", py::arg("min_contrast") = 1.25,
             "Patch-normalised images [SSS Eq. 2]: float32, in deviations of a patch, of the shape of "
             "`images` (uint8, "
             "(height, width) or (n, height, width)).");
  module.def("cost_matrix", &cost_matrix, py::arg("query"), py::arg("reference"), py::kw_only(),
             py::arg("metric") = "cosine",
             "A CostMatrix of descriptors, one in each row of (n, values): 'cosine', 'l1' or 'l2' of floats, "
             "'sad' (mean "
             "absolute difference) of uint8.");
  module.def("enhance", &enhance, py::arg("costs"), py::kw_only(), py::arg("method") = "standardise",
             py::arg("window") = 10, py::arg("prior_queries") = 0.0,
             "Costs in deviations: by 'standardise' over rows, then columns; by 'local' along the reference "
             "[SeqSLAM]; a new "
             "CostMatrix.");
  module.def("search", &search, py::arg("costs"), py::kw_only(), py::arg("method") = "path",
             py::arg("sequence_length") = 10, py::arg("steps") = py::none(),
             py::arg("query_gaps") = std::vector<std::size_t>{},
             py::arg("reference_gaps") = std::vector<std::size_t>{},
             "Where each query is on the reference, by enhanced costs (a CostMatrix, or an array, "
             "which is read where it is if it is float32 in C's order and must not change meanwhile): method "
             "'path', 'lines', 'cone', 'hybrid' or 'graph'. `steps`: references that the walk moved to each "
             "query, for 'path'. "
             "`query_gaps`, `reference_gaps`: indices before which a walk was interrupted. Further keywords: "
             "settings of the "
             "search, such as search_range_rad.");
  module.def("calibrate", &calibrate, py::arg("scores"), py::arg("decoys"),
             "Probabilities that matches of these scores are right, learned without labels from the scores "
             "of decoys, whose "
             "matches are all wrong, such as those of the queries in reverse order. float64 arrays of one "
             "dimension.");
}

}  // namespace retrace_python
