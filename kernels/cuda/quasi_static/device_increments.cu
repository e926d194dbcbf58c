// SPDX-License-Identifier: GPL-3.0-or-later
// device_increments.cu  Computes the operations of quasi-static increments on a device: the order of the kernels, and
// copies to the host.
#include <array>
#include <optional>

#include "kernels/cuda/quasi_static/device_gmres.hpp"

namespace macadam::kernels {
namespace {

/// The preconditioner is made again when a solution takes this many times the iterations of the first one with it.
constexpr double more_iterations = 1.3;
constexpr unsigned top_wall_index = wall_index(wall_z_hi);

class Increments : public DeviceIncrements {
 public:
  Increments(const IncrementSystem& system, int device)
      : team_({device}, nullptr, KernelOrder::first),
        m_(system),
        gradients_(team_, m_),
        trial_sums_(team_),
        numbers_(team_, 16),
        counts_(team_) {
    const std::vector<double> ones(6 * system.bodies(), 1.0);
    copy_now(m_.intact, ones.data(), ones.size() * sizeof(double), "intact stiffness");
  }
  ~Increments() override {
    team_.use(0);
    team_.wait_for_the_last();
  }

  void begin(const IncrementLaws& laws, double growing_area, bool drags) override {
    team_.use(0);
    growing_area_ = growing_area, drags_ = drags;
    check_cuda(cudaMemcpyAsync(m_.laws, laws.data(), sizeof(laws), cudaMemcpyHostToDevice, team_.stream()), "laws");
    run("prepare contacts", increment_prepare_linear, blocks_of(m_.view.linear_contacts), m_.view);
    run("prepare points", increment_prepare_points, blocks_of(m_.view.points), m_.view);
  }

  IncrementSums evaluate(const WallMotions& wall) override {
    team_.use(0);
    for (std::size_t w = 0; w < wall_count; ++w) wall_.of[w] = wall[w];
    const IncrementView& d = m_.view;
    run("linear contacts", increment_linear_forces, blocks_of(d.linear_contacts), d, wall_);
    IncrementView with_openings = d;
    with_openings.partial = m_.openings;
    run("contact points", increment_point_forces, point_blocks(), with_openings, wall_, growing_area_);
    run("loads", increment_body_loads, warp_blocks(d.bodies), d, d.partial);
    run("reactions", increment_reactions, wall_count, d, m_.trial_sums);
    run("sums", increment_finish_sums, 1, d.partial, warp_blocks(d.bodies), m_.openings, point_blocks(), m_.trial_sums);
    trial_sums_.copy(m_.trial_sums, 1, 0);
    return *trial_sums_.wait(0);
  }

  AssembledSums assemble(bool symmetric, double held, double loose) override {
    team_.use(0);
    symmetric_ = symmetric;
    const IncrementView& d = m_.view;
    run("linear stiffness", increment_linear_stiffness, blocks_of(d.linear_contacts), d);
    run("point stiffness", increment_point_stiffness, point_blocks(), d, wall_, growing_area_, symmetric);
    check_cuda(cudaMemsetAsync(m_.loose, 0, sizeof(*m_.loose), team_.stream()), "loose particles");
    run("tangent", increment_assemble, warp_blocks(d.bodies), d, held, loose, -1 - static_cast<int>(top_wall_index),
        m_.loose);
    run("wall stiffness", increment_wall_stiffness, 1, d, top_wall_index, m_.sums);
    counts_.copy(m_.loose, 1, 0);
    numbers_.copy(m_.sums, 1, 0);
    return {static_cast<std::int64_t>(*counts_.wait(0)), *numbers_.wait(0)};
  }

  std::vector<double> diagonal() const override {
    team_.use(0);
    run("diagonal", increment_diagonal, blocks_of(degrees()), m_.view, m_.gradients.q);
    return numbers(m_.gradients.q, degrees());
  }
  void set_intact(const std::vector<double>& stiffness) override { put(stiffness, m_.intact); }
  std::vector<double> blocks() const override { return numbers(m_.view.blocks, 36 * m_.entries); }

  void precondition() override {
    team_.use(0);
    gradients_.precondition(stale_);
    if (stale_) stale_ = false, first_rate_ = {};
  }

