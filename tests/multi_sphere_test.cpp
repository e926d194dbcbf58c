// SPDX-License-Identifier: GPL-3.0-or-later
// multi_sphere_test.cpp  Specimens of clusters against what they become: single spheres, rigid bodies, and the
// reference's equations.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <Eigen/Dense>
#include <map>

#include "cluster_specimens.hpp"
#include "reference_bilinear.hpp"

namespace macadam::test {
namespace {

constexpr auto mm = static_cast<std::size_t>(PairType::mm), ma = static_cast<std::size_t>(PairType::ma),
               aa = static_cast<std::size_t>(PairType::aa), inner = static_cast<std::size_t>(PairType::inner),
               aw = static_cast<std::size_t>(PairType::aw), mw = static_cast<std::size_t>(PairType::mw);

HarmonicResult solve(const TestScene& scene, double frequency) {
  return Harmonic(scene.specimen, scene.network, scene.laws, scene.inertia, {}, frequency).solve(frequency);
}

double difference(const Stiffness& a, const Stiffness& b) {
  return std::abs(complex_of(a) - complex_of(b)) / b.e_star_pa;
}

/// Every sphere of an aggregate an aggregate of its own.
Specimen single_spheres(Specimen specimen) {
  std::int32_t body = 0;
  for (std::size_t i = 0; i < specimen.size(); ++i) {
    if (specimen.phase[i] == Phase::aggregate) specimen.body[i] = body++;
  }
  return specimen;
}

Specimen all_mastic(Specimen specimen) {
  specimen.phase.assign(specimen.size(), Phase::mastic);
  specimen.body.assign(specimen.size(), -1);
  return specimen;
}

// Which body a sphere belongs to chooses the law of a contact and nothing else. The same sums may be taken in another
// order: some hundred terms a row, rounded, times the condition of 1e5 that harmonic_test allows for.
TEST(MultiSphere, WithTheLawOfAggregatesWithinItIsTheSpecimenOfItsSingleSpheres) {
  const Specimen clusters = generate_specimen(cluster_recipe(test_seed(), {0.012, 0.012, 0.016})).specimen;
  for (Laws laws : {am1_laws(), am2_laws()}) {
    laws[inner] = laws[aa];
    const TestScene ms = make_scene(clusters, {}, laws), ss = make_scene(single_spheres(clusters), {}, laws);
    EXPECT_GT(ms.network.count[inner], 1000);
    EXPECT_EQ(ss.network.count[inner], 0);
    EXPECT_EQ(ss.network.count[aa], ms.network.count[aa] + ms.network.count[inner]);
    const Stiffness single = solve(ss, 10).top;
    EXPECT_LT(difference(solve(ms, 10).top, single), 1e-9);
    laws[inner] = laws::Elastic{1.125e11 / 4, 0.05};  // and the inner law is what it is about
    EXPECT_GT(difference(solve(make_scene(clusters, {}, laws), 10).top, single), 0.02);
  }
}

TEST(MultiSphere, OfOneLawEverywhereItIsMastic) {
  const Specimen clusters = few_clusters(test_seed());
  Laws laws = am1_laws();
  laws[ma] = laws[aa] = laws[inner] = laws[mm];
  laws[aw] = laws[mw];
  const TestScene ms = make_scene(clusters, {}, laws), mastic = make_scene(all_mastic(clusters), {}, laws);
  EXPECT_EQ(mastic.network.count[mm],
            ms.network.count[mm] + ms.network.count[ma] + ms.network.count[aa] + ms.network.count[inner]);
  EXPECT_LT(difference(solve(ms, 10).top, solve(mastic, 10).top), 1e-9);
}

// The harmonic solver's motion is in equilibrium in the reference's equations, point by point, and has its modulus.
TEST(MultiSphere, IsInEquilibriumByTheReference) {
  const TestScene scene = make_scene(generate_specimen(cluster_recipe(test_seed(), {0.012, 0.012, 0.016})).specimen);
  for (const Laws& laws : {am1_laws(), am2_laws()}) {
    for (const double frequency : {2.0, 20.0}) {
      TestScene of = scene;
      of.laws = laws;
      const HarmonicResult r = solve(of, frequency);
      const BilinearForm form = bilinear_form(of.network, laws, of.specimen.size(), frequency);
      const Eigen::VectorXcd u = motion_of(r);
      // the solver's own 1e-11 is with forces and moments made comparable: here they are not
      EXPECT_LT((form.p - form.K * u).norm() / form.p.norm(), 1e-9);
      const Complex expected = modulus_of(form(u, u), of.specimen.box);
      EXPECT_LT(std::abs(complex_of(r.top) - expected) / std::abs(expected), 1e-9);
    }
  }
}

constexpr double length = 1e-3;  // of a lever: rotations times it are as large as displacements

/// Motions of all spheres by those of bodies: a mastic sphere moves by itself, the spheres of an aggregate as one.
/// Rotations are counted as what they move at `length`.
Eigen::MatrixXd rigid_bodies(const Specimen& s) {
  std::vector<std::int32_t> number(s.size());
  std::map<std::int32_t, std::int32_t> of_body;
  std::int32_t bodies = 0;
  for (std::size_t i = 0; i < s.size(); ++i) {
    const auto [at, fresh] = of_body.try_emplace(s.body[i] < 0 ? -1 - static_cast<std::int32_t>(i) : s.body[i], bodies);
    bodies += fresh ? 1 : 0;
    number[i] = at->second;
  }
  std::vector<Vec3d> origin(static_cast<std::size_t>(bodies));
  for (std::size_t i = s.size(); i-- > 0;) origin[static_cast<std::size_t>(number[i])] = s.centre[i];
  Eigen::MatrixXd T = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(6 * s.size()), 6 * bodies);
  for (std::size_t i = 0; i < s.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(6 * i), column = static_cast<Eigen::Index>(6 * number[i]);
    const Vec3d x = s.centre[i] - origin[static_cast<std::size_t>(number[i])];
    T.block<6, 6>(row, column).setIdentity();
    T.block<3, 3>(row, column + 3) << 0, x.z, -x.y, -x.z, 0, x.x, x.y, -x.x, 0;
    T.block<6, 3>(row, column + 3) /= length;
  }
  return T;
}

/// Of spheres that do not hold each other: sliding along x and y and turning about z, as columns.
Eigen::MatrixXd free_motions(const Specimen& s) {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(6 * s.size()), 3);
  for (std::size_t i = 0; i < s.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(6 * i);
    out(row, 0) = out(row + 1, 1) = 1;
    out(row, 2) = -s.centre[i].y / s.box.size.x, out(row + 1, 2) = s.centre[i].x / s.box.size.x;
    out(row + 5, 2) = 1 / s.box.size.x;
  }
  return out;
}

