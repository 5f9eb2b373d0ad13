#pragma once

#include "methods_table.hpp"
#include "report/page.hpp"

#include <string>
#include <utility>
#include <vector>

#include <place/evaluation/sweep_grid.hpp>

namespace retrace {

/// The cell with the highest max-F1, the first among equals; none if no cell could be run. With `motion`,
/// only among cells with that first value.
std::optional<place::SweepCell> best_cell(const std::vector<place::SweepAxis>& axes,
                                          const place::SweepResults& results, const std::string& motion = {});

/// Max-F1 by sequence length and search range (SSS Fig. 8), a table for each motion source, the other
/// settings as in its best cell. The first three axes are motion, length and range.
std::vector<HeatTable> heat_tables(const std::vector<place::SweepAxis>& axes,
                                   const place::SweepResults& results);

/// The page: best settings, the fair table, heat tables, curves, every further axis by itself, all cells.
/// `facts` are shown at its top.
std::string sweep_report(const std::vector<place::SweepAxis>& axes, const place::SweepResults& results,
                         const std::string& subtitle,
                         const std::vector<std::pair<std::string, std::string>>& facts,
                         const MethodsTable& methods);

}  // namespace retrace
