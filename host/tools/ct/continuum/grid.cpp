// SPDX-License-Identifier: GPL-3.0-or-later
// grid.cpp  Multiplies the stiffness of a grid with a vector, without a matrix.
#include "host/tools/ct/continuum/grid.hpp"

#include <algorithm>

#include "host/tools/ct/continuum/element.hpp"

namespace macadam::continuum {
namespace {

static_assert(packet_bytes <= padding * sizeof(std::complex<float>));

/// Adds the forces of one row of elements along x. Packets are computed first; the forces at the left and at the right
/// end of the elements are then added to the nodes. An addition of packets would wait for the packet before, because
/// both change the node between them.
template <class T>
class RowOfElements {
 public:
  explicit RowOfElements(const Grid<T>& grid)
      : grid_(grid), n_(grid.size), stride_(std::size_t(n_.x) + padding), forces_(dofs * stride_) {}

  void add(int j, int k, const Field<T>& u, Field<T>& f) {
    using P = Packet<T>;
    const std::complex<T>* const lambda = grid_.lambda.data() + n_.element(0, j, k);
    const std::complex<T>* const mu = grid_.mu.data() + n_.element(0, j, k);
    const T height = T(grid_.height[std::size_t(k)]);
    for (int i = 0; i < n_.x; i += int(P::numbers)) {
      P packet[3][corners];
      for (int a = 0; a < 3; ++a)
        for (int c = 0; c < corners; ++c) packet[a][c] = P::load(u.of[a].data() + corner(c, j, k) + i);
      multiply_stiffness(packet, PacketFactor<T>(P::load(lambda + i)), PacketFactor<T>(P::load(mu + i)), height);
      for (int a = 0; a < 3; ++a)
        for (int c = 0; c < corners; ++c) packet[a][c].store(&forces_[(3 * c + a) * stride_ + i]);
    }
    for (int a = 0; a < 3; ++a)
      for (int c = 0; c < corners; c += 2) {
        T* const to = reinterpret_cast<T*>(f.of[a].data() + corner(c, j, k));
        const T* const left = reinterpret_cast<const T*>(&forces_[(3 * c + a) * stride_]);
        const T* const right = reinterpret_cast<const T*>(&forces_[(3 * (c + 1) + a) * stride_]);
        const int words = 2 * n_.x;
        to[0] += left[0], to[1] += left[1];
        for (int w = 2; w < words; ++w) to[w] += left[w] + right[w - 2];
        to[words] += right[words - 2], to[words + 1] += right[words - 1];
      }
  }

 private:
  std::size_t corner(int c, int j, int k) const { return n_.node(c & 1, j + (c >> 1 & 1), k + (c >> 2 & 1)); }

  const Grid<T>& grid_;
  Size n_;
  std::size_t stride_;
  std::vector<std::complex<T>> forces_;  ///< [unknown][element]
};

}  // namespace

template <class T>
void clear_held(const Size& n, Field<T>& f) {
  std::fill_n(f.of[2].begin(), n.layer(), std::complex<T>{});
  std::fill_n(f.of[2].begin() + std::ptrdiff_t(n.layer() * n.z), n.layer(), std::complex<T>{});
}

template <class T>
void Grid<T>::apply(const Field<T>& u, Field<T>& f, bool faces) const {
#pragma omp parallel if (size.is_large())
  {
    RowOfElements<T> row(*this);
    for (int odd = 0; odd < 2; ++odd)  // layers of one parity share no nodes
#pragma omp for schedule(static)
      for (int k = odd; k < size.z + 1; k += 2) {
        if (odd == 0)  // the layers of nodes k and k + 1 get their first forces here
          for (auto& component : f.of) {
            const auto begin = component.begin() + std::ptrdiff_t(size.layer() * k);
            std::fill_n(begin, size.layer() * std::size_t(k < size.z ? 2 : 1), std::complex<T>{});
          }
        for (int j = 0; k < size.z && j < size.y; ++j) row.add(j, k, u, f);
      }
  }
  if (!faces) clear_held(size, f);
}

template <class T>
Field<T> Grid<T>::inverse_diagonal() const {
  Field<T> out(size.nodes());
  std::vector<std::array<double, 6>> unit;  // per layer: the diagonal of lambda and of mu, equal at all corners
  for (const double h : height) {
    const ElementStiffness of(h);
    unit.push_back({of.lambda[0][0], of.lambda[1][1], of.lambda[2][2], of.mu[0][0], of.mu[1][1], of.mu[2][2]});
  }
#pragma omp parallel for schedule(static) if (size.is_large())
  for (int k = 0; k <= size.z; ++k)
    for (int j = 0; j <= size.y; ++j)
      for (int i = 0; i <= size.x; ++i) {
        Complex sum[3];
        for (int c = 0; c < corners; ++c) {  // the element in which the node is corner c
          const int x = i - (c & 1), y = j - (c >> 1 & 1), z = k - (c >> 2 & 1);
          if (x < 0 || y < 0 || z < 0 || x >= size.x || y >= size.y || z >= size.z) continue;
          const std::size_t e = size.element(x, y, z);
          const auto& factor = unit[std::size_t(z)];
          for (int a = 0; a < 3; ++a) sum[a] += Complex(lambda[e]) * factor[a] + Complex(mu[e]) * factor[3 + a];
        }
        for (int a = 0; a < 3; ++a)
          if (sum[a] != Complex{}) out.of[a][size.node(i, j, k)] = std::complex<T>(1.0 / sum[a]);
      }
  clear_held(size, out);
  return out;
}

template struct Grid<float>;
template struct Grid<double>;
template void clear_held(const Size&, Field<float>&);
template void clear_held(const Size&, Field<double>&);

}  // namespace macadam::continuum
