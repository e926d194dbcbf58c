// SPDX-License-Identifier: GPL-3.0-or-later
// multi_sphere_test.cpp  Tests specimens of clusters (aggregates of several spheres) in limiting cases, in which they
// equal single spheres, mastic or rigid clusters. Checks their equilibrium with the equations of the reference
// implementation.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <Eigen/Dense>
#include <map>

#include "tests/support/cluster_specimens.hpp"
#include "tests/support/reference_bilinear.hpp"

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

/// Returns the specimen with every sphere of an aggregate as an aggregate of its own.
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

// The number of a sphere's aggregate only decides which law a contact has. If inner contacts have the law of A–A
// contacts, clusters therefore equal single spheres; only the order of sums may differ. The tolerance is the rounding
// of about a hundred terms per row times the condition number of 1e5 that harmonic_test allows for.
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
    laws[inner] = laws::Elastic{1.125e11 / 4, 0.05};  // checks that another inner law changes the modulus
    EXPECT_GT(difference(solve(make_scene(clusters, {}, laws), 10).top, single), 0.02);
  }
}

/// If all pair types have the same law, clusters in mastic behave as mastic.
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

// The harmonic solver's motion satisfies the equations of the reference implementation, which are computed at every
// contact point, and gives the same modulus.
TEST(MultiSphere, IsInEquilibriumByTheReference) {
  const TestScene scene = make_scene(generate_specimen(cluster_recipe(test_seed(), {0.012, 0.012, 0.016})).specimen);
  for (const Laws& laws : {am1_laws(), am2_laws()}) {
    for (const double frequency : {2.0, 20.0}) {
      TestScene of = scene;
      of.laws = laws;
      const HarmonicResult r = solve(of, frequency);
      const BilinearForm form = bilinear_form(of.network, laws, of.specimen.size(), frequency);
      const Eigen::VectorXcd u = motion_of(r);
      // the solver's residual of 1e-11 weights moments to make them comparable with forces; here they are not weighted
      EXPECT_LT((form.p - form.K * u).norm() / form.p.norm(), 1e-9);
      const Complex expected = modulus_of(form(u, u), of.specimen.box);
      EXPECT_LT(std::abs(complex_of(r.top) - expected) / std::abs(expected), 1e-9);
    }
  }
}

constexpr double length = 1e-3;  // reference length: rotations times it are comparable with displacements

/// Returns the matrix that gives the motions of all spheres from the motions of rigid particles. A mastic sphere is one
/// rigid particle; the spheres of an aggregate form one rigid particle together. A rotation is measured by the
/// displacement at distance `length`.
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

/// Returns the motions that nothing resists: sliding of the whole specimen along x and y, and rotation about z.
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

// As the inner contacts become s times as stiff as those of [1], the clusters become rigid. Rigid clusters move as u =
// T·q and satisfy Tᵀ·K·T·q = Tᵀ·p, where K is the stiffness without inner contacts. The remaining forces g = p − K·T·q
// act within the clusters and reduce the modulus by gᵀ·K_inner⁻¹·g / s. The modulus is convex in 1/s, so it is below
// the modulus of rigid clusters by at most this reduction.
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
  // K·u = p is singular. Springs that hold the free motions make it regular; they carry no force, because p does not
  // load these motions.
  const Eigen::MatrixXd held = (T.transpose() * free_motions(clusters)).colwise().normalized();
  const Eigen::MatrixXd condensed = T.transpose() * (between.K * T);
  const double scale = condensed.diagonal().mean();
  const Eigen::VectorXd q =
      (condensed + scale * held * held.transpose()).ldlt().solve(T.transpose() * between.top_wall);
  const double rigid = modulus_of(between.top_stiffness - between.top_wall.dot(T * q), clusters.box).real();

  const Eigen::VectorXd g = between.top_wall - between.K * (T * q);
  EXPECT_LT((T.transpose() * g).norm(), 1e-9 * between.top_wall.norm());
  const Eigen::MatrixXd inside = reference::assemble_stiffness(within, laws, clusters.size()).K;
  Eigen::MatrixXd rigid_motions = T;  // weighted, because T measures rotations by displacements
  for (Eigen::Index row = 3; row < T.rows(); row += 6) rigid_motions.middleRows<3>(row) *= length * length;
  const Eigen::VectorXd bent = (inside + scale * rigid_motions * rigid_motions.transpose()).ldlt().solve(g);
  const double yields = modulus_of(g.dot(bent), clusters.box).real();
  EXPECT_GT(yields, 1e-3 * rigid);

  double before = 1;
  for (const double s : {10.0, 100.0, 1000.0}) {
    TestScene stiff = scene;
    stiff.laws[inner] = laws::Elastic{s * 1.125e11, 0.05};
    const double yielded = s * (rigid - solve(stiff, 1).top.e_star_pa) / yields;
    // The modulus has a relative error of about 1e-11. The difference of two moduli, `yields / s`, is only a small part
    // of the modulus, so the relative error of this difference is larger.
    const double rounding = 1e-10 * s * rigid / yields;
    EXPECT_LT(yielded, 1 + rounding) << s;
    EXPECT_GT(yielded, 0) << s;
    // The relative error of the estimate `yields / s` is of first order in 1/s. Each s is ten times the previous one,
    // so from the second s on the error must be a tenth of the error at the previous s.
    if (s > 10) { EXPECT_NEAR((1 - yielded) / before, 0.1, 0.02) << s; }
    fmt::print("inner contacts {:g} times as stiff: {:.3e} of the modulus below rigid, {:.6f} of first order\n", s,
               rigid / solve(stiff, 1).top.e_star_pa - 1, yielded);
    before = 1 - yielded;
  }
  EXPECT_LT(before, 0.01);
}

}  // namespace
}  // namespace macadam::test
