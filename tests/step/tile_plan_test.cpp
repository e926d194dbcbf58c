// SPDX-License-Identifier: GPL-3.0-or-later
// tile_plan_test.cpp  Executes the plan of tiles (the parts of a specimen that a GPU steps) in plain loops. Every load
// of a contact must be added to its particles once, and in the same order for any division into tiles.
#include "kernels/layout/tile_plan.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/support/test_scenes.hpp"

namespace macadam::kernels {
namespace {

/// Returns a random load for each contact: the load on its end A. Its end B gets the negative load.
std::vector<float> some_loads(const ContactNetwork& network) {
  std::mt19937 random(5);
  std::vector<float> out;
  for (std::size_t k = 0; k < network.contacts.size(); ++k)
    out.push_back(static_cast<float>(random()) / 4294967296.0f - 0.5f);
  return out;
}

/// Returns the number, in the network, of a contact of the plan.
std::uint32_t number_of(const Layout& layout, const TileContact& c) {
  for (const auto& group : layout.groups) {
    if (static_cast<std::uint32_t>(&group - layout.groups.data()) == c.group) return group.contact[c.group_slot];
  }
  return inert;
}

/// Returns the load cells of a tile as its threads would leave them. Expects that every cell is written exactly
/// once.
std::vector<float> fill_cells(const TilePlan& plan, const Layout& layout, const Tile& tile,
                              const std::vector<float>& load) {
  std::vector<float> cells(tile.cells, 0);
  std::vector<int> written(tile.cells, 0);
  const auto put = [&](std::uint16_t cell, float x) {
    if (cell == TilePlan::no_cell) return;
    ASSERT_LT(cell, tile.cells);
    cells[cell] = x;
    EXPECT_EQ(++written[cell], 1);
  };
  const auto take = [&](std::uint32_t first, std::uint32_t packets) {
    for (std::uint32_t lane = 0; lane < 32; ++lane) {
      float couple = 0;
      for (std::uint32_t j = 0; j < packets; ++j) {
        const TileContact& c = plan.contact[(tile.first_packet + first + j) * 32 + lane];
        const float x = c.group_slot == UINT32_MAX ? 0 : load[number_of(layout, c)];
        if (first < TilePlan::couple * tile.inner) {
          for (const std::uint32_t local : {c.local_a, c.local_b})
            EXPECT_TRUE(local < tile.bodies || local >= tile.bodies + tile.halo)
                << "an inner double packet waits for another tile";
        }
        couple += x;
        if (c.cell_a != TilePlan::more_of_couple) {
          put(c.cell_a, couple);
          couple = 0;
        }
        put(c.cell_b, -x);
      }
      EXPECT_EQ(couple, 0) << "a couple goes on beyond its packets";
    }
  };
  const std::uint32_t ones = TilePlan::couple * tile.double_packets;
  for (std::uint32_t first = 0; first < ones; first += TilePlan::couple) take(first, TilePlan::couple);
  for (std::uint32_t packet = ones; packet < tile.packets; ++packet) take(packet, 1);
  EXPECT_EQ(std::count(written.begin(), written.end(), 1), static_cast<std::ptrdiff_t>(tile.cells));
  return cells;
}

/// Returns the sum of loads per particle as tiles compute it.
std::vector<float> sums_by_tiles(const test::TestScene& scene, const TileSize& size, const std::vector<float>& load) {
  const Layout layout = make_layout(scene.specimen, scene.network, 32, size);
  const TilePlan plan = plan_tiles(scene.network, layout);
  EXPECT_TRUE(plan.fits);
  EXPECT_EQ(plan.tile.size(), layout.tiles());
  EXPECT_EQ(plan.tile.size() > 1, size.contacts < load.size());
  std::vector<float> out(scene.specimen.size());
  for (std::size_t t = 0; t < plan.tile.size(); ++t) {
    const Tile& tile = plan.tile[t];
    const std::vector<float> cells = fill_cells(plan, layout, tile, load);
    for (std::uint32_t r = 0; r < tile.bodies; ++r) {
      const std::uint32_t place = tile.first_body + r, n = plan.list[2 * place];
      float sum = 0;
      for (std::uint32_t e = 0; e < n; ++e) {
        sum += cells[r < tile.long_lists ? plan.list[2 * place + 1] + e
                                         : plan.diagonal[t * TilePlan::longest_short_list + e] + r];
      }
      out[static_cast<std::size_t>(layout.particle[static_cast<std::size_t>(plan.body[place])])] = sum;
    }
  }
  return out;
}

void expect_every_load_arrives(const test::TestScene& scene) {
  const std::vector<float> load = some_loads(scene.network);
  std::vector<double> expected(scene.specimen.size(), 0.0);
  std::vector<double> largest(scene.specimen.size(), 0.0);
  for (std::size_t k = 0; k < load.size(); ++k) {
    const Contact& c = scene.network.contacts[k];
    for (const auto& [body, sign] : {std::pair{c.a, 1.0}, std::pair{c.b, -1.0}}) {
      if (body < 0) continue;
      expected[static_cast<std::size_t>(body)] += sign * load[k];
      largest[static_cast<std::size_t>(body)] += std::abs(load[k]);
    }
  }
  const std::vector<float> whole = sums_by_tiles(scene, load.size(), load);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    const double rounding =
        static_cast<double>(scene.network.row(i).size()) * 0x1p-24 * largest[i];  // rounding of a sum of n terms
    EXPECT_NEAR(whole[i], expected[i], rounding) << "particle " << i;
  }
  for (const std::size_t contacts : {700u, 300u, 120u}) {
    for (const bool even : {false, true}) EXPECT_EQ(sums_by_tiles(scene, {contacts, even}, load), whole);
  }
}

TEST(TilePlan, EveryLoadArrivesAndInOneOrderForAnyTiles) {
  expect_every_load_arrives(test::make_scene(test::random_specimen(3, 7, 6, 8)));
}

// A sphere of 4 mm among spheres of about 1 mm touches about seventy spheres. All of them have lower numbers than the
// large sphere, so each contact has its own cell in the list of the large sphere.
TEST(TilePlan, LoadsArriveInRowsOfAnyLength) {
  const Specimen small = test::random_specimen(3, 7, 6, 8);
  const Vec3d middle = 0.5 * small.box.size;
  const double large = 4e-3;
  Specimen specimen;
  specimen.box = small.box;
  const auto add = [&](const Vec3d& centre, double radius) {
    specimen.centre.push_back(centre);
    specimen.radius.push_back(radius);
    specimen.phase.push_back(Phase::mastic);
    specimen.body.push_back(-1);
  };
  for (std::size_t i = 0; i < small.size(); ++i) {
    if (norm(small.centre[i] - middle) > large + small.radius[i]) add(small.centre[i], small.radius[i]);
  }
  add(middle, large);
  const test::TestScene scene = test::make_scene(specimen);
  const std::size_t whole = scene.network.contacts.size();
  const TilePlan plan = plan_tiles(scene.network, make_layout(scene.specimen, scene.network, 32, whole));
  ASSERT_GT(plan.tile.at(0).long_lists, 0u);
  expect_every_load_arrives(scene);
}

TEST(TilePlan, AFewSpheresFit) {
  for (int n = 1; n <= 4; ++n) {
    const test::HandMade made = test::cubic_lattice_network(1, 1, n, 2e-3, 1e-5);
    const TilePlan plan = plan_tiles(made.network, make_layout(made.specimen, made.network, 32, 1000));
    EXPECT_TRUE(plan.fits) << n;
    EXPECT_EQ(plan.most_locals, static_cast<std::uint32_t>(n + walls));
  }
}

TEST(TilePlan, RunsLeaveFewSlotsAndFewPlacesEmpty) {
  const test::TestScene scene = test::make_scene(test::random_specimen(4, 12, 12, 14));
  const Layout layout = make_layout(scene.specimen, scene.network, 32, 2000);
  const TilePlan plan = plan_tiles(scene.network, layout);
  std::size_t cells = 0, real = 0, inner = 0;
  for (const Tile& tile : plan.tile) cells += tile.cells, inner += tile.inner;
  EXPECT_GT(inner, 0u);
  for (const TileContact& c : plan.contact) real += c.group_slot != UINT32_MAX;
  // Each contact has its own load cell for its end B. Two contacts of a couple share one cell for their ends A. The
  // last couple of a particle may have only one contact.
  EXPECT_LE(cells, (3 * scene.network.contacts.size() + scene.specimen.size()) / 2);
  // In each tile, at most the last double packet of every warp and the last packet are partly empty.
  EXPECT_LE(plan.contact.size(), real + plan.tile.size() * 32 * (TilePlan::couple + 1));
}

TEST(TilePlan, EvenTilesTouchAboutAsManyContactsEach) {
  const test::TestScene scene = test::make_scene(test::random_specimen(4, 12, 12, 14));
  const auto fullest = [&](bool even) {  // ratio of the largest to the mean number of contacts per tile
    const TilePlan plan = plan_tiles(scene.network, make_layout(scene.specimen, scene.network, 32, {500, even}));
    std::size_t most = 0, all = 0;
    for (const Tile& tile : plan.tile) {
      std::size_t touched = 0;
      for (std::size_t i = 32u * tile.first_packet; i < 32u * (tile.first_packet + tile.packets); ++i)
        touched += plan.contact[i].group_slot != UINT32_MAX;
      most = std::max(most, touched), all += touched;
    }
    return static_cast<double>(most * plan.tile.size()) / static_cast<double>(all);
  };
  EXPECT_LT(fullest(true), 1.05);  // one particle more or less changes the number of contacts of a tile by about 2 %
  EXPECT_LT(fullest(true), fullest(false));
}

TEST(TilePlan, PlacesInTheTableOfVelocitiesAreThoseOfTheEnds) {
  const test::TestScene scene = test::make_scene(test::random_specimen(4, 8, 8, 10));
  const Layout layout = make_layout(scene.specimen, scene.network, 32, 300);
  const TilePlan plan = plan_tiles(scene.network, layout);
  std::size_t of_other_tiles = 0;
  for (const Tile& tile : plan.tile) {
    ASSERT_LE(tile.first_halo + tile.halo, plan.halo.size());
    const auto body_at = [&](std::uint32_t local) {
      if (local < tile.bodies) return plan.body[tile.first_body + local];
      if (local >= tile.bodies + tile.halo)
        return static_cast<std::int32_t>(layout.particles() + local - tile.bodies - tile.halo);
      ++of_other_tiles;
      return plan.body[static_cast<std::size_t>(plan.halo[tile.first_halo + local - tile.bodies])];
    };
    for (std::size_t k = 32 * std::size_t{tile.first_packet}; k < 32 * std::size_t{tile.first_packet + tile.packets};
         ++k) {
      const TileContact& c = plan.contact[k];
      if (c.group_slot == UINT32_MAX) continue;
      const Contact& contact = scene.network.contacts[number_of(layout, c)];
      ASSERT_EQ(body_at(c.local_a), layout.body_of(contact.a));
      ASSERT_EQ(body_at(c.local_b), layout.body_of(contact.b));
    }
  }
  EXPECT_GT(of_other_tiles, 0u);
}

}  // namespace
}  // namespace macadam::kernels
