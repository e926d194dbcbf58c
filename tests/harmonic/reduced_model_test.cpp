// SPDX-License-Identifier: GPL-3.0-or-later
// reduced_model_test.cpp  The reduced model computes E* from combinations of known motions (earlier solutions). It is
// exact where a known motion is the solution, and close to the solution elsewhere.
#include "host/harmonic/reduced_model.hpp"

#include <gtest/gtest.h>

#include <omp.h>

#include <cmath>

#include "tests/support/test_scenes.hpp"

namespace macadam::test {
namespace {

using harmonic::ReducedModel;

class Reduced : public testing::TestWithParam<bool> {
 protected:
  /// Returns laws whose M–M moduli are multiplied by `factor` and whose M–M shear ratio is multiplied by `alpha`.
  Laws with(double factor, double alpha = 1) const {
    Laws out = start;
    auto& law = std::get<laws::GeneralisedKelvin>(*out[static_cast<std::size_t>(PairType::mm)]);
    law.E_m *= factor, law.C_m *= factor, law.alpha *= alpha;
    for (double& e : law.E) e *= factor;
    for (double& c : law.C) c *= factor;
    return out;
  }
  HarmonicLoad load(double frequency) const { return {frequency, GetParam() ? 1e5 : 0.0, GetParam() ? 1.0 : 0.0}; }
  HarmonicResult solution(const Laws& laws, double frequency) const {
    return Harmonic(specimen, network, laws, inertia, {}, 6).solve({load(frequency)}).front();
  }
  double miss(const ReducedModel& model, const Laws& laws, double frequency) const {
    const auto expected = solution(laws, frequency).parts.modulus();
    return std::abs(model.solve(laws, load(frequency)).parts.modulus() / expected - 1.0);
  }

  const TestScene scene = make_scene(random_specimen(3));
  const Specimen& specimen = scene.specimen;
  const ContactNetwork& network = scene.network;
  const Inertia& inertia = scene.inertia;
  const Laws& start = scene.laws;
};
INSTANTIATE_TEST_SUITE_P(Inertia, Reduced, testing::Bool(),
                         [](const auto& info) { return info.param ? "with" : "without"; });

TEST_P(Reduced, WhereThereIsASolutionItIsThat) {
  ReducedModel model(specimen, network, inertia);
  for (const double frequency : {2.0, 20.0}) {
    const HarmonicResult solved = solution(start, frequency);
    model.add({solved.motion});
    const ReducedModel::Solution found = model.solve(start, load(frequency));
    const double scale = std::abs(solved.parts.modulus());
    // The tolerance covers the rounding of a few thousand operations: sums over about a thousand contacts, and a small
    // system of equations that is scaled by its diagonal.
    for (std::size_t pair = 0; pair < pair_types; ++pair) {
      EXPECT_LT(std::abs(found.parts.normal[pair] - solved.parts.normal[pair]) / scale, 1e-11) << pair;
      EXPECT_LT(std::abs(found.parts.shear[pair] - solved.parts.shear[pair]) / scale, 1e-11) << pair;
    }
    EXPECT_LT(std::abs(found.parts.inertia - solved.parts.inertia) / scale, 1e-11);
    const harmonic::Vector motion = model.motion(found);
    for (std::size_t i = 0; i < motion.size(); ++i) EXPECT_LT(std::abs(motion[i] - solved.motion[i]), 1e-7) << i;
  }
  EXPECT_EQ(model.motions(), 4) << "real and imaginary parts of two";
  model.add({solution(start, 2).motion});
  EXPECT_EQ(model.motions(), 4) << "nothing new";
}

/// The error of a Galerkin method is proportional to the square of the error of the known motions. The known motions
/// are wrong to first order in the change of the laws, so E* is wrong to second order.
TEST_P(Reduced, ErrorGoesWithTheSquareOfTheDistance) {
  ReducedModel model(specimen, network, inertia);
  model.add({solution(start, 2).motion});
  const double near = miss(model, with(1.02, 1.01), 2), far = miss(model, with(1.08, 1.04), 2);
  EXPECT_GT(far, 1e-9) << "or rounding is compared";
  EXPECT_NEAR(std::log(far / near) / std::log(4), 2, 0.2);
  model.add({solution(with(1.08, 1.04), 2).motion});
  EXPECT_LT(miss(model, with(1.08, 1.04), 2), 1e-11);
  EXPECT_LT(miss(model, with(1.04, 1.02), 2), far / 100) << "between two it is of fourth order";
}

TEST_P(Reduced, SameBitsForAnyNumberOfThreads) {
  const int threads = omp_get_max_threads();
  const auto motions = std::vector{solution(start, 2).motion, solution(with(3), 20).motion};
  std::vector<std::complex<double>> found;
  for (const int count : {1, 3}) {
    omp_set_num_threads(count);
    ReducedModel model(specimen, network, inertia);
    for (const auto& motion : motions) model.add({motion});
    found.push_back(model.solve(with(2), load(5)).parts.modulus());
  }
  omp_set_num_threads(threads);
  EXPECT_EQ(found[0], found[1]);
}

}  // namespace
}  // namespace macadam::test
