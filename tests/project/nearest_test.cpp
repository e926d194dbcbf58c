// SPDX-License-Identifier: GPL-3.0-or-later
// nearest_test.cpp  An error message suggests a known word only if one is similar to the given word.
#include "host/base/nearest.hpp"

#include <gtest/gtest.h>

namespace macadam::test {
namespace {

const std::vector<std::string> sections{"specimen", "contacts", "loading", "solver", "output", "seed"};

TEST(Nearest, GuessesAWordWithFewEdits) {
  const std::string list = " (the nearest of specimen, contacts, loading, solver, output, seed)";
  EXPECT_EQ(expected_one_of("specimens", sections), "specimen" + list);
  EXPECT_EQ(expected_one_of("LOADING", sections), "loading" + list);  // upper and lower case are equal
  EXPECT_EQ(expected_one_of("sede", sections), "seed" + list);        // two exchanged letters are one edit
  EXPECT_EQ(expected_one_of("sovler", sections), "solver" + list);
  EXPECT_EQ(expected_one_of("spezimen", sections), "specimen" + list);
}

TEST(Nearest, GuessesNothingIfNoWordIsNear) {
  const std::string list = "one of specimen, contacts, loading, solver, output, seed";
  for (const char* word : {"frequencies", "binder", "hz", "x", "", "-"})
    EXPECT_EQ(expected_one_of(word, sections), list);
}

TEST(Nearest, GuessesTheOnlyWordThatBeginsSo) {
  EXPECT_EQ(expected_one_of("spec", sections),
            "specimen (the nearest of specimen, contacts, loading, solver, output, seed)");
  EXPECT_EQ(expected_one_of("s", sections), "one of specimen, contacts, loading, solver, output, seed");
  EXPECT_EQ(expected_one_of("-o", {"--out", "--seed"}), "--out (the nearest of --out, --seed)");
}

TEST(Nearest, CountsEdits) {
  EXPECT_EQ(letters_between("seed", "Seed"), 0);
  EXPECT_EQ(letters_between("sede", "seed"), 1);
  EXPECT_EQ(letters_between("", "seed"), 4);
  EXPECT_EQ(letters_between("kitten", "sitting"), 3);
  EXPECT_EQ(nearest("binder", {"solver", "binders"}), "binders");
}

TEST(Nearest, CutsLongWords) {
  // the function must return at once, although comparing such a long word would take minutes
  EXPECT_EQ(expected_one_of(std::string(1 << 22, 'x'), {"seed"}), "seed");
}

}  // namespace
}  // namespace macadam::test
