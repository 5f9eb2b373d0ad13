#include "kernels/absolute_difference.hpp"
#include "kernels/dot_product.hpp"
#include "kernels/float_sums.hpp"

#include <cstdio>
#include <random>
#include <vector>

namespace {

using namespace place::kernels;

std::mt19937 generator(1);

int wrong_absolute_differences() {
  std::vector<std::uint8_t> bytes(30 * 2048);
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(generator());
  int wrong = 0;
  for (const std::size_t size : {1, 15, 16, 17, 31, 33, 64, 100, 2048}) {
    for (std::size_t queries = 0; queries <= 13; ++queries) {
      for (std::size_t references = 0; references <= 9; ++references) {
        const ByteImages query{bytes.data(), queries}, reference{bytes.data() + 14 * size, references};
        const std::size_t stride = references + 2;  // two places more than a kernel may write to
        std::vector<float> expected(queries * stride, -1), sums = expected;
        absolute_difference_scalar(query, reference, {size, size}, {0.1F, expected.data(), stride});
        absolute_difference_neon(query, reference, {size, size}, {0.1F, sums.data(), stride});
        wrong += sums != expected;
      }
    }
  }
  // The largest difference there is: 255 * 100003.
  const std::vector<std::uint8_t> bright(100003, 255), dark(100003, 0);
  float sum = 0;
  absolute_difference_neon({bright.data(), 1}, {dark.data(), 1}, {bright.size(), bright.size()},
                           {1, &sum, 1});
  wrong += sum != 25500765.0F;
  return wrong;
}

/// A tile's sums over values [8, 48) of rows of 64, those of queries of zeros taken off.
std::vector<std::int32_t> dot_products(const DotKernels& kernel, const SignedRows& queries,
                                       const SignedRows& references) {
  const auto packed = [&](const SignedRows& rows, std::size_t lanes, auto pack) {
    std::vector<std::uint8_t> bytes(packed_bytes(kernel.packing, lanes, rows.size));
    pack(kernel.packing, rows, lanes, bytes.data());
    return bytes;
  };
  const auto left = packed(queries, kernel.queries, pack_left),
             right = packed(references, kernel.references, pack_right);
  const auto zeros = packed({nullptr, 0, queries.size}, kernel.queries, pack_left);
  std::vector<std::int32_t> start(kernel.references), sums(kernel.queries * kernel.references);
  for (const auto* of : {&zeros, &left}) {
    kernel.multiply({of->data() + packed_bytes(kernel.packing, kernel.queries, 8),
                     right.data() + packed_bytes(kernel.packing, kernel.references, 8), 40, start.data(),
                     sums.data()});
    for (std::size_t j = 0; j < start.size() && of == &zeros; ++j) start[j] = -sums[j];
  }
  return sums;
}

int wrong_dot_products() {
  constexpr std::size_t kSize = 64;
  const DotKernels &neon = neon_dot_kernels(), &scalar = scalar_dot_kernels();
  std::vector<std::int8_t> left(neon.queries * kSize), right(neon.references * kSize);
  for (auto* rows : {&left, &right}) {
    for (std::int8_t& value : *rows)
      value = static_cast<std::int8_t>(static_cast<int>(generator() % 255) - 127);
  }
  left[9] = right[9] = -127;
  const auto sums =
      dot_products(neon, {left.data(), neon.queries, kSize}, {right.data(), neon.references, kSize});
  int wrong = 0;
  for (std::size_t i = 0; i < neon.queries; ++i) {
    for (std::size_t j = 0; j < neon.references; ++j) {
      const auto one =
          dot_products(scalar, {left.data() + i * kSize, 1, kSize}, {right.data() + j * kSize, 1, kSize});
      wrong += one[0] != sums[i * neon.references + j];
    }
  }
  // From sums to costs, of any ten sums.
  const std::size_t wide = neon.references;
  std::vector<std::int32_t> ten(10 * wide);
  for (std::int32_t& sum : ten) sum = static_cast<std::int32_t>(generator() % 2'000'000) - 1'000'000;
  std::vector<float> query_scales(5, 1e-3F), reference_scales(5 * wide), costs(wide);
  for (float& scale : reference_scales) scale = 1e-3F / static_cast<float>(1 + generator() % 7);
  for (const bool of_five : {false, true}) {
    (of_five ? neon.costs_of_five
             : neon.costs)({ten.data(), wide, 5, query_scales.data(), reference_scales.data(), costs.data()});
    for (std::size_t j = 0; j < wide; ++j) {
      std::vector<std::int32_t> own(10);
      std::vector<float> own_scales(5);
      for (std::size_t k = 0; k < 10; ++k) own[k] = ten[k * wide + j];
      for (std::size_t k = 0; k < 5; ++k) own_scales[k] = reference_scales[k * wide + j];
      float expected = 0;
      (of_five ? scalar.costs_of_five
               : scalar.costs)({own.data(), 1, 5, query_scales.data(), own_scales.data(), &expected});
      wrong += costs[j] != expected;
    }
  }
  return wrong;
}

int wrong_float_sums() {
  constexpr std::size_t kSize = 100;
  const FloatKernels &neon = neon_float_kernels(), &scalar = scalar_float_kernels();
  std::normal_distribution<float> normal;
  std::vector<float> queries(kSize * neon.queries), references(kSize * neon.references);
  for (auto* rows : {&queries, &references}) {
    for (float& value : *rows) value = normal(generator);
  }
  int wrong = 0;
  for (const Term term : {Term::kProduct, Term::kAbsoluteDifference, Term::kSquaredDifference}) {
    std::vector<float> sums(neon.queries * neon.references), costs(neon.references);
    neon.add(term, {queries.data(), references.data(), kSize, sums.data()});
    neon.costs({sums.data(), nullptr, 0.3F, false, 64, costs.data()});
    for (std::size_t i = 0; i < neon.queries; ++i) {
      for (std::size_t j = 0; j < neon.references; ++j) {
        std::vector<float> query, reference;
        for (std::size_t k = 0; k < kSize; ++k) {
          query.push_back(queries[k * neon.queries + i]);
          reference.push_back(references[k * neon.references + j]);
        }
        float sum = 0, cost = 0;
        scalar.add(term, {query.data(), reference.data(), kSize, &sum});
        scalar.costs({&sum, nullptr, 0.3F, false, 64, &cost});
        wrong += sum != sums[i * neon.references + j];
        wrong += i == 0 && cost != costs[j];
      }
    }
  }
  return wrong;
}

}  // namespace

/// The NEON kernels against the plain loops; cross-compiled, so without GoogleTest.
int main() {
  const int differences = wrong_absolute_differences(), products = wrong_dot_products(),
            floats = wrong_float_sums();
  std::printf("wrong: %d blocks of absolute differences, %d dot products, %d sums of floats\n", differences,
              products, floats);
  return differences + products + floats == 0 ? 0 : 1;
}
