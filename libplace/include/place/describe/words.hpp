#pragma once

#include "place/describe/float_rows.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace place {

/// A vocabulary of local descriptors: the centres of `count` clusters, by FLANN's hierarchical k-means in one
/// level (k-means++ for the start) on a share of the vectors and, from there, a few rounds on all of them.
/// Fewer if there are fewer distinct vectors.
///
/// The same vectors and seed give the same words; the C library's random numbers (`std::rand`), which FLANN
/// uses, are reseeded. Throws `std::invalid_argument` without vectors or for a count of 0. O(5 * vectors *
/// count * width), as products of matrices.
FloatRows learn_words(const FloatRows& vectors, std::size_t count, std::uint32_t seed);

/// The index of the word nearest to each vector; the first among equals. O(vectors * words * width), as one
/// product of matrices. Throws `std::invalid_argument` without words or for words of another size.
std::vector<std::size_t> nearest_words(const FloatRows& vectors, const FloatRows& words);

}  // namespace place
