#include "sweep_pairs.hpp"

#include "toml_entries.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>

#include <vo/base/error.hpp>
#include <vo/io/csv.hpp>

namespace retrace {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPairKeys =
    "query, reference, pairs, query-truth, reference-truth, tolerance-m or tolerance-frames";

double tolerance_of(const std::string& text) {
  const std::optional<double> value = vo::parse_number(text);
  if (!value || *value < 0)
    throw vo::Error("tolerance", fmt::format("is '{}'", text), "a number of at least 0");
  return *value;
}

void put(WalkPairEntry& pair, const TomlEntry& entry, const fs::path& folder) {
  std::vector<std::string> files;
  for (const std::string& value : entry.values) files.push_back((folder / value).string());
  if (entry.key == "query" || entry.key == "reference") {
    (entry.key == "query" ? pair.query : pair.reference) = files;
    return;
  }
  const std::pair<const char*, std::string*> truths[]{{"pairs", &pair.truth.pairs},
                                                      {"query-truth", &pair.truth.query_truth},
                                                      {"reference-truth", &pair.truth.reference_truth}};
  const auto truth = std::ranges::find(truths, entry.key, &std::pair<const char*, std::string*>::first);
  const bool tolerance = entry.key == "tolerance-m" || entry.key == "tolerance-frames";
  if (truth == std::end(truths) && !tolerance) throw vo::Error(entry.key, "is no key of a pair", kPairKeys);
  if (entry.values.size() != 1)
    throw vo::Error(entry.key, "stands there twice, or with several values", "one");
  if (truth != std::end(truths)) {
    *truth->second = files.front();
  } else {
    place::Tolerance& into = pair.truth.tolerance;
    (entry.key == "tolerance-m" ? into.tolerance_m : into.tolerance_frames) = tolerance_of(entry.values[0]);
  }
}

void check_pair(const WalkPairEntry& pair) {
  // Hidden names and those with a slash would lead out of the results' folder; others are no cell of a table.
  if (pair.name.find_first_of("/,\"") != std::string::npos || pair.name.starts_with('.'))
    throw vo::Error("its name", "cannot be a folder's", "a name without / , or \" and no . in front");
  for (const char* const ours : {"benchmark.csv", "benchmark.json", "report.html"})
    if (pair.name == ours) throw vo::Error("its name", "is that of a file of the benchmark", "another");
  if (pair.query.empty()) throw vo::Error("query", "is missing", "the walk to be found");
  if (pair.reference.empty()) throw vo::Error("reference", "is missing", "the walk it is found on");
  if (const std::string lack = what_truth_lacks(pair.truth); !lack.empty())
    throw vo::Error("its truth", "is incomplete, or given twice", lack);
}

}  // namespace

std::vector<WalkPairEntry> read_walk_pairs(const std::string& file) {
  std::vector<WalkPairEntry> pairs;
  std::set<std::pair<std::string, std::string>> seen;
  const fs::path folder = fs::path(file).parent_path();
  for (const TomlEntry& entry : read_toml(file, "a TOML file with a section for each pair of walks")) {
    if (entry.section.empty())
      throw vo::Error(file, fmt::format("{} stands above the first pair", entry.key), "[NAME] before it");
    auto pair = std::ranges::find(pairs, entry.section, &WalkPairEntry::name);
    if (pair == pairs.end()) pair = pairs.insert(pair, {.name = entry.section});
    try {
      if (!seen.insert({entry.section, entry.key}).second)
        throw vo::Error(entry.key, "stands there twice", "one");
      put(*pair, entry, folder);
    } catch (const vo::Error& error) {
      throw vo::Error(fmt::format("{}: [{}]", file, entry.section), error.what());
    }
  }
  if (pairs.empty()) throw vo::Error(file, "has no pair", fmt::format("[NAME], and below it {}", kPairKeys));
  for (const WalkPairEntry& pair : pairs) {
    try {
      check_pair(pair);
    } catch (const vo::Error& error) {
      throw vo::Error(fmt::format("{}: [{}]", file, pair.name), error.what());
    }
  }
  return pairs;
}

}  // namespace retrace
