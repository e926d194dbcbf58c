// SPDX-License-Identifier: GPL-3.0-or-later
// cholesky.cpp  Factors the matrix. METIS computes an order of the particles, not of the degrees of freedom, so its
// graph has six times fewer nodes. CHOLMOD treats supernodes (groups of columns with the same structure) as dense
// blocks.
#include "host/harmonic/direct/cholesky.hpp"

#include <cholmod.h>
#include <fmt/format.h>
#include <metis.h>
#include <sys/mman.h>

#include <cstdlib>
#include <new>

#include "macadam/error.hpp"

/// Only OpenBLAS defines this function. The weak symbol is null with other BLAS libraries.
extern "C" __attribute__((weak)) void openblas_set_num_threads(int threads);
/// Part of every BLAS library: C = alpha·A·B + beta·C.
extern "C" void dgemm_(const char*, const char*, const int* m, const int* n, const int* k, const double* alpha,
                       const double* a, const int* lda, const double* b, const int* ldb, const double* beta, double* c,
                       const int* ldc);

namespace macadam::harmonic {
namespace {

/// Returns the position of each particle in an order that keeps the factors sparse; if METIS fails, the given order is
/// kept.
std::vector<std::int32_t> nested_dissection(const ContactNetwork& network, std::size_t particles) {
  std::vector<idx_t> begin{0}, neighbour;
  for (std::size_t i = 0; i < particles; ++i) {
    for (const std::uint32_t number : network.row(i)) {
      const Contact& c = network.contacts[number];
      if (c.b >= 0) neighbour.push_back(c.a == static_cast<std::int32_t>(i) ? c.b : c.a);
    }
    begin.push_back(static_cast<idx_t>(neighbour.size()));
  }
  std::vector<idx_t> order(particles), place(particles);
  auto nodes = static_cast<idx_t>(particles);
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  if (neighbour.empty() ||
      METIS_NodeND(&nodes, begin.data(), neighbour.data(), nullptr, options, order.data(), place.data()) != METIS_OK) {
    for (std::size_t i = 0; i < particles; ++i) place[i] = static_cast<idx_t>(i);
  }
  return {place.begin(), place.end()};
}

/// Gives OpenBLAS one thread, unless the environment sets OPENBLAS_NUM_THREADS. OpenBLAS divides matrix products among
/// its threads, so the last digits of the factors would depend on the number of threads. The threads of OpenBLAS would
/// also exceed the number of threads that a job may use. More threads would not help either: most supernodes are small,
/// and 16 threads took twice as long as four.
void limit_blas_threads() {
  if (openblas_set_num_threads && !std::getenv("OPENBLAS_NUM_THREADS")) openblas_set_num_threads(1);
}

/// Makes OpenBLAS allocate its buffer. OpenBLAS maps the buffer at its first call and keeps it; if memory does not
/// suffice, it retries forever. So this function first checks that memory for the buffer can be mapped, and then makes
/// a call.
/// \throws std::bad_alloc.
void make_room_for_blas() {
  constexpr std::size_t buffer = std::size_t{32} << 22;  // bytes: the largest buffer of OpenBLAS's builds for x86-64
  void* room = ::mmap(nullptr, buffer, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (room == MAP_FAILED) throw std::bad_alloc();
  ::munmap(room, buffer);
  limit_blas_threads();
  constexpr int n = 128;  // smaller products may not use the buffer
  const std::vector<double> a(n * n, 1);
  std::vector<double> c(n * n);
  const double one = 1, zero = 0;
  dgemm_("N", "N", &n, &n, &n, &one, a.data(), &n, a.data(), &n, &zero, c.data(), &n);
}

/// Returns CHOLMOD's view of a lower triangle in compressed columns; the data are not copied.
cholmod_sparse view(Eigen::SparseMatrix<double>& matrix) {
  cholmod_sparse out{};
  out.nrow = out.ncol = static_cast<std::size_t>(matrix.rows());
  out.nzmax = static_cast<std::size_t>(matrix.nonZeros());
  out.p = matrix.outerIndexPtr();
  out.i = matrix.innerIndexPtr();
  out.x = matrix.valuePtr();
  out.stype = -1;
  out.itype = CHOLMOD_INT;
  out.xtype = CHOLMOD_REAL;
  out.dtype = CHOLMOD_DOUBLE;
  out.sorted = out.packed = 1;
  return out;
}

}  // namespace

struct Cholesky::Factor {
  cholmod_common common{};
  cholmod_factor* factor = nullptr;
  std::vector<std::int32_t> place;
  cholmod_dense *right = nullptr, *x = nullptr, *work_y = nullptr, *work_e = nullptr;

