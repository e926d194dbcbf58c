// SPDX-License-Identifier: GPL-3.0-or-later
/// \file ct_scenes.hpp  Small scenes from which the tests make synthetic scans.
#pragma once

#include <fmt/format.h>
#include <unistd.h>

#include "tests/support/test_files.hpp"

namespace macadam::test {

/// Makes a temporary folder for each test and writes scenes into it.
class CtFolder : public testing::Test {
 protected:
  CtFolder()
      : folder_(fs::path(testing::TempDir()) /
                fmt::format("macadam_{}_{}", testing::UnitTest::GetInstance()->current_test_info()->name(), getpid())) {
    fs::create_directories(folder_);
  }
  ~CtFolder() override { fs::remove_all(folder_); }

  Scene scene_of(const std::string& specimen) const {
    write(folder_ / "scene.toml",
          specimen +
              "[loading]\nkind = \"cyclic\"\nfrequencies = [10.0]\n[solver]\nmethod = "
              "\"harmonic\"\n" +
              am1_contacts + "[[contacts]]\npair = \"inner\"\nlaw = \"elastic\"\nE = 1.125e11\nalpha = 0.05\n");
    return read_scene(folder_ / "scene.toml");
  }

  Scene scene_of_rows(const std::string& rows) const {
    write(folder_ / "specimen.csv", "id,x,y,z,radius,phase,body\n" + rows);
    return scene_of("[specimen]\nbox = [0.01, 0.008, 0.008]\nfile = \"specimen.csv\"\n");
  }

  /// Returns a scene of one aggregate, one mastic sphere and one void.
  Scene spheres_scene() const {
    return scene_of_rows(
        "0,0.0035,0.004,0.004,0.003,aggregate,4\n1,0.008,0.002,0.004,0.001,mastic,-1\n"
        "2,0.008,0.005,0.005,0.001,void,-1\n");
  }

  /// Returns a scene with an aggregate of two spheres and one mastic sphere.
  Scene cluster_scene() const {
    return scene_of_rows(
        "0,0.002,0.004,0.004,0.002,aggregate,7\n1,0.005,0.004,0.004,0.002,aggregate,7\n"
        "2,0.008,0.004,0.004,0.001,mastic,-1\n");
  }

  /// Returns a scene with a few icosahedral aggregates of 4 to 6 mm, mastic and voids.
  Scene shapes_scene() const {
    return scene_of(
        "[specimen]\nbox = [0.012, 0.012, 0.014]\n[[specimen.aggregate]]\nsieve = [0.004, 0.006]\n"
        "volume_fraction = 0.25\n[specimen.shapes]\nlibrary = \"icosahedron\"\nradius = [0.0006, 0.0008]\n"
        "[specimen.mastic]\nradius = [0.0006, 0.0008]\nporosity = 0.02\n"
        "[specimen.voids]\nradius = [0.0008, 0.0012]\nfraction = 0.03\n");
  }

  fs::path folder_;
};

}  // namespace macadam::test
