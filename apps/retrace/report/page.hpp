#pragma once

#include "report/chart.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace retrace {

/// A number shown large at the head of a page.
struct Headline {
  std::string name;
  std::string value;
  std::string note;
};

/// Values of two settings, shaded by size.
struct HeatTable {
  std::string title;
  std::string row_title, column_title;
  std::vector<std::string> rows, columns;
  std::vector<std::vector<double>> values;  ///< by row, then column; NaN: none
};

/// The least and the largest value of tables; (0, 0) without any.
std::array<double, 2> value_range(const std::vector<HeatTable>& tables);

/// A report: one HTML file with everything inside, readable offline, in light and dark, and on paper.
class Page {
 public:
  Page(std::string_view title, std::string_view subtitle);

  void heading(std::string_view text);
  void paragraph(std::string_view text);
  void warning(std::string_view text);
  void headlines(const std::vector<Headline>& numbers);
  /// Name and value, one pair a row.
  void facts(const std::vector<std::pair<std::string, std::string>>& rows);
  /// Names with a value and a sentence about it, which moves below on a narrow screen.
  void definitions(const std::vector<std::array<std::string, 3>>& rows);
  void table(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows);
  /// Side by side, shaded on one scale.
  void heat_tables(const std::vector<HeatTable>& tables);
  /// A JPEG or PNG picture. `description` is for screen readers.
  void picture(const std::vector<std::uint8_t>& image, std::string_view description,
               std::string_view caption);
  /// The same for a picture that is a `data:` URL already.
  void picture(const std::string& url, std::string_view description, std::string_view caption);
  /// Figures between these two stand beside each other where there is room.
  void begin_row();
  void end_row();
  void chart(const Chart& chart, std::string_view caption);
  /// The same under a heading, both left out if there is no chart; an empty heading is left out.
  void chart(std::string_view heading, const std::optional<Chart>& chart, std::string_view caption);
  /// A cost matrix to zoom into: the JSON that matrix.js reads.
  void matrix(std::string_view json, std::string_view caption);
  /// Pairs of frames to look through: the JSON that strip.js reads.
  void strip(std::string_view json, std::string_view caption);

  /// A followed walk to play: the JSON that player.js reads.
  void player(std::string_view json, std::string_view caption);

  /// The whole page.
  [[nodiscard]] std::string html() const;

 private:
  void heat_table(const HeatTable& table, std::array<double, 2> range);
  void figure(std::string_view kind, std::string_view content, std::string_view json,
              std::string_view caption);

  std::string title_;
  std::string body_;
  int figures_ = 0;
};

/// A JPEG or PNG as a `data:` URL.
std::string data_url(const std::vector<std::uint8_t>& image);

}  // namespace retrace
