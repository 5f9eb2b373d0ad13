#include "page.hpp"

#include "report/assets.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace retrace {
namespace {

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string base64(const std::vector<std::uint8_t>& bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = group << 8U | (k < count ? bytes[i + k] : 0U);
    for (std::size_t k = 0; k < 4; ++k) text += k <= count ? kDigits[group >> (18 - 6 * k) & 63U] : '=';
  }
  return text;
}

/// JSON that a script element may hold: no "</script>" or "<!--" in it.
std::string script_json(std::string_view json) {
  std::string text;
  for (const char c : json) {
    if (c == '<') {
      text += "\\u003c";
    } else {
      text += c;
    }
  }
  return text;
}

/// Text that an HTML comment may hold.
std::string without_comment_marks(std::string_view text) {
  std::string plain(text);
  for (std::size_t at = plain.find("--"); at != std::string::npos; at = plain.find("--", at))
    plain.replace(at, 2, "- ");
  return plain;
}

/// What the browser may do for a page: show what is in it, ask the server that it came from, if any, for
/// more, and fetch or send nothing else.
constexpr std::string_view kPagePolicy =
    "default-src 'none'; img-src 'self' data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'; "
    "connect-src "
    "'self'; "
    "form-action 'none'; base-uri 'none'";

bool is_number(std::string_view cell) {
  return !cell.empty() && cell.find_first_not_of("0123456789.-+e %[],") == std::string_view::npos;
}

}  // namespace

std::string data_url(const std::vector<std::uint8_t>& image) {
  const bool png = image.size() > 1 && image[0] == 0x89;
  return fmt::format("data:image/{};base64,{}", png ? "png" : "jpeg", base64(image));
}

Page::Page(std::string_view title, std::string_view subtitle) : title_(escaped(title)) {
  body_ = fmt::format("<h1>{}</h1>\n<p class=\"subtitle\">{}</p>\n", title_, escaped(subtitle));
}

void Page::heading(std::string_view text) {
  body_ += fmt::format("<h2>{}</h2>\n", escaped(text));
}

void Page::paragraph(std::string_view text) {
  body_ += fmt::format("<p>{}</p>\n", escaped(text));
}

void Page::warning(std::string_view text) {
  body_ += fmt::format("<p class=\"warning\"><strong>Warning:</strong> {}</p>\n", escaped(text));
}

void Page::headlines(const std::vector<Headline>& numbers) {
  body_ += "<dl class=\"headline\">\n";
  for (const Headline& number : numbers) {
    body_ += fmt::format("<div><dt>{}</dt><dd>{}<small>{}</small></dd></div>\n", escaped(number.name),
                         escaped(number.value), escaped(number.note));
  }
  body_ += "</dl>\n";
}

void Page::facts(const std::vector<std::pair<std::string, std::string>>& rows) {
  body_ += "<div class=\"scroll\"><table>\n";
  for (const auto& [name, value] : rows) {
    body_ += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td></tr>\n", escaped(name), escaped(value));
  }
  body_ += "</table></div>\n";
}

void Page::definitions(const std::vector<std::array<std::string, 3>>& rows) {
  body_ += "<dl class=\"definitions\">\n";
  for (const auto& [name, value, text] : rows) {
    body_ += fmt::format("<div><dt>{} <code>{}</code></dt><dd>{}</dd></div>\n", escaped(name), escaped(value),
                         escaped(text));
  }
  body_ += "</dl>\n";
}

void Page::table(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows) {
  body_ += "<div class=\"scroll\"><table>\n<thead><tr>";
  for (std::size_t i = 0; i < header.size(); ++i) {
    const bool number = !rows.empty() && is_number(rows.front()[i]);
    body_ +=
        fmt::format("<th scope=\"col\"{}>{}</th>", number ? " class=\"number\"" : "", escaped(header[i]));
  }
  body_ += "</tr></thead>\n<tbody>\n";
  for (const auto& row : rows) {
    body_ += "<tr>";
    for (const std::string& cell : row) {
      body_ += fmt::format("<td{}>{}</td>", is_number(cell) ? " class=\"number\"" : "", escaped(cell));
    }
    body_ += "</tr>\n";
  }
  body_ += "</tbody>\n</table></div>\n";
}

std::array<double, 2> value_range(const std::vector<HeatTable>& tables) {
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const HeatTable& table : tables) {
    for (const auto& row : table.values) {
      for (const double value : row) {
        low = std::fmin(low, value);  // both ignore NaN
        high = std::fmax(high, value);
      }
    }
  }
  return low <= high ? std::array{low, high} : std::array{0.0, 0.0};
}

