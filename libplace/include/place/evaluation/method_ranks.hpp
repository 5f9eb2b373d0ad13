#pragma once

#include <optional>
#include <vector>

namespace place {

/// The mean rank of each method over several data sets (Demsar, "Statistical comparisons of classifiers over
/// multiple data sets", 2006, section 3.2.2). `figures[d][m]`: of method m on data set d, higher is better;
/// none if it cannot be run there, which ranks last. 1 is the best; equal figures share the mean of their
/// ranks. Throws `std::invalid_argument` unless every data set has a figure or none for every method. Empty
/// without data sets. O(data sets * methods^2).
std::vector<double> mean_ranks(const std::vector<std::vector<std::optional<double>>>& figures);

}  // namespace place
