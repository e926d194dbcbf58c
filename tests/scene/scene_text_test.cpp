// SPDX-License-Identifier: GPL-3.0-or-later
// scene_text_test.cpp  Tests how paths in the text of a scene change if the scene is written into another folder.
#include "host/scene/scene_text.hpp"

#include <gtest/gtest.h>

namespace macadam::test {
namespace {

/// Returns the path of the library in a scene after the scene was moved from /a to /a/b.
std::string moved_library(const std::string& library) {
  scene::SceneText text("[specimen.shapes]\nlibrary = \"" + library + "\"\n");
  text.move("/a", "/a/b");
  return text.text();
}

TEST(SceneText, NamesOfShippedLibrariesStay) {
  for (const char* library : {"aggregates", "icosahedron", "aggregates and icosahedron"}) {
    EXPECT_EQ(moved_library(library), "[specimen.shapes]\nlibrary = \"" + std::string(library) + "\"\n");
  }
}

TEST(SceneText, AFolderOfShapesIsAPath) {
  EXPECT_EQ(moved_library("stones"), "[specimen.shapes]\nlibrary = \"./../stones\"\n");
}

}  // namespace
}  // namespace macadam::test
