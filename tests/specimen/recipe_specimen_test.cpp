// SPDX-License-Identifier: GPL-3.0-or-later
/// \file recipe_specimen_test.cpp  Makes specimens of mix designs by mass. The measured composition of their particles
/// must be the requested one, and the program must print and write it.
#include <algorithm>
#include <numbers>

#include "tests/support/program.hpp"

namespace macadam::test {
namespace {

class RecipeSpecimen : public Program {
 protected:
  /// Writes the scene of a mixture with three classes above 2 mm in a small box.
  fs::path write_recipe(const std::string& more = "") const {
    std::string contacts = am1_contacts;
    contacts = contacts.substr(contacts.find("[[contacts]]"));
    const fs::path file = folder_ / "recipe.toml";
    write(file, R"([specimen]
box = ["20 mm", "20 mm", "24 mm"]
[specimen.recipe]
gradation = [["8 mm", 1], ["5.6 mm", 0.85], ["4 mm", 0.7], ["2 mm", 0.45], ["0.5 mm", 0.2], ["0.063 mm", 0.08]]
binder = "6 %"
binder_of = "mix"
aggregate_density = [2700, 2650, 2600, 2600, 2600]
filler_density = 2750
binder_density = 1030
absorbed_binder = "0.5 %"
air_voids = "4 %"
envelope = [["4 mm", 0.6, 0.68], ["2 mm", 0.4, 0.5]]
[specimen.mastic]
radius = ["0.75 mm", "1 mm"]
[loading]
kind = "cyclic"
frequencies = [10.0]
[solver]
method = "harmonic"
)" + more + contacts);
    return file;
  }
};

double volume_of_sphere(double diameter) { return std::numbers::pi / 6 * diameter * diameter * diameter; }

/// Size and volume of a particle.
struct Body {
  double size, volume;
};

/// Expects that the particles between the sieves of each class have the requested volume and mass. The tolerance is the
/// smallest particle of the class: one particle more or less would not bring the class nearer to the request. Every
/// particle must be in a class.
void expect_classes(const Scene& scene, const std::vector<Body>& bodies, double mastic) {
  const MixVolumes asked = volumes_of(*scene.recipe);
  const double box = scene.specimen.box.volume();
  double mass = mastic * asked.mastic_density / box, last = 0;
  std::size_t counted = 0;
  for (const MixClass& c : asked.classes) {
    double volume = 0, smallest = box;
    for (const Body& b : bodies) {
      // A diameter may equal a sieve size. The diameter is computed as twice a radius, and the radius was computed as
      // half of a diameter, so the diameter may differ from the sieve size by rounding.
      if (b.size < c.sieve_min * (1 - 1e-12) || b.size > c.sieve_max * (1 + 1e-12)) continue;
      ++counted, volume += b.volume, smallest = std::min(smallest, b.volume);
    }
    EXPECT_NEAR(volume / box, c.volume, smallest / box) << c.sieve_min;
    EXPECT_NEAR(volume * c.density / box / asked.bulk_density, c.mass, smallest * c.density / box / asked.bulk_density);
    mass += volume * c.density * (1 + asked.absorbed_binder) / box;
    last += smallest * c.density / box;
  }
  EXPECT_EQ(counted, bodies.size());
  EXPECT_NEAR(mastic / box, asked.mastic_volume, volume_of_sphere(2 * scene.specimen.mastic->radius_max) / box);
  EXPECT_NEAR(mass, asked.bulk_density, last + asked.mastic_density * 1e-3);
}

double mastic_volume(const Specimen& specimen) {
  double out = 0;
  for (std::size_t i = 0; i < specimen.size(); ++i) {
    if (specimen.phase[i] == Phase::mastic) out += volume_of_sphere(2 * specimen.radius[i]);
  }
  return out;
}

TEST_F(RecipeSpecimen, OfSpheresHasItsShares) {
  const Scene scene = read_scene(write_recipe());
  const GeneratedSpecimen made = generate_specimen(scene.specimen);
  std::vector<Body> bodies;
  for (std::size_t i = 0; i < made.specimen.size(); ++i) {
    const double d = 2 * made.specimen.radius[i];
    if (made.specimen.phase[i] == Phase::aggregate) bodies.push_back({d, volume_of_sphere(d)});
  }
  expect_classes(scene, bodies, mastic_volume(made.specimen));

  // Recomputes the gradation from the particles: the dry mass finer than each sieve. The mastic contains its fixed
  // fraction of fines.
  const MixVolumes v = volumes_of(*scene.recipe);
  const double fines =
      (v.mastic_fine_mass + v.mastic_filler_mass) / v.mastic_mass * v.mastic_density * mastic_volume(made.specimen);
  const auto passing = [&](double sieve) {
    double mass = fines;
    for (const Body& b : bodies) {
      for (const MixClass& c : v.classes) {
        if (b.size > c.sieve_min && b.size <= c.sieve_max && b.size <= sieve) mass += b.volume * c.density;
      }
    }
    return mass;
  };
  for (const GradationRow& row : gradation_of(*scene.recipe, made.composition)) {
    if (row.size < scene.recipe->cut) continue;
    EXPECT_NEAR(row.reached, passing(row.size) / passing(1), 1e-12) << row.size;
    EXPECT_NEAR(row.reached, row.asked, 0.002) << row.size;  // classes may miss 0.2 % of the box
  }
}

TEST_F(RecipeSpecimen, OfShapesHasItsShares) {
  const Scene scene = read_scene(
      write_recipe("[[contacts]]\npair = \"inner\"\nlaw = \"elastic\"\nE = 1e11\n"
                   "[specimen.shapes]\nlibrary = \"icosahedron\"\nradius = [\"1 mm\", \"2 mm\"]\nporosity = 0\n"));
  const GeneratedSpecimen made = generate_specimen(scene.specimen);
  std::vector<Body> bodies;
  for (const Aggregate& a : made.aggregates) bodies.push_back({a.size, a.volume});
  expect_classes(scene, bodies, mastic_volume(made.specimen));
}

TEST_F(RecipeSpecimen, IsWrittenAndSaid) {
  const fs::path file = write_recipe();
  const Outcome made = macadam(fmt::format("specimen {} --out {}", path("recipe.toml"), path("out")));
  ASSERT_EQ(made.code, 0) << made.err;
  const MixVolumes v = volumes_of(*read_scene(file).recipe);
  EXPECT_HAS(made.out,
             "recipe: binder 6.00 % of the mix by mass, 6.38 % of the aggregate by mass; effective binder 5.53 % of "
             "the mix by mass");
  EXPECT_HAS(made.out,
             fmt::format("maximum density {:.1f} kg/m3, bulk density {:.1f} kg/m3", v.maximum_density, v.bulk_density));
  EXPECT_HAS(made.out, fmt::format("VMA {:.2f} %, VFB {:.2f} %", 100 * v.vma, 100 * v.vfb));
  EXPECT_HAS(made.out, "0.5 mm        20.00%    20.00% (in the mastic)");
  EXPECT_HAS(made.out, "outside of the envelope: 70 % passing the sieve of 4 mm");

  const nlohmann::json recipe = summary("out")["recipe"];
  EXPECT_EQ(recipe["maximum_density"], v.maximum_density);
  EXPECT_EQ(recipe["vfb"], v.vfb);
  EXPECT_EQ(recipe["mastic"]["density"], v.mastic_density);
  ASSERT_EQ(recipe["classes"].size(), 3u);
  EXPECT_EQ(recipe["classes"][0]["class"], "5.6-8 mm");
  EXPECT_EQ(recipe["outside_of_envelope_m"], nlohmann::json::array({0.004}));
  EXPECT_EQ(recipe["envelope"][1]["most"], 0.5);
  EXPECT_NEAR(double(recipe["reached"]["bulk_density"]) / v.bulk_density, 1,
              0.005);  // at most 0.2 % of the box per class
  EXPECT_NEAR(double(recipe["reached"]["air_voids"]), 0.04, 0.005);

  const auto rows = lines_of(read(folder_ / "out" / "gradation.csv"));
  ASSERT_EQ(rows.size(), 7u);
  EXPECT_EQ(rows[0], "sieve,asked,reached");
  EXPECT_EQ(rows[1], "0.008,1,1");
  EXPECT_EQ(rows[5].substr(0, 11), "0.0005,0.2,");
  EXPECT_EQ(recipe["gradation"][4]["reached"], std::stod(rows[5].substr(11)));

  // A scene without a recipe in the same folder removes the file.
  write_scene();
  ASSERT_EQ(macadam(fmt::format("specimen {} --out {}", path("scene.toml"), path("out"))).code, 0);
  EXPECT_FALSE(fs::exists(folder_ / "out" / "gradation.csv"));
  EXPECT_FALSE(summary("out").contains("recipe"));
}

TEST_F(RecipeSpecimen, IsSaidAndWrittenByARun) {
  write_recipe();
  const Outcome done = macadam(fmt::format("run {} --out {}", path("recipe.toml"), path("out")));
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_HAS(done.out, "recipe: binder 6.00 % of the mix");
  EXPECT_HAS(done.out, "summary.json specimen.csv aggregates.csv gradation.csv");
  EXPECT_EQ(summary("out")["status"], "done");
  EXPECT_EQ(summary("out")["recipe"]["binder"], 0.06);
  EXPECT_TRUE(fs::exists(folder_ / "out" / "gradation.csv"));
}

}  // namespace
}  // namespace macadam::test
