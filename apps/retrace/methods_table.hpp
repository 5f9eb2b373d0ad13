#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include <place/evaluation/sweep_methods.hpp>

namespace retrace {

/// The fair table: a row for each method with its best and its default.
struct MethodsTable {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
  std::string note;  ///< what it does not show; empty if nothing
};

MethodsTable methods_table(const std::vector<place::SweepAxis>& axes,
                           const std::vector<std::string>& compared,
                           const std::vector<place::ComparedMethod>& methods);

/// The same for machines.
nlohmann::ordered_json methods_json(const std::vector<place::SweepAxis>& axes,
                                    const std::vector<std::string>& compared,
                                    const std::vector<place::ComparedMethod>& methods);

/// Its rows as a Markdown table, for a terminal and for texts.
std::string methods_text(const MethodsTable& table);

}  // namespace retrace
