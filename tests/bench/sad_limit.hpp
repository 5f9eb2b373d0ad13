#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <benchmark/benchmark.h>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

/// The limit of the cost matrix: sums of absolute differences of bytes that never leave the first-level
/// cache.
namespace bench {

inline constexpr std::size_t kLimitBytes = 8192;

#if defined(__x86_64__)

[[gnu::target("avx512f,avx512bw")]] inline void sad_limit_avx512(const std::uint8_t* bytes, int rounds) {
  const __m512i query = _mm512_load_si512(bytes);
  __m512i sums[8] = {query, query, query, query, query, query, query, query};
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t k = 0; k < kLimitBytes; k += sizeof sums) {
      for (std::size_t i = 0; i < 8; ++i) {
        const __m512i other = _mm512_load_si512(bytes + k + i * sizeof query);
        sums[i] = _mm512_add_epi64(sums[i], _mm512_sad_epu8(query, other));
      }
    }
    benchmark::ClobberMemory();
  }
  for (__m512i& sum : sums) benchmark::DoNotOptimize(sum);
}

[[gnu::target("avx2")]] inline void sad_limit_avx2(const std::uint8_t* bytes, int rounds) {
  const __m256i query = _mm256_load_si256(reinterpret_cast<const __m256i*>(bytes));
  __m256i sums[8] = {query, query, query, query, query, query, query, query};
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t k = 0; k < kLimitBytes; k += sizeof sums) {
      for (std::size_t i = 0; i < 8; ++i) {
        const __m256i other =
            _mm256_load_si256(reinterpret_cast<const __m256i*>(bytes + k + i * sizeof query));
        sums[i] = _mm256_add_epi64(sums[i], _mm256_sad_epu8(query, other));
      }
    }
    benchmark::ClobberMemory();
  }
  for (__m256i& sum : sums) benchmark::DoNotOptimize(sum);
}

#endif

/// The rate of each thread, by the instructions that the library takes on this processor.
inline void sad_limit(benchmark::State& state) {
#if defined(__x86_64__)
  alignas(64) const std::array<std::uint8_t, kLimitBytes> bytes{};
  const bool wide = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw");
  if (!wide && !__builtin_cpu_supports("avx2")) state.SkipWithError("needs AVX2");
  constexpr int kRounds = 3'200'000;  // as many bytes as 3576 x 3576 thumbnails, so as long as their matrix
  for (auto _ : state) (wide ? sad_limit_avx512 : sad_limit_avx2)(bytes.data(), kRounds);
  state.SetBytesProcessed(state.iterations() * kRounds * static_cast<std::int64_t>(kLimitBytes));
#else
  state.SkipWithError("written for x86-64 only");
#endif
}

}  // namespace bench
