// SPDX-License-Identifier: GPL-3.0-or-later
// transfer.cpp  Moves vectors between grids: row by row, with linear interpolation along each axis.
#include "host/tools/ct/continuum/transfer.hpp"

#include <algorithm>

namespace macadam::continuum {
namespace {

/// The coarse node left of a fine node along one axis, its weight, and the weight of the next coarse node.
struct Neighbours {
  int left = 0;
  double left_weight = 1, right_weight = 0;
};
/// Returns the neighbours of a node along x or y.
Neighbours of_equal(int fine) {
  if (fine % 2 == 0) return {fine / 2, 1, 0};
  return {fine / 2, 0.5, 0.5};
}
/// Returns the neighbours of a node along z.
Neighbours of_layers(int fine, const std::vector<double>& height) {
  if (fine % 2 == 0) return {fine / 2, 1, 0};
  if (fine == int(height.size())) return {fine / 2 + 1, 1, 0};  // the top of an odd number of layers
  const double below = height[std::size_t(fine) - 1], above = height[std::size_t(fine)];
  return {fine / 2, above / (below + above), below / (below + above)};
}

/// Calls f(fine row, weight) for the fine rows of nodes that exchange values with a coarse row, in a fixed order.
template <class F>
void each_fine_row(const Size& fine, const std::vector<double>& height, int row, int layer, F&& f) {
  for (int k = std::max(0, 2 * layer - 1); k <= std::min(fine.z, 2 * layer + 1); ++k) {
    const Neighbours z = of_layers(k, height);
    const double wz = z.left == layer ? z.left_weight : z.left + 1 == layer ? z.right_weight : 0;
    for (int j = std::max(0, 2 * row - 1); wz != 0 && j <= std::min(fine.y, 2 * row + 1); ++j)
      f(fine.node(0, j, k), wz * (j == 2 * row ? 1 : 0.5));
  }
}

}  // namespace

template <class T>
Grid<T> coarser(const Grid<T>& fine) {
  const Size n = fine.size;
  Grid<T> out(Size{(n.x + 1) / 2, (n.y + 1) / 2, (n.z + 1) / 2});
  for (int k = 0; k < n.z; ++k) {
    const std::size_t layer = std::size_t(k) / 2;
    const bool is_pair = (k | 1) < n.z;
    out.height[layer] = (fine.height[2 * layer] + (is_pair ? fine.height[2 * layer + 1] : 0)) / 2;
    // The average over the volume, twice as large because edges are twice as long.
    const T weight = T(fine.height[std::size_t(k)] / (4 * out.height[layer]));
    for (int j = 0; j < n.y; ++j)
      for (int i = 0; i < n.x; ++i) {
        const std::size_t from = n.element(i, j, k), to = out.size.element(i / 2, j / 2, k / 2);
        out.lambda[to] += fine.lambda[from] * weight;
        out.mu[to] += fine.mu[from] * weight;
      }
  }
  return out;
}

template <class S, class T>
void add_interpolated(const Size& coarse, const Field<S>& from, const Grid<T>& fine, Field<T>& to) {
  const Size n = fine.size;
#pragma omp parallel if (n.is_large())
  {
    std::vector<std::complex<T>> row(std::size_t(coarse.x) + 1);
#pragma omp for
    for (int k = 0; k <= n.z; ++k)
      for (int j = 0; j <= n.y; ++j) {
        const Neighbours y = of_equal(j), z = of_layers(k, fine.height);
        for (int a = 0; a < 3; ++a) {
          std::fill(row.begin(), row.end(), std::complex<T>{});
          for (int c = 0; c < 4; ++c) {
            const double weight =
                ((c & 1) != 0 ? y.right_weight : y.left_weight) * ((c & 2) != 0 ? z.right_weight : z.left_weight);
            if (weight == 0) continue;
            const std::complex<S>* const source = &from.of[a][coarse.node(0, y.left + (c & 1), z.left + (c >> 1))];
            for (std::size_t i = 0; i < row.size(); ++i) row[i] += T(weight) * std::complex<T>(source[i]);
          }
          std::complex<T>* const out = &to.of[a][n.node(0, j, k)];
          for (int i = 0; i <= n.x; i += 2) out[i] += row[std::size_t(i) / 2];
          for (int i = 1; i <= n.x; i += 2) out[i] += (row[std::size_t(i) / 2] + row[std::size_t(i) / 2 + 1]) * T(0.5);
        }
      }
  }
  clear_held(n, to);
}

template <class T>
void restrict_to(const Grid<T>& fine, const Field<T>& from, const Size& coarse, Field<T>& to) {
  const Size n = fine.size;
#pragma omp parallel if (n.is_large())
  {
    std::vector<std::complex<T>> row(std::size_t(n.x) + 1);
#pragma omp for
    for (int layer = 0; layer <= coarse.z; ++layer)
      for (int j = 0; j <= coarse.y; ++j)
        for (int a = 0; a < 3; ++a) {
          std::fill(row.begin(), row.end(), std::complex<T>{});
          each_fine_row(n, fine.height, j, layer, [&](std::size_t first, double weight) {
            const std::complex<T>* const source = &from.of[a][first];
            for (std::size_t i = 0; i < row.size(); ++i) row[i] += T(weight) * source[i];
          });
          std::complex<T>* const out = &to.of[a][coarse.node(0, j, layer)];
          for (int i = 0; i <= coarse.x; ++i) {
            std::complex<T> sum = 2 * i <= n.x ? row[std::size_t(2 * i)] : std::complex<T>{};
            if (i > 0) sum += row[std::size_t(2 * i - 1)] * T(0.5);
            if (2 * i + 1 <= n.x) sum += row[std::size_t(2 * i + 1)] * T(0.5);
            out[i] = sum;
          }
        }
  }
  clear_held(coarse, to);
}

template Grid<float> coarser(const Grid<float>&);
template void add_interpolated(const Size&, const Field<float>&, const Grid<float>&, Field<float>&);
template void add_interpolated(const Size&, const Field<double>&, const Grid<double>&, Field<double>&);
template void restrict_to(const Grid<float>&, const Field<float>&, const Size&, Field<float>&);

}  // namespace macadam::continuum
