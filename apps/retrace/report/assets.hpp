#pragma once

#include <string_view>

/// The assets of every report, embedded when the program is built (report/embed.cmake).
namespace retrace::assets {

std::string_view style();             ///< report.css
std::string_view chart_js();          ///< Chart.js, from Debian's libjs-chart.js
std::string_view chart_js_licence();  ///< its copyright file
std::string_view charts();            ///< charts.js: figures of lines and points
std::string_view matrix();            ///< matrix.js: cost matrices
std::string_view strip();             ///< strip.js: pairs of frames
std::string_view player();            ///< player.js: followed walks
std::string_view report();            ///< report.js: draws all figures of the page

}  // namespace retrace::assets
