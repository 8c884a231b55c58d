// Gauss and Legendre's quadrature with four points on [-1, 1]: exact for polynomials up to
// degree 7.
#pragma once

#include <array>

namespace haarmony::curve {

inline constexpr std::array<double, 4> kGaussPlace = {-0.86113631159405257522,
                                                      -0.33998104358485626480,
                                                      0.33998104358485626480,
                                                      0.86113631159405257522};
inline constexpr std::array<double, 4> kGaussWeight = {0.34785484513745385737,
                                                       0.65214515486254614263,
                                                       0.65214515486254614263,
                                                       0.34785484513745385737};

}  // namespace haarmony::curve
