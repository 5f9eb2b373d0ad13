#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <benchmark/benchmark.h>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

/// The limit of costs of columns: dot products of bytes that never leave the first-level cache.
namespace bench {

inline constexpr std::size_t kDotLimitBytes = 8192;

#if defined(__x86_64__)
/// One operand from memory for every instruction, as `multiply_tile` has at most.
[[gnu::target("avx512f,avx512bw,avx512vnni")]] inline void dot_limit_vnni(const std::uint8_t* bytes,
                                                                          int rounds) {
  constexpr std::size_t kSums = 16;  // more than the instruction's latency
  const __m512i query = _mm512_load_si512(bytes);
  __m512i sums[kSums];
#pragma GCC unroll 16
  for (std::size_t i = 0; i < kSums; ++i) sums[i] = query;
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t k = 0; k < kDotLimitBytes; k += sizeof sums) {
#pragma GCC unroll 16
      for (std::size_t i = 0; i < kSums; ++i) {
        const auto* const other = reinterpret_cast<const __m512i*>(bytes + k + i * sizeof query);
        // The intrinsic makes GCC copy sums from register to register.
        asm volatile("vpdpbusd %2, %1, %0" : "+v"(sums[i]) : "v"(query), "m"(*other));
      }
    }
    benchmark::ClobberMemory();
  }
  __m512i all = sums[0];
#pragma GCC unroll 16
  for (std::size_t i = 1; i < kSums; ++i) all = _mm512_add_epi32(all, sums[i]);
  benchmark::DoNotOptimize(all);
}
#endif

inline void dot_limit(benchmark::State& state) {
  constexpr int kRounds = 1'000'000;
#if defined(__x86_64__)
  alignas(64) const std::array<std::uint8_t, kDotLimitBytes> bytes{};
  if (!__builtin_cpu_supports("avx512vnni")) {
    state.SkipWithError("needs AVX-512 VNNI");
    return;
  }
  for (auto _ : state) dot_limit_vnni(bytes.data(), kRounds);
  state.SetBytesProcessed(state.iterations() * kRounds * static_cast<std::int64_t>(kDotLimitBytes));
#else
  state.SkipWithError("written for x86-64 only");
#endif
}

}  // namespace bench
