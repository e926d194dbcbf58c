// SPDX-License-Identifier: GPL-3.0-or-later
// grid.cpp  Multiplies the stiffness of a grid with a vector, and moves vectors between grids.
#include "bench/continuum/grid.hpp"

#include <Eigen/Dense>
#include <algorithm>

namespace continuum {
namespace {

const ElementStiffness unit;

template <class T>
void clear_held(const Size& n, Field<T>& f) {
  const std::size_t layer = std::size_t(n.x + 1) * (n.y + 1), top = layer * n.z;
  std::fill_n(f.of[2].begin(), layer, std::complex<T>{});
  std::fill_n(f.of[2].begin() + std::ptrdiff_t(top), layer, std::complex<T>{});
}

/// Adds the forces of one row of elements along x. The loops over elements are innermost, so that the compiler
/// vectorises them. They run over real numbers, in which real and imaginary parts alternate, because loops over
/// std::complex are not vectorised.
template <class T>
class RowOfElements {
 public:
  explicit RowOfElements(const Grid<T>& grid)
      : grid_(grid), n_(grid.size), part_(2 * std::size_t(n_.x)), all_(2 * dofs * part_.size()) {
    for (int a = 0; a < dofs; ++a)
      for (int b = 0; b < dofs; ++b) lambda_[a][b] = T(unit.lambda[a][b]), mu_[a][b] = T(unit.mu[a][b]);
  }

  void add(int j, int k, const Field<T>& u, Field<T>& f) {
    const std::size_t words = part_.size();
    T* const volumetric = all_.data();
    T* const shear = volumetric + dofs * words;
    for (int b = 0; b < dofs; ++b) {
      const T* from = displacement(b, j, k, u);
      for (int a = 0; a < dofs; ++a) {
        const T l = lambda_[a][b], m = mu_[a][b];
        T *const va = volumetric + a * words, *const sa = shear + a * words;
        if (b == 0)
          for (std::size_t w = 0; w < words; ++w) va[w] = l * from[w], sa[w] = m * from[w];
        else
          for (std::size_t w = 0; w < words; ++w) va[w] += l * from[w], sa[w] += m * from[w];
      }
    }
    const std::complex<T>* const lambda = grid_.lambda.data() + n_.element(0, j, k);
    const std::complex<T>* const mu = grid_.mu.data() + n_.element(0, j, k);
    for (int a = 0; a < dofs; ++a) {
      const T *const va = volumetric + a * words, *const sa = shear + a * words;
      T* const to = force(a, j, k, f);
      for (int i = 0; i < n_.x; ++i) {
        const T lr = lambda[i].real(), li = lambda[i].imag(), mr = mu[i].real(), mi = mu[i].imag();
        const T vr = va[2 * i], vi = va[2 * i + 1], sr = sa[2 * i], si = sa[2 * i + 1];
        to[2 * i] += lr * vr - li * vi + mr * sr - mi * si;
        to[2 * i + 1] += lr * vi + li * vr + mr * si + mi * sr;
      }
    }
  }

 private:
  std::size_t corner(int a, int j, int k) const {
    const int c = a / 3;
    return n_.node(c & 1, j + (c >> 1 & 1), k + (c >> 2 & 1));
  }
  const T* displacement(int b, int j, int k, const Field<T>& u) const {
    return reinterpret_cast<const T*>(u.of[b % 3].data() + corner(b, j, k));
  }
  T* force(int a, int j, int k, Field<T>& f) const {
    return reinterpret_cast<T*>(f.of[a % 3].data() + corner(a, j, k));
  }

