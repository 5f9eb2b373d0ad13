#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace retrace {

/// A value rounded to six digits, null if not finite: enough for a page, in few bytes.
nlohmann::ordered_json rounded(double value);
nlohmann::ordered_json rounded(const std::vector<double>& values);

/// Points, joined by a line or not.
struct Series {
  std::string name;
  std::vector<double> x;
  std::vector<double> y;  ///< as many as x; NaN breaks the line
  std::string colour;     ///< a colour of report.css: blue, orange, green, purple, ochre, grey
  bool line = true;
  std::string mark;       ///< circle, triangle, square, diamond, cross or star; empty: none
  bool hollow = false;    ///< marks are outlines
  std::vector<int> dash;  ///< pixels drawn and left out; empty: solid
  double width_px = 1.8;
  double size_px = 3.5;            ///< half of a mark
  bool bar_ends = false;           ///< the first and last point are bars across the line, as for an interval
  bool label_at_end = false;       ///< the name is written at the last point, not in the legend
  std::vector<std::string> notes;  ///< shown with each point's values; empty: none
};

/// Gives a series the colour, mark and dashes of number `index`, so that several can be distinguished even
/// without colour.
Series styled(Series series, std::size_t index);

/// Stretches of x that are shaded.
struct Band {
  std::string name;
  std::string colour;
  std::vector<std::pair<double, double>> spans;
};

/// A picture in the plane of the axes.
struct Backdrop {
  std::string source;  ///< data URL
  double left = 0, right = 0, top = 0, bottom = 0;
};

/// A figure of lines and points, drawn by charts.js.
struct Chart {
  std::string title;  ///< for screen readers
  std::string x_title, y_title;
  std::vector<Series> series;
  std::vector<Band> bands;
  std::optional<std::array<double, 2>> x_range, y_range;  ///< the extent of the data if not given
  std::vector<std::string> y_names;                       ///< for y = 1, 2, ..., instead of numbers
  std::optional<Backdrop> backdrop;
  bool equal = false;     ///< one scale along both axes
  bool zoomable = false;  ///< along x, or along both if they are equal
  std::string size;       ///< "tall", "wide" or empty
};

/// What charts.js reads, as JSON.
std::string to_json(const Chart& chart);

}  // namespace retrace
