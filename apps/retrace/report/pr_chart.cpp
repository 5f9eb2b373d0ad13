#include "pr_chart.hpp"

#include <cmath>

#include <fmt/format.h>

namespace retrace {
namespace {

std::string told(const place::OperatingPoint& point) {
  return fmt::format("threshold {:.4g}, F1 {:.3f}", point.threshold, point.f1);
}

/// precision = f1 recall / (2 recall - f1), from where it is 1.
Series equal_f1(double f1) {
  Series line{.name = fmt::format("F1 {}", f1),
              .colour = "grey",
              .dash = {3, 4},
              .width_px = 1,
              .label_at_end = true};
  constexpr int kPoints = 40;
  for (int i = 0; i <= kPoints; ++i) {
    // Closer where it is steep.
    const double recall = std::lerp(f1 / (2 - f1), 1.0, std::pow(static_cast<double>(i) / kPoints, 2));
    line.x.push_back(recall);
    line.y.push_back(f1 * recall / (2 * recall - f1));
  }
  return line;
}

}  // namespace

Chart precision_recall_plane() {
  Chart chart{.title = "precision against recall for every threshold",
              .x_title = "recall",
              .y_title = "precision",
              .x_range = std::array{0.0, 1.0},
              .y_range = std::array{0.0, 1.0},
              .size = "tall"};
  for (const double f1 : {0.2, 0.4, 0.6, 0.8, 0.9}) chart.series.push_back(equal_f1(f1));
  return chart;
}

Series precision_recall_curve(std::string name, const place::Evaluation& evaluation) {
  Series curve{.name = std::move(name), .colour = "blue", .mark = "circle"};
  for (const place::OperatingPoint& point : evaluation.curve) {
    curve.x.push_back(point.recall);
    curve.y.push_back(point.precision);
    curve.notes.push_back(told(point));
  }
  return curve;
}

Series operating_point(std::string name, const place::OperatingPoint& point, std::string colour,
                       std::string mark) {
  return {.name = std::move(name),
          .x = {point.recall},
          .y = {point.precision},
          .colour = std::move(colour),
          .line = false,
          .mark = std::move(mark),
          .size_px = 9,
          .notes = {told(point)}};
}

}  // namespace retrace
