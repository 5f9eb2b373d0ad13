#include "run_view.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace retrace {

using nlohmann::ordered_json;

std::vector<double> numbers(const ordered_json& json, const char* name) {
  std::vector<double> values;
  if (!json.contains(name)) return values;
  for (const ordered_json& value : json[name])
    values.push_back(value.is_number() ? value.get<double>() : NAN);
  return values;
}

const ordered_json& traverses(const RunView& run) {
  static const ordered_json kNone = ordered_json::array();
  return run.data.contains("traverses") ? run.data["traverses"] : kNone;
}

double interpolated(const std::vector<double>& x, const std::vector<double>& y, double at) {
  const auto right = std::ranges::lower_bound(x, at);
  if (right == x.begin()) return y.front();
  if (right == x.end()) return y.back();
  const auto i = static_cast<std::size_t>(right - x.begin());
  return std::lerp(y[i - 1], y[i], (at - x[i - 1]) / (x[i] - x[i - 1]));
}

std::vector<double> upto(std::size_t count) {
  std::vector<double> values(count);
  std::iota(values.begin(), values.end(), 0.0);
  return values;
}

}  // namespace retrace
