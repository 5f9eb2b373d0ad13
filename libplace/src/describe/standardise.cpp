#include "place/describe/standardise.hpp"

#include <cmath>
#include <numeric>
#include <stdexcept>
#include <vector>

namespace place {
namespace {

constexpr double kPriorRows = 100;
constexpr float kLeastShare = 0.1F;  // of the mean deviation
constexpr float kNone = 1e-9F;       // if nothing varies at all

}  // namespace

Spread spread_of(const FloatRows& rows) {
  if (rows.size() == 0) throw std::invalid_argument("spread_of: rows expected");
  std::vector<double> sum(rows.width), squares(rows.width);
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t k = 0; k < rows.width; ++k) sum[k] += rows[i][k];
  const auto count = static_cast<double>(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t k = 0; k < rows.width; ++k) {
      const double away = rows[i][k] - sum[k] / count;
      squares[k] += away * away;
    }
  }
  Spread spread{make_float_rows(rows.width, 1), make_float_rows(rows.width, 1)};
  for (std::size_t k = 0; k < rows.width; ++k) {
    spread.mean.values[k] = static_cast<float>(sum[k] / count);
    spread.deviation.values[k] = static_cast<float>(std::sqrt(squares[k] / count));
  }
  return spread;
}

void standardise(FloatRows& rows, const Spread& learned) {
  if (learned.mean.values.size() != rows.width || learned.deviation.values.size() != rows.width)
    throw std::invalid_argument("standardise: a spread of as many values as a row expected");
  if (rows.size() == 0) return;
  Spread spread = spread_of(rows);
  const auto count = static_cast<double>(rows.size());
  const auto share = static_cast<float>(count / (count + kPriorRows));
  const auto mix = [&](FloatRows& own, const FloatRows& usual) {
    for (std::size_t k = 0; k < rows.width; ++k)
      own.values[k] = share * own.values[k] + (1 - share) * usual.values[k];
  };
  mix(spread.mean, learned.mean);
  mix(spread.deviation, learned.deviation);
  const std::vector<float>& deviation = spread.deviation.values;
  const float usual =
      std::accumulate(deviation.begin(), deviation.end(), 0.0F) / static_cast<float>(rows.width);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t k = 0; k < rows.width; ++k) {
      float& value = rows[i][k];
      value = (value - spread.mean.values[k]) / (deviation[k] + kLeastShare * usual + kNone);
    }
  }
}

}  // namespace place
