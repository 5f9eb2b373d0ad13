#include "odometry_sweep_table.hpp"

#include <fmt/format.h>

namespace retrace {

std::string odometry_sweep_csv(const std::string& setting, const std::vector<place::OdometrySweepRow>& rows) {
  std::string csv =
      setting +
      ",at_m,measurements,steps_estimated,step_error_pct,euclidean_error_m,euclidean_error_sd_m,"
      "heading_error_deg,heading_error_sd_deg,heading_absolute_error_deg,e_p_pct,e_std_pct,h_d_deg,"
      "h_std_deg\n";
  for (const place::OdometrySweepRow& row : rows) {
    for (std::size_t i = 0; i < row.evaluation.errors.size(); ++i) {
      const place::OdometryErrors& e = row.evaluation.errors[i];
      if (e.count == 0) continue;
      const place::OdometryImprovement better = place::improvement(e, rows.front().evaluation.errors[i]);
      csv += fmt::format(
          "{},{},{},{},{},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{:.3f},{:.3f},{:.3f},{:.3f}\n", row.value,
          e.at_m, e.count, row.steps, row.step_errors ? fmt::format("{:.4f}", row.step_errors->pct) : "",
          e.euclidean_mean_m, e.euclidean_sd_m, e.heading_mean_deg, e.heading_sd_deg, e.heading_abs_mean_deg,
          better.euclidean_pct, better.euclidean_sd_pct, better.heading_deg, better.heading_sd_deg);
    }
  }
  return csv;
}

std::string odometry_sweep_table(const std::string& setting,
                                 const std::vector<place::OdometrySweepRow>& rows) {
  const std::vector<place::OdometryErrors>& base = rows.front().evaluation.errors;
  std::string table =
      fmt::format("{:>16} {:>5} {:>12} {:>16} {:>18} {:>7} {:>7} {:>7} {:>7}\n", setting, "at m",
                  "measurements", "position m", "heading deg", "E-P", "E-STD", "H-D", "H-STD");
  for (std::size_t i = 0; i < base.size(); ++i) {
    const bool last = i + 1 == base.size() || base[i + 1].count == 0;
    if (base[i].count == 0 || (!last && base[i].at_m != 50)) continue;
    for (const place::OdometrySweepRow& row : rows) {
      const place::OdometryErrors& e = row.evaluation.errors[i];
      const place::OdometryImprovement better = place::improvement(e, base[i]);
      table += fmt::format(
          "{:>16} {:>5} {:>12} {:>16} {:>18} {:>7.1f} {:>7.1f} {:>7.1f} {:>7.1f}\n", row.value, e.at_m,
          e.count, fmt::format("{:.2f} +- {:.2f}", e.euclidean_mean_m, e.euclidean_sd_m),
          fmt::format("{:.2f} +- {:.2f}", e.heading_mean_deg, e.heading_sd_deg), better.euclidean_pct,
          better.euclidean_sd_pct, better.heading_deg, better.heading_sd_deg);
    }
  }
  return table;
}

}  // namespace retrace