void Page::heat_tables(const std::vector<HeatTable>& tables) {
  body_ += "<div class=\"heats\">\n";
  for (const HeatTable& table : tables) heat_table(table, value_range(tables));
  body_ += "</div>\n";
}

void Page::heat_table(const HeatTable& table, std::array<double, 2> range) {
  const auto [low, high] = range;
  const double best = value_range({table})[1];
  body_ += fmt::format(
      "<div class=\"scroll\"><table class=\"heat\"><caption>{}</caption>\n<thead><tr><th scope=\"col\">{} \\ "
      "{}</th>",
      escaped(table.title), escaped(table.row_title), escaped(table.column_title));
  for (const std::string& column : table.columns)
    body_ += fmt::format("<th scope=\"col\">{}</th>", escaped(column));
  body_ += "</tr></thead>\n<tbody>\n";
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    body_ += fmt::format("<tr><th scope=\"row\">{}</th>", escaped(table.rows[r]));
    for (const double value : table.values[r]) {
      if (std::isnan(value)) {
        body_ += "<td>–</td>";
        continue;
      }
      const double shade = high > low ? (value - low) / (high - low) : 1;
      body_ +=
          fmt::format("<td class=\"{}{}\" style=\"--shade:{:.2f}\">{:.3f}{}</td>", shade > 0.6 ? "dark" : "",
                      value == best ? " best" : "", shade, value, value == best ? " ★" : "");
    }
    body_ += "</tr>\n";
  }
  body_ += "</tbody>\n</table></div>\n";
}

void Page::picture(const std::vector<std::uint8_t>& image, std::string_view description,
                   std::string_view caption) {
  picture(data_url(image), description, caption);
}

void Page::picture(const std::string& url, std::string_view description, std::string_view caption) {
  body_ += fmt::format(
      "<figure class=\"picture\"><img src=\"{}\" alt=\"{}\"><figcaption>{}</figcaption></figure>\n",
      escaped(url), escaped(description), escaped(caption));
}

void Page::begin_row() {
  body_ += "<div class=\"row\">\n";
}

void Page::end_row() {
  body_ += "</div>\n";
}

void Page::figure(std::string_view kind, std::string_view content, std::string_view json,
                  std::string_view caption) {
  body_ += fmt::format(
      "<figure class=\"{0}\" data-kind=\"{0}\" id=\"figure-{1}\">{2}<figcaption>{3}</figcaption>\n"
      "<script type=\"application/json\">{4}</script></figure>\n",
      kind, ++figures_, content, escaped(caption), script_json(json));
}

void Page::chart(const Chart& chart, std::string_view caption) {
  figure("chart",
         fmt::format(
             "<div class=\"plot {}\"><canvas role=\"img\" tabindex=\"0\" aria-label=\"{}\"></canvas></div>",
             chart.size, escaped(chart.title)),
         to_json(chart), caption);
}

void Page::chart(std::string_view heading_text, const std::optional<Chart>& drawn, std::string_view caption) {
  if (!drawn) return;
  if (!heading_text.empty()) heading(heading_text);
  chart(*drawn, caption);
}

void Page::matrix(std::string_view json, std::string_view caption) {
  figure("matrix",
         "<canvas role=\"img\" tabindex=\"0\" aria-label=\"cost matrix with the matches over it; plus, minus "
         "and 0 "
         "zoom, arrows move\"></canvas>",
         json, caption);
}

void Page::strip(std::string_view json, std::string_view caption) {
  figure("strip", "", json, caption);
}

void Page::player(std::string_view json, std::string_view caption) {
  figure("player", "", json, caption);
}

std::string Page::html() const {
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<link rel=\"icon\" "
      "href=\"data:,\">\n<meta http-equiv=\"Content-Security-Policy\" content=\"{}\">\n<title>{}</title>\n"
      "<style>\n{}</style>\n</head>\n<body>\n<main>\n{}</main>\n",
      kPagePolicy, title_, assets::style(), body_);
  if (figures_ > 0) {
    html += "<noscript><p>The figures need JavaScript; the numbers do not.</p></noscript>\n";
    html += fmt::format("<!-- Chart.js, of which this is the licence:\n{}\n-->\n<script>{}</script>\n",
                        without_comment_marks(assets::chart_js_licence()), assets::chart_js());
    for (const std::string_view script :
         {assets::charts(), assets::matrix(), assets::strip(), assets::player(), assets::report()})
      html += fmt::format("<script>\n{}</script>\n", script);
  }
  return html + "</body>\n</html>\n";
}

}  // namespace retrace
