#include "match/kernels/absolute_difference.hpp"

#include <cstdio>
#include <random>
#include <vector>

/// The NEON kernel against the plain loop; cross-compiled, so without GoogleTest.
int main() {
  std::mt19937 random(1);
  std::vector<std::uint8_t> bytes(30 * 2048);
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
  int wrong = 0;
  for (const std::size_t size : {1, 15, 16, 17, 31, 33, 64, 100, 2048}) {
    for (std::size_t queries = 0; queries <= 13; ++queries) {
      for (std::size_t references = 0; references <= 9; ++references) {
        const place::kernels::ByteImages query{bytes.data(), queries},
            reference{bytes.data() + 14 * size, references};
        const std::size_t stride = references + 2;  // two places more than a kernel may write to
        std::vector<float> expected(queries * stride, -1), sums = expected;
        place::kernels::absolute_difference_scalar(query, reference, size, {0.1F, expected.data(), stride});
        place::kernels::absolute_difference_neon(query, reference, size, {0.1F, sums.data(), stride});
        wrong += sums != expected;
      }
    }
  }
  // The largest difference there is: 255 * 100003.
  const std::vector<std::uint8_t> bright(100003, 255), dark(100003, 0);
  float sum = 0;
  place::kernels::absolute_difference_neon({bright.data(), 1}, {dark.data(), 1}, bright.size(), {1, &sum, 1});
  wrong += sum != 25500765.0F;
  std::printf("%d blocks of sums are wrong\n", wrong);
  return wrong == 0 ? 0 : 1;
}
