#include "settings_table.hpp"

#include <array>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

namespace retrace {

void put_settings(Page& page, const std::filesystem::path& config) {
  std::ifstream file(config);
  if (!file) return;
  put_settings(page, std::string(std::istreambuf_iterator<char>(file), {}));
}

void put_settings(Page& page, const std::string& toml) {
  std::istringstream file(toml);
  // Each setting has a comment above it; `name = value` was set, `# name = value` was not.
  std::vector<std::array<std::string, 3>> rows;
  std::string line, comment;
  while (std::getline(file, line)) {
    const std::size_t equals = line.find(" = ");
    if (line.starts_with('#')) {
      comment = line.substr(std::min<std::size_t>(2, line.size()));
    } else if (equals != std::string::npos) {
      rows.push_back({line.substr(0, equals), line.substr(equals + 3), comment});
    }
  }
  page.heading("Settings");
  page.definitions(rows);
}

}  // namespace retrace