  IncrementSolution solve(bool by_wall, double tolerance) override {
    team_.use(0);
    const IncrementView& d = m_.view;
    const GradientView& g = m_.gradients;
    const double* right = by_wall ? d.top : d.residual;
    combine(-1, right, 0, right, g.r);
    IncrementSolution out;
    if (symmetric_) {
      out = gradients_.solve(tolerance);
    } else {
      if (!gmres_) gmres_.emplace(team_, m_, gradients_);
      out = gmres_->solve(tolerance);
    }
    // A tolerance and its number of iterations are compared by the mean gain per iteration
    const double rate = out.iterations / -std::log(std::min(tolerance, 0.5));
    double& first = first_rate_[symmetric_];
    if (first == 0) first = rate;
    stale_ = rate > more_iterations * first || !out.solved;
    combine(1, g.x, 0, g.x, solution(by_wall));
    return out;
  }

  void add_by_wall(double factor) override {
    team_.use(0);
    combine(1, m_.correction, factor, m_.by_wall, m_.correction);
  }
  double on_top(bool by_wall) override {
    team_.use(0);
    run("product", increment_product, product_blocks, degrees(), m_.view.top, solution(by_wall), m_.view.partial);
    return sum<1>(product_blocks)[0];
  }
  double opening_change(bool by_wall) override {
    team_.use(0);
    const unsigned blocks = blocks_of(m_.view.contacts);
    run("opening", increment_opening_change, blocks, m_.view, solution(by_wall));
    return sum<1>(blocks)[0];
  }

  void keep() override {
    team_.use(0);
    combine(1, m_.view.trial, 0, m_.view.trial, m_.view.kept);
  }
  void move(double length) override {
    team_.use(0);
    combine(1, m_.view.kept, length, m_.correction, m_.view.trial);
  }

  ContactEnergies accept() override {
    team_.use(0);
    const IncrementView& d = m_.view;
    const unsigned linear = blocks_of(d.linear_contacts), points = blocks_of(d.points);
    run("accept contacts", increment_accept_linear, linear, d, wall_);
    run("accept points", increment_accept_points, points, d, wall_, linear, drags_ || dragged_);
    dragged_ = drags_;
    combine(1, d.displacement, 1, d.trial, d.displacement);
    const double* e = sum<energy_sums>(linear + points);
    return {e[0], e[1], e[2], e[3], e[4], e[5], e[6], e[7], e[8]};
  }
  double growing_area() override {
    team_.use(0);
    const unsigned blocks = blocks_of(m_.view.points);
    if (blocks == 0) return 0;
    run("growing area", increment_growing_area, blocks, m_.view);
    return sum<1>(blocks)[0];
  }

  std::vector<double> read(IncrementVector which) const override { return numbers(vector(which), degrees()); }
  void write(IncrementVector which, const std::vector<double>& list) override { put(list, vector(which)); }
  IncrementStates states() const override {
    const IncrementView& d = m_.view;
    IncrementStates out{numbers(d.displacement, degrees()), numbers(d.linear_state, linear_numbers()),
                        numbers(d.point_state, point_numbers()), std::vector<std::uint8_t>(d.points)};
    if (d.points > 0) copy_now(out.grew.data(), d.grew, d.points, "states");
    return out;
  }
  void set_states(const IncrementStates& s) override {
    const IncrementView& d = m_.view;
    put(s.displacement, d.displacement);
    put(s.linear, d.linear_state), put(s.points, d.point_state);
    check_cuda(cudaMemsetAsync(d.point_drag, 0, 3 * sizeof(double) * d.points, team_.stream()), "states");
    dragged_ = false;
    if (d.points == 0) return;
    for (std::uint8_t* to : {d.grew, d.grows}) copy_now(to, s.grew.data(), d.points, "states");
  }

