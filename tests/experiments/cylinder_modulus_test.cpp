// SPDX-License-Identifier: GPL-3.0-or-later
// cylinder_modulus_test.cpp  Tests moduli of cylinders: homogeneous cylinders, whose modulus is known, and generated
// cylinders, which are compared with boxes.
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "macadam/macadam.hpp"
#include "tests/scene/scene_file.hpp"
#include "tests/support/test_files.hpp"

namespace macadam {
namespace {

constexpr double E = 2e10;

/// Returns a mix of spheres in a domain.
SpecimenSpec mix(const Domain& domain, std::uint64_t seed) {
  SpecimenSpec spec;
  spec.box = domain;
  spec.seed = seed;
  spec.aggregate = {{0.002, 0.00475, 0.35, {}}};
  spec.mastic = MasticSpec{0.00075, 0.001, 0.05, {}};
  return spec;
}

struct CylinderModulus : test::SceneFile {
  /// Returns a scene of the specimen core.csv, which is in the scene's folder.
  Scene scene(const std::string& rest) const {
    return read("[specimen]\nfile = \"core.csv\"\ndomain = \"cylinder\"\ndiameter = 0.014\nheight = 0.013\n" + rest);
  }
  void SetUp() override {
    SceneFile::SetUp();
    write_specimen_csv(folder_ / "core.csv", generate_specimen(mix(cylinder_domain(0.014, 0.013), 4)).specimen);
  }
};

// There are no aggregates, because a film between two of them is softer in shear than the material around the film.
// With equal stiffness in all directions and ν = 0, uniform strain is a solution for every shape of the section, so the
// specimen has the modulus of the material. The iterative solver leaves a residual of 1e-12 of the load, and the
// modulus is an energy, so its error is below the residual times the square root of the condition number (about 1e2).
TEST_F(CylinderModulus, IsThatOfAHomogeneousMaterial) {
  SpecimenSpec mastic = mix(cylinder_domain(0.014, 0.013), 4);
  mastic.aggregate.clear();
  write_specimen_csv(folder_ / "core.csv", generate_specimen(mastic).specimen);
  const std::string phases =
      "[materials.aggregate]\ndensity = 2000\nlaw = \"elastic\"\nE = 2e10\npoisson_ratio = 0\n"
      "[materials.mastic]\ndensity = 2000\nlaw = \"elastic\"\nE = 2e10\npoisson_ratio = 0\n"
      "[network]\nrule = \"series\"\n";
  const Scene cyclic = scene(phases +
                             "[loading]\nkind = \"cyclic\"\nfrequencies = [1.0]\n"
                             "[solver]\nmethod = \"harmonic\"\nbackend = \"cpu\"\n");
  const Preparation prepared = prepare(cyclic);
  const HarmonicResult found =
      Harmonic(prepared.specimen, prepared.network, cyclic.laws, make_inertia(prepared.specimen, 2000, 2000), {}, 1)
          .solve(1);
  EXPECT_NEAR(found.top.e_star_pa / E, 1, 1e-10);
  EXPECT_NEAR(found.bottom.e_star_pa / E, 1, 1e-10);
  const auto ratio = poisson_ratio(prepared.specimen, prepared.tessellation, found);
  ASSERT_TRUE(ratio);
  EXPECT_NEAR(std::abs(*ratio), 0, 1e-8);
}

// Every kind of test runs, and its summary names the domain.
TEST_F(CylinderModulus, EveryTestOfOneSectionRuns) {
  const std::string chain = "law = \"generalised_kelvin\"\nE_m = 1e10\nC_m = 2e9\nE = [4e8]\nC = [9e7]\nalpha = 0.1\n";
  std::string pairs = "[materials.aggregate]\ndensity = 2600\n[materials.mastic]\ndensity = 2100\n";
  for (const char* pair : {"M-M", "M-A", "M-W"})
    pairs += std::string("[[contacts]]\npair = \"") + pair + "\"\n" + chain;
  for (const char* pair : {"A-A", "A-W"})
    pairs += std::string("[[contacts]]\npair = \"") + pair + "\"\nlaw = \"elastic\"\nE = 5e10\nalpha = 0.05\n";
  const std::string cpu = "backend = \"cpu\"\n";
  for (const std::string& test :
       {"[loading]\nkind = \"cyclic\"\nfrequencies = [10.0]\n[solver]\nmethod = \"harmonic\"\n" + cpu,
        "[loading]\nkind = \"cyclic\"\nfrequencies = [1000.0]\ncycles = 2\n[solver]\nmethod = \"explicit\"\n"
        "density_scaling = 100\n" +
            cpu,
        "[loading]\nkind = \"sweep\"\nfrequencies = [1.0, 10.0]\npoints_per_decade = 1\n[solver]\n"
        "method = \"harmonic\"\n" +
            cpu,
        "[loading]\nkind = \"relaxation\"\ntimes = [0.1, 1.0]\npoints_per_decade = 1\nstrain = 1e-4\n[solver]\n"
        "method = \"harmonic\"\n" +
            cpu,
        "[loading]\nkind = \"creep\"\ntimes = [0.1, 1.0]\npoints_per_decade = 1\nstress = 1e5\n[solver]\n"
        "method = \"harmonic\"\n" +
            cpu,
        "[loading]\nkind = \"monotonic\"\nrate = 1e-4\nstrain = 1e-4\npoints = 5\n[solver]\nmethod = \"harmonic\"\n" +
            cpu}) {
    const auto out = folder_ / "out";
    std::filesystem::remove_all(out);
    EXPECT_EQ(test::message_of([&] { run(scene(pairs + test), out); }), "nothing was thrown") << test;
    const std::string summary = test::read(out / "summary.json");
    EXPECT_HAS(summary, "\"shape\": \"cylinder\"") << test;
  }
}

// Cylinders and boxes of equal volume from the same mix have the same modulus within the scatter of seeds. The moduli
// of four seeds have a standard deviation of 0.7 % (boxes) and 1.3 % (cylinders), so the difference of the means has a
// standard deviation of 0.8 %; the tolerance is four times this value.
TEST(GeneratedCylinders, HaveTheModulusOfBoxes) {
  const double edge = 0.012, height = 0.013;
  const Domain cylinder = cylinder_domain(2 * edge / std::sqrt(std::numbers::pi), height), box{{edge, edge, height}};
  LawTable laws;
  laws.fill(laws::Elastic{1e10, 0.1});
  laws[static_cast<std::size_t>(PairType::aa)] = laws::Elastic{6e10, 0.1};
  laws[static_cast<std::size_t>(PairType::ma)] = laws::Elastic{2e10, 0.1};
  const auto mean = [&](const Domain& domain) {
    double sum = 0;
    for (const std::uint64_t seed : {1, 2, 3, 4}) {
      const Specimen s = generate_specimen(mix(domain, seed)).specimen;
      const ContactNetwork network = build_network(s, tessellate(s));
      sum += Harmonic(s, network, laws, make_inertia(s, 2600, 2100), {}, 1).solve(1).top.e_star_pa / 4;
    }
    return sum;
  };
  EXPECT_NEAR(mean(cylinder) / mean(box), 1, 0.032);
}

}  // namespace
}  // namespace macadam