  Factor() {
    make_room_for_blas();
    cholmod_start(&common);
  }
  /// Checks the status of CHOLMOD's last call. `what` names the operation in the message. \throws RunError if the call
  /// failed.
  void require(const char* what, std::size_t particles) const {
    if (common.status >= CHOLMOD_OK) return;
    const char* why = common.status == CHOLMOD_OUT_OF_MEMORY ? "not enough memory"
                      : common.status == CHOLMOD_TOO_LARGE   ? "more entries than 32-bit indices can number"
                                                             : "CHOLMOD failed";
    throw RunError(fmt::format("harmonic: {} of {} particles: {}", what, particles, why));
  }
  ~Factor() {
    cholmod_free_factor(&factor, &common);
    for (auto* dense : {&right, &x, &work_y, &work_e}) cholmod_free_dense(dense, &common);
    cholmod_finish(&common);
  }
};

Cholesky::Cholesky(const ContactNetwork& network, std::size_t particles, const PairStiffness& stiffness,
                   const std::vector<Pin>& pins)
    : factor_(std::make_unique<Factor>()) {
  Factor& f = *factor_;
  f.place = nested_dissection(network, particles);
  Eigen::SparseMatrix<double> matrix = assemble_lower(network, stiffness, f.place, pins);
  cholmod_sparse sparse = view(matrix);
  f.common.nmethods = 1;
  // the particles are ordered already; CHOLMOD's postordering does not add fill-in
  f.common.method[0].ordering = CHOLMOD_NATURAL;
  f.common.supernodal = CHOLMOD_SUPERNODAL;
  f.common.print = 0;
  f.factor = cholmod_analyze(&sparse, &f.common);
  if (f.factor) cholmod_factorize(&sparse, f.factor, &f.common);
  f.require("factoring the stiffness", particles);
  if (f.common.status == CHOLMOD_NOT_POSDEF || f.factor->minor < f.factor->n) {
    const auto row = static_cast<std::int32_t>(f.factor->minor / 6);
    std::size_t particle = 0;
    while (particle + 1 < f.place.size() && f.place[particle] != row) ++particle;
    throw RunError("harmonic: the stiffness is singular: particle " + std::to_string(particle) +
                   " or its neighbours can move without force (contacts without shear stiffness make a mechanism)");
  }
  f.right = cholmod_allocate_dense(6 * particles, 2, 6 * particles, CHOLMOD_REAL, &f.common);
  f.require("solving", particles);
}

Cholesky::~Cholesky() = default;

void Cholesky::solve(const Vector& in, Vector& out) const {
  Factor& f = *factor_;
  const std::size_t n = in.size();
  auto* right = static_cast<double*>(f.right->x);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t row = 6 * static_cast<std::size_t>(f.place[i / 6]) + i % 6;
    right[row] = in[i].real();
    right[n + row] = in[i].imag();
  }
  cholmod_solve2(CHOLMOD_A, f.factor, f.right, nullptr, &f.x, nullptr, &f.work_y, &f.work_e, &f.common);
  f.require("solving", n / 6);
  const auto* x = static_cast<const double*>(f.x->x);
  out.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t row = 6 * static_cast<std::size_t>(f.place[i / 6]) + i % 6;
    out[i] = {x[row], x[n + row]};
  }
}

}  // namespace macadam::harmonic