  const Grid<T>& grid_;
  Size n_;
  std::vector<T> part_, all_;
  T lambda_[dofs][dofs], mu_[dofs][dofs];
};

/// Weights with which a fine node takes the values of the coarse nodes left and right of it along one axis.
struct Neighbours {
  int left, right;
  double left_weight, right_weight;
};
Neighbours neighbours(int fine) {
  if (fine % 2 == 0) return {fine / 2, fine / 2, 1, 0};
  return {fine / 2, fine / 2 + 1, 0.5, 0.5};
}

template <class F>
void each_pair(const Size& fine, const Size& coarse, int k, F&& f) {
  const Neighbours z = neighbours(k);
  for (int j = 0; j <= fine.y; ++j) {
    const Neighbours y = neighbours(j);
    for (int i = 0; i <= fine.x; ++i) {
      const Neighbours x = neighbours(i);
      for (int c = 0; c < corners; ++c) {
        const double weight = ((c & 1) != 0 ? x.right_weight : x.left_weight) *
                              ((c & 2) != 0 ? y.right_weight : y.left_weight) *
                              ((c & 4) != 0 ? z.right_weight : z.left_weight);
        if (weight == 0) continue;
        f(fine.node(i, j, k),
          coarse.node((c & 1) != 0 ? x.right : x.left, (c & 2) != 0 ? y.right : y.left,
                      (c & 4) != 0 ? z.right : z.left),
          weight);
      }
    }
  }
}

}  // namespace

template <class T>
void Grid<T>::apply(const Field<T>& u, Field<T>& f, bool faces) const {
  for (auto& component : f.of) std::fill(component.begin(), component.end(), std::complex<T>{});
  for (int odd = 0; odd < 2; ++odd) {  // layers of one parity share no nodes
#pragma omp parallel
    {
      RowOfElements<T> row(*this);
#pragma omp for
      for (int k = odd; k < size.z; k += 2)
        for (int j = 0; j < size.y; ++j) row.add(j, k, u, f);
    }
  }
  if (!faces) clear_held(size, f);
}

template <class T>
std::vector<std::array<std::complex<T>, 9>> Grid<T>::inverse_diagonal() const {
  std::vector<std::array<std::complex<T>, 9>> out(size.nodes());
#pragma omp parallel for
  for (int k = 0; k <= size.z; ++k)
    for (int j = 0; j <= size.y; ++j)
      for (int i = 0; i <= size.x; ++i) {
        Eigen::Matrix3cd sum = Eigen::Matrix3cd::Zero();
        for (int c = 0; c < corners; ++c) {  // the element in which the node is corner c
          const int x = i - (c & 1), y = j - (c >> 1 & 1), z = k - (c >> 2 & 1);
          if (x < 0 || y < 0 || z < 0 || x >= size.x || y >= size.y || z >= size.z) continue;
          const std::size_t e = size.element(x, y, z);
          for (int a = 0; a < 3; ++a)
            for (int b = 0; b < 3; ++b)
              sum(a, b) += Complex(lambda[e]) * unit.lambda[3 * c + a][3 * c + b] +
                           Complex(mu[e]) * unit.mu[3 * c + a][3 * c + b];
        }
        const bool held = k == 0 || k == size.z;
        if (held) sum.row(2).setZero(), sum.col(2).setZero(), sum(2, 2) = 1;
        if (std::abs(sum(0, 0)) == 0) continue;
        Eigen::Matrix3cd inverse = sum.inverse();
        if (held) inverse(2, 2) = 0;
        auto& to = out[size.node(i, j, k)];
        for (int a = 0; a < 3; ++a)
          for (int b = 0; b < 3; ++b) to[3 * a + b] = std::complex<T>(inverse(a, b));
      }
  return out;
}

template <class T>
Grid<T> coarser(const Grid<T>& fine) {
  Grid<T> out;
  out.size = {(fine.size.x + 1) / 2, (fine.size.y + 1) / 2, fine.size.z / 2};
  out.lambda.assign(out.size.elements(), {});
  out.mu = out.lambda;
  for (int k = 0; k < fine.size.z; ++k)
    for (int j = 0; j < fine.size.y; ++j)
      for (int i = 0; i < fine.size.x; ++i) {
        const std::size_t from = fine.size.element(i, j, k), to = out.size.element(i / 2, j / 2, k / 2);
        out.lambda[to] += fine.lambda[from] / T(4);  // 1/4: the mean of 8 elements, times 2 for twice the edge
        out.mu[to] += fine.mu[from] / T(4);
      }
  return out;
}

template <class T>
void add_interpolated(const Size& coarse, const Field<T>& from, const Size& fine, Field<T>& to) {
#pragma omp parallel for
  for (int k = 0; k <= fine.z; ++k)
    each_pair(fine, coarse, k, [&](std::size_t at, std::size_t source, double weight) {
      for (int i = 0; i < 3; ++i) to.of[i][at] += T(weight) * from.of[i][source];
    });
  clear_held(fine, to);
}

template <class T>
void restrict_to(const Size& fine, const Field<T>& from, const Size& coarse, Field<T>& to) {
  for (auto& component : to.of) std::fill(component.begin(), component.end(), std::complex<T>{});
    // A coarse layer takes from the fine layers 2k − 1, 2k and 2k + 1, in this order.
#pragma omp parallel for
  for (int layer = 0; layer <= coarse.z; ++layer)
    for (int k = std::max(0, 2 * layer - 1); k <= std::min(fine.z, 2 * layer + 1); ++k)
      each_pair(fine, coarse, k, [&](std::size_t source, std::size_t at, double weight) {
        if (at / (std::size_t(coarse.x + 1) * (coarse.y + 1)) != std::size_t(layer)) return;
        for (int i = 0; i < 3; ++i) to.of[i][at] += T(weight) * from.of[i][source];
      });
  clear_held(coarse, to);
}

template struct Grid<float>;
template struct Grid<double>;
template Grid<float> coarser(const Grid<float>&);
template void add_interpolated(const Size&, const Field<float>&, const Size&, Field<float>&);
template void restrict_to(const Size&, const Field<float>&, const Size&, Field<float>&);

}  // namespace continuum
