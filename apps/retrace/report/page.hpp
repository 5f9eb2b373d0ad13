#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace retrace {

/// A report: one HTML file with everything inside, readable offline, in light and dark, and on paper.
class Page {
 public:
  Page(std::string_view title, std::string_view subtitle);

  void heading(std::string_view text);
  void paragraph(std::string_view text);
  /// Name and value, one pair a row.
  void facts(const std::vector<std::pair<std::string, std::string>>& rows);
  void table(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows);
  /// A JPEG or PNG picture. `description` is read out to who cannot see it.
  void picture(const std::vector<std::uint8_t>& image, std::string_view description,
               std::string_view caption);

  /// The whole page.
  [[nodiscard]] std::string html() const;

 private:
  std::string title_;
  std::string body_;
};

}  // namespace retrace