  void read_cracks(std::vector<laws::PointCrack>* cracks, std::vector<Break>* breaks) const override {
    team_.use(0);
    if (m_.view.points == 0) return;
    DeviceArray<laws::PointCrack> of_cracks(cracks ? cracks->size() : 0);
    DeviceArray<Break> of_breaks(breaks ? breaks->size() : 0);
    run("cracks", increment_read_cracks, blocks_of(m_.view.points), m_.view, of_cracks.data(), of_breaks.data());
    team_.wait("cracks");
    if (cracks) copy_now(cracks->data(), of_cracks.data(), of_cracks.bytes(), "cracks");
    if (breaks) copy_now(breaks->data(), of_breaks.data(), of_breaks.bytes(), "cracks");
  }
  CrackTotals crack_totals() override {
    team_.use(0);
    CrackTotals out;
    const unsigned points = m_.view.points;
    if (points == 0) return out;
    if (broken_.size() == 0) broken_ = DeviceArray<BrokenPoint>(points), count_ = DeviceArray<unsigned>(1);
    check_cuda(cudaMemsetAsync(count_.data(), 0, sizeof(unsigned), team_.stream()), "cracks");
    run("crack totals", increment_crack_totals, blocks_of(points), m_.view, broken_.data(), count_.data());
    const double* sums = sum<crack_sums>(blocks_of(points));
    for (std::size_t pair = 0; pair < pair_types; ++pair)
      out.cracked[pair] = static_cast<std::int64_t>(sums[2 * pair]), out.area[pair] = sums[2 * pair + 1];
    out.energy = sums[2 * pair_types], out.friction = sums[2 * pair_types + 1];
    out.broken.resize(count_.download().front());
    if (!out.broken.empty())
      copy_now(out.broken.data(), broken_.data(), out.broken.size() * sizeof(BrokenPoint), "cracks");
    return out;
  }
  std::int64_t bytes() const override { return m_.bytes() + static_cast<std::int64_t>(broken_.bytes()); }

 private:
  unsigned degrees() const { return 6 * m_.view.bodies; }
  unsigned point_blocks() const { return blocks_of(point_lanes * (m_.view.contacts - m_.view.linear_contacts)); }
  std::size_t linear_numbers() const {
    return 6 * static_cast<std::size_t>(m_.view.linear_words) * m_.view.linear_contacts;
  }
  std::size_t point_numbers() const { return 3 * static_cast<std::size_t>(m_.view.point_words) * m_.view.points; }
  double* solution(bool by_wall) const { return by_wall ? m_.by_wall : m_.correction; }
  double* vector(IncrementVector which) const {
    switch (which) {
      case IncrementVector::residual:
        return m_.view.residual;
      case IncrementVector::top:
        return m_.view.top;
      case IncrementVector::correction:
        return m_.correction;
      case IncrementVector::by_wall:
        return m_.by_wall;
      case IncrementVector::trial:
        return m_.view.trial;
      default:
        return m_.view.displacement;
    }
  }

  template <class Kernel, class... Arguments>
  void run(const char* name, Kernel kernel, unsigned blocks, Arguments&&... arguments) const {
    gradients_.run(name, kernel, blocks, std::forward<Arguments>(arguments)...);
  }
  /// out = a·x + b·y
  void combine(double a, const double* x, double b, const double* y, double* out) const {
    run("vectors", increment_combine, blocks_of(degrees()), degrees(), a, x, b, y, out);
  }
  /// Returns the N sums over the rows that thread blocks have written to `partial`.
  template <int N>
  const double* sum(unsigned rows) {
    run("sum", increment_sum<N>, 1, m_.view.partial, rows, m_.sums);
    numbers_.copy(m_.sums, N, 0);
    return numbers_.wait(0);
  }
  /// Copies numbers to and from the device, after all work that is enqueued.
  /// @{
  std::vector<double> numbers(const double* from, std::size_t count) const {
    team_.use(0);
    team_.wait("copy from the device");
    std::vector<double> out(count);
    if (count > 0) copy_now(out.data(), from, count * sizeof(double), "copy from the device");
    return out;
  }
  void put(const std::vector<double>& list, double* to) const {
    team_.use(0);
    team_.wait("copy to the device");
    if (!list.empty()) copy_now(to, list.data(), list.size() * sizeof(double), "copy to the device");
  }
  /// @}

  DeviceTeam team_;
  IncrementMemory m_;
  DeviceGradients gradients_;
  std::optional<DeviceGmres> gmres_;
  PinnedCopies<IncrementSums> trial_sums_;
  PinnedCopies<double> numbers_;
  PinnedCopies<unsigned long long> counts_;
  DeviceArray<BrokenPoint> broken_;  ///< made when cracks are first summed
  DeviceArray<unsigned> count_;
  WallArgument wall_{};  ///< of the last evaluation
  double growing_area_ = 0;
  bool drags_ = false, dragged_ = false;  ///< whether the increment has a drag, and whether the last one had it
  bool symmetric_ = true, stale_ = true;
  std::array<double, 2> first_rate_{};  ///< with the present preconditioner, of GMRES and of conjugate gradients
};

}  // namespace

std::unique_ptr<DeviceIncrements> make_device_increments(const IncrementSystem& system, int device) {
  return std::make_unique<Increments>(system, device);
}

}  // namespace macadam::kernels
