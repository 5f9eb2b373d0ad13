#pragma once

#include "report/chart.hpp"

#include <string>

#include <place/evaluation/evaluation.hpp>

namespace retrace {

/// The plane of recall and precision with lines of equal F1, as a background for curves.
Chart precision_recall_plane();

/// Precision against recall at every threshold, which hovering shows.
Series precision_recall_curve(std::string name, const place::Evaluation& evaluation);

/// One point of the curve, large.
Series operating_point(std::string name, const place::OperatingPoint& point, std::string colour,
                       std::string mark);

}  // namespace retrace
