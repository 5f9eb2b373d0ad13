#pragma once

#include "command.hpp"
#include "truth_options.hpp"

#include <string>
#include <vector>

#include <place/evaluation/sweep_methods.hpp>
#include <place/evaluation/sweep_parts.hpp>

namespace retrace {

struct SweepOptions {
  place::Settings settings;
  CommonOptions common;
  TruthOptions truth;
  std::vector<std::string> query;      ///< files that are one walk
  std::vector<std::string> reference;  ///< the same
  std::string output;
  std::vector<std::string> motions{"sad", "none"};
  std::vector<std::string> lengths;    ///< keyframes; 5, 10, 20, 40 if neither these
  std::vector<std::string> lengths_m;  ///< nor these are given
  std::vector<std::string> ranges{"0", "0.1", "0.2", "0.4", "0.6"};
  std::vector<std::string> vary;
  std::vector<std::string> compare{"motion"};  ///< axes whose values make a method
  bool equal_keyframes = false;
  std::string list;    ///< file of pairs, instead of `query`, `reference` and `truth`
  std::string cell;    ///< I/N: only a part of the cells
  bool merge = false;  ///< put the parts together
};

/// Earlier results, if the output folder holds the same sweep, also those of parts of it (`write_part`);
/// prepares the folder for more. Throws `vo::Error` if the folder holds another sweep and `force` was not
/// given; with force and a part, as others may be at work there.
place::SweepResults resume_sweep(const SweepOptions& options, const std::vector<place::SweepAxis>& axes);

/// Writes a part's results, a file of its own in the folder `cells`.
void write_part(const SweepOptions& options, const std::vector<place::SweepAxis>& axes,
                const place::SweepPart& part, const place::SweepResults& results);

/// Throws `vo::Error` if a cell has no result, saying how many have none.
void check_all_there(const SweepOptions& options, const std::vector<place::SweepAxis>& axes,
                     const place::SweepResults& results);

/// What a part found, on standard output.
void print_part(const SweepOptions& options, const place::SweepPart& part, std::size_t found,
                std::size_t of_all);

/// Removes the parts' files, whose results are in sweep.csv.
void remove_parts(const SweepOptions& options);

/// Writes sweep.csv.
void write_sweep_csv(const SweepOptions& options, const std::vector<place::SweepAxis>& axes,
                     const place::SweepResults& results);

/// Writes report.html, heat_map.png and methods.json, the fair table.
void write_sweep_report(const SweepOptions& options, const std::vector<place::SweepAxis>& axes,
                        const place::SweepResults& results,
                        const std::vector<place::ComparedMethod>& methods);

/// The fair table and the best cell of all, on standard output; as JSON also every cell.
void print_sweep(const SweepOptions& options, const std::vector<place::SweepAxis>& axes,
                 const place::SweepResults& results, const std::vector<place::ComparedMethod>& methods);

}  // namespace retrace
