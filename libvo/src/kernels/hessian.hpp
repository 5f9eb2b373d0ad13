#pragma once

#include "kernels/kernels.hpp"

namespace vo::kernels {

/// Bay et al. 2008, Fig. 2 and Eq. 3: Dyy is two boxes of 2l-1 columns by l rows minus twice the one between
/// them, which is the whole minus three times the middle; Dxy is four boxes of l by l with a gap of 1.
template <class Lanes>
void hessian_row(const HessianRow& row) {
  const std::ptrdiff_t l = row.lobe_px, reach = (3 * l - 1) / 2;
  const auto integral_row = [&](std::ptrdiff_t dy) { return row.integral + dy * row.stride; };
  const std::uint32_t* const yy[] = {integral_row(-reach), integral_row(-reach + l),
                                     integral_row(-reach + 2 * l), integral_row(reach + 1)};
  const std::uint32_t* const xx[] = {integral_row(1 - l), integral_row(l)};
  const std::uint32_t* const xy[] = {integral_row(-l), integral_row(0), integral_row(1), integral_row(l + 1)};
  // What each derivative sums along the columns, at every column once.
  std::uint32_t* const yy_sum = row.scratch;
  std::uint32_t* const xx_sum = yy_sum + row.scratch_stride;
  std::uint32_t* const xy_sum = xx_sum + row.scratch_stride;
  const auto three = [](typename Lanes::Int a) { return Lanes::add(a, Lanes::add(a, a)); };
  for (std::ptrdiff_t x = row.begin - reach; x <= row.end + reach; x += Lanes::kCount) {
    const auto at = [&](const std::uint32_t* from) { return Lanes::load(from + x); };
    Lanes::store(yy_sum + x,
                 Lanes::sub(Lanes::sub(at(yy[3]), at(yy[0])), three(Lanes::sub(at(yy[2]), at(yy[1])))));
    Lanes::store(xx_sum + x, Lanes::sub(at(xx[1]), at(xx[0])));
    Lanes::store(xy_sum + x, Lanes::sub(Lanes::sub(at(xy[1]), at(xy[0])), Lanes::sub(at(xy[3]), at(xy[2]))));
  }
  const auto scale = Lanes::all(row.scale);
  const auto cross_weight = Lanes::all(0.81F);  // 0.9^2: Eq. 3
  for (std::ptrdiff_t x = row.begin; x < row.end; x += Lanes::kCount) {
    const auto at = [&](const std::uint32_t* from, std::ptrdiff_t dx) { return Lanes::load(from + x + dx); };
    const auto yy_int = Lanes::sub(at(yy_sum, l), at(yy_sum, 1 - l));
    const auto xx_int = Lanes::sub(Lanes::sub(at(xx_sum, reach + 1), at(xx_sum, -reach)),
                                   three(Lanes::sub(at(xx_sum, 2 * l - reach), at(xx_sum, l - reach))));
    const auto xy_int =
        Lanes::sub(Lanes::sub(at(xy_sum, 0), at(xy_sum, -l)), Lanes::sub(at(xy_sum, l + 1), at(xy_sum, 1)));
    const auto dxx = Lanes::mul(Lanes::to_float(xx_int), scale);
    const auto dyy = Lanes::mul(Lanes::to_float(yy_int), scale);
    const auto dxy = Lanes::mul(Lanes::to_float(xy_int), scale);
    Lanes::store(row.out + x,
                 Lanes::sub(Lanes::mul(dxx, dyy), Lanes::mul(cross_weight, Lanes::mul(dxy, dxy))));
  }
}

template <class Lanes>
int maxima_row(const MaximaRow& row, int* columns) {
  const auto threshold = Lanes::all(row.threshold);
  int count = 0;
  for (int x = row.begin; x < row.end; x += Lanes::kCount) {
    const auto centre = Lanes::load(row.rows[1][1] + x);
    unsigned bits = Lanes::greater_equal(centre, threshold);
    if (row.end - x < Lanes::kCount) bits &= (1U << (row.end - x)) - 1;
    // The nearest neighbours first: they rule out most.
    if (bits != 0) bits &= Lanes::greater(centre, Lanes::load(row.rows[1][1] + x - 1));
    if (bits != 0) bits &= Lanes::greater_equal(centre, Lanes::load(row.rows[1][1] + x + 1));
    for (int dx = -1; dx <= 1 && bits != 0; ++dx) {
      bits &= Lanes::greater(centre, Lanes::load(row.rows[1][0] + x + dx)) &
              Lanes::greater_equal(centre, Lanes::load(row.rows[1][2] + x + dx));
    }
    for (int r = 0; r < 3 && bits != 0; ++r) {
      for (int dx = -1; dx <= 1; ++dx) {
        bits &= Lanes::greater(centre, Lanes::load(row.rows[0][r] + x + dx)) &
                Lanes::greater_equal(centre, Lanes::load(row.rows[2][r] + x + dx));
      }
    }
    for (; bits != 0; bits &= bits - 1) columns[count++] = x + __builtin_ctz(bits);
  }
  return count;
}

}  // namespace vo::kernels
