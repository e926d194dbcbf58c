// SPDX-License-Identifier: GPL-3.0-or-later
// known_keys_test.cpp  The table of keys agrees with the scene reader, every key has a description, and docs/keys.md
// shows the table.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "host/scene/keys_page.hpp"
#include "host/scene/known_keys.hpp"
#include "macadam/error.hpp"
#include "macadam/scene.hpp"

namespace macadam::test {
namespace {

using scene::KnownKey;
using scene::Need;

/// Returns the sections that every scene must have, except the section `but`.
std::string needed(const std::string& but) {
  const std::map<std::string, std::string> all{
      {"[specimen]",
       "[specimen]\nbox = [0.01, 0.01, 0.01]\n[specimen.mastic]\nradius = [5e-4, 1e-3]\nporosity = 0.1\n"},
      {"[materials]", "[materials.mastic]\ndensity = 2000\n"},
      {"[[contacts]]", "[[contacts]]\npair = \"M-M\"\nlaw = \"elastic\"\nE = 1e9\n"},
      {"[loading]", "[loading]\nkind = \"cyclic\"\nfrequencies = [1.0]\n"}};
  std::string out;
  for (const auto& [title, text] : all) {
    // the name without the bracket also matches subsections such as [specimen.mastic]
    const std::string name = title.substr(0, title.find(']'));
    if (!but.starts_with(name) && !but.starts_with("[" + name)) out += text;
  }
  return out;
}

/// Returns the keys of a section that the reader lists in its error message about an unknown key.
std::set<std::string> listed_in_error(const std::string& section, const std::string& chooser,
                                      const std::string& choice) {
  std::string text = "nobody = 1\n";
  if (!section.empty()) {
    const bool in_specimen = section.find("specimen.") != std::string::npos;
    text = needed(section) + (in_specimen ? "[specimen]\nbox = [0.01, 0.01, 0.01]\n" : "") + section + "\n";
    if (!chooser.empty()) text += chooser + " = \"" + choice + "\"\n";
    text += "nobody = 1\n";
  }
  try {
    read_scene("scene.toml", text);
  } catch (const InputError& error) {
    const std::string message = error.what(), before = "an unknown ";
    if (message.find(before) == std::string::npos) throw;
    // no key resembles "nobody", so the message lists all keys
    const std::string list = message.substr(message.find("expected ") + 9);
    std::istringstream words(list.starts_with("one of ") ? list.substr(7) : list);
    std::set<std::string> out;
    for (std::string word; words >> word;) out.insert(word.substr(0, word.find_first_of(",)")));
    return out;
  }
  return {};
}

TEST(KnownKeys, AreThoseOfTheReader) {
  const std::vector<KnownKey> keys = scene::known_keys();
  std::map<std::string, std::set<std::string>> choosers;  // the kinds that a section can have
  std::map<std::string, std::string> chooser_of;
  std::set<std::string> sections;
  for (const KnownKey& key : keys) {
    sections.insert(key.section);
    if (key.chooser.empty()) continue;
    chooser_of[key.section] = key.chooser;
    choosers[key.section].insert(key.chosen.begin(), key.chosen.end());
  }
  EXPECT_EQ(choosers["[loading]"].size(), std::variant_size_v<Experiment>);
  // laws with a crack are not named by `law`
  const auto named = []<class... L>(std::type_identity<std::variant<L...>>) {
    return (std::size_t{named_law<L>} + ...);
  };
  EXPECT_EQ(choosers["[[contacts]]"].size(), named(std::type_identity<Law>()));
  EXPECT_GE(sections.size(), 13u);
  for (const std::string& section : sections) {
    std::set<std::string> choices = choosers[section];
    if (choices.empty()) choices = {""};
    for (const std::string& choice : choices) {
      std::set<std::string> known;
      for (const KnownKey& key : keys) {
        const bool may = key.chosen.empty() || std::count(key.chosen.begin(), key.chosen.end(), choice);
        if (key.section == section && may) known.insert(key.name);
      }
      EXPECT_EQ(known, listed_in_error(section, chooser_of[section], choice)) << section << " " << choice;
    }
  }
}

TEST(KnownKeys, SayWhatTheyAre) {
  for (const KnownKey& key : scene::known_keys()) {
    const std::string name = key.section + " " + key.name;
    EXPECT_FALSE(key.text.empty()) << name;
    EXPECT_FALSE(key.words.type.empty()) << name;
    if (key.words.type == "one of") { EXPECT_GE(key.words.choices.size(), 2u) << name; }
    if (key.words.type.find("number") != std::string::npos && !key.words.type.starts_with("whole")) {
      EXPECT_TRUE(key.words.quantity) << name;
    }
    if (key.need == Need::optional) { EXPECT_FALSE(key.usual.empty() && key.words.usual.empty()) << name; }
  }
}

TEST(KnownKeys, HaveTheDefaultsOfTheReader) {
  std::map<std::string, std::string> usual;
  for (const KnownKey& key : scene::known_keys()) usual[key.section + key.name] = key.words.usual;
  EXPECT_EQ(usual["[specimen]seed"], "1");
  EXPECT_EQ(usual["[specimen.shapes]single"], "\"intermediate\"");
  EXPECT_EQ(usual["[loading]strain_amplitude"], "0.0001");
  EXPECT_EQ(usual["[solver]backend"], "\"auto\"");
  EXPECT_EQ(usual["[output]response"], "true");
  EXPECT_EQ(usual["[specimen.recipe]cut"], "0.002");
}

TEST(KnownKeys, StandInTheDocuments) {
  const std::filesystem::path page = std::filesystem::path(MACADAM_EXAMPLES).parent_path() / "docs/keys.md";
  std::ifstream in(page);
  std::stringstream text;
  text << in.rdbuf();
  EXPECT_EQ(text.str(), scene::keys_page()) << "macadam info --keys markdown >docs/keys.md";
}

}  // namespace
}  // namespace macadam::test