// Inner contacts s times as stiff as those of [1]: the clusters become rigid bodies as s grows. With u = T·q the
// condensed network is Tᵀ·K·T·q = Tᵀ·p without any inner contact; what it leaves, g = p − K·T·q, is what clusters must
// bear, and yields gᵀ·K_inner⁻¹·g / s. The modulus is convex in 1/s, so it is never below the condensed one less that,
// and never above the condensed one.
TEST(MultiSphere, BecomesRigidBodiesAsItsInnerContactsStiffen) {
  const Specimen clusters = few_clusters(test_seed());
  Laws laws;
  const Laws am1 = am1_laws();
  for (std::size_t pair = 0; pair < pair_types; ++pair) {
    laws[pair] = laws::Elastic{std::visit([](const auto& law) { return law.instantaneous(); }, *am1[pair]),
                               std::visit([](const auto& law) { return law.alpha; }, *am1[pair])};
  }
  const TestScene scene = make_scene(clusters, {}, laws);
  const Eigen::MatrixXd T = rigid_bodies(clusters);
  ASSERT_LT(T.cols(), T.rows() - 6 * 30);

  ContactNetwork outer = scene.network, within = scene.network;
  std::erase_if(outer.contacts, [](const Contact& c) { return c.pair == PairType::inner; });
  std::erase_if(within.contacts, [](const Contact& c) { return c.pair != PairType::inner; });
  const reference::Stiffness between = reference::assemble_stiffness(outer, laws, clusters.size());
  // K·u = p is singular, and solved with springs that hold what p does not load: they carry nothing
  const Eigen::MatrixXd held = (T.transpose() * free_motions(clusters)).colwise().normalized();
  const Eigen::MatrixXd condensed = T.transpose() * (between.K * T);
  const double scale = condensed.diagonal().mean();
  const Eigen::VectorXd q =
      (condensed + scale * held * held.transpose()).ldlt().solve(T.transpose() * between.top_wall);
  const double rigid = modulus_of(between.top_stiffness - between.top_wall.dot(T * q), clusters.box).real();

  const Eigen::VectorXd g = between.top_wall - between.K * (T * q);
  EXPECT_LT((T.transpose() * g).norm(), 1e-9 * between.top_wall.norm());
  const Eigen::MatrixXd inside = reference::assemble_stiffness(within, laws, clusters.size()).K;
  Eigen::MatrixXd rigid_motions = T;  // weighted, as rotations are in T
  for (Eigen::Index row = 3; row < T.rows(); row += 6) rigid_motions.middleRows<3>(row) *= length * length;
  const Eigen::VectorXd bent = (inside + scale * rigid_motions * rigid_motions.transpose()).ldlt().solve(g);
  const double yields = modulus_of(g.dot(bent), clusters.box).real();
  EXPECT_GT(yields, 1e-3 * rigid);

  double before = 1;
  for (const double s : {10.0, 100.0, 1000.0}) {
    TestScene stiff = scene;
    stiff.laws[inner] = laws::Elastic{s * 1.125e11, 0.05};
    const double yielded = s * (rigid - solve(stiff, 1).top.e_star_pa) / yields;
    // 1e-11 of the modulus, which `yields / s` is the smaller part of
    const double rounding = 1e-10 * s * rigid / yields;
    EXPECT_LT(yielded, 1 + rounding) << s;
    EXPECT_GT(yielded, 0) << s;
    // what is left out is of the next order in 1/s: a tenth at a ten times stiffer cluster, from the second on
    if (s > 10) { EXPECT_NEAR((1 - yielded) / before, 0.1, 0.02) << s; }
    fmt::print("inner contacts {:g} times as stiff: {:.3e} of the modulus below rigid, {:.6f} of first order\n", s,
               rigid / solve(stiff, 1).top.e_star_pa - 1, yielded);
    before = 1 - yielded;
  }
  EXPECT_LT(before, 0.01);
}

}  // namespace
}  // namespace macadam::test
