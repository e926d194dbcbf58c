// SPDX-License-Identifier: GPL-3.0-or-later
// known_keys.cpp  Collects keys while the scene reader runs.
#include "host/scene/known_keys.hpp"

#include <algorithm>

#include "host/scene/sections.hpp"

namespace macadam::scene {
namespace {

/// Returns "kind" for "[loading] kind".
std::string last_word(const std::string& named) { return named.substr(named.rfind(' ') + 1); }

}  // namespace

void Collector::add(const std::string& section, const std::string& named, const Key& key,
                    const std::function<void()>& enter) {
  KnownKey known{section, key.name, key.need, key.read.words, key.text, key.usual, "", {}};
  if (!choice_.among.empty()) {
    known.chooser = last_word(choice_.named);
    known.chosen = {choice_.among[choice_.taken]};
    if (named == choice_.named) known.words.choices = choice_.among;
  }
  const auto same = [&](KnownKey other) {
    other.chosen = known.chosen;
    return other == known;
  };
  if (const auto twin = std::find_if(keys_.begin(), keys_.end(), same); twin == keys_.end())
    keys_.push_back(known);
  else
    twin->chosen.insert(twin->chosen.end(), known.chosen.begin(), known.chosen.end());
  if (!known.words.type.starts_with("section")) return;
  const Choice outside = std::exchange(choice_, {});
  do {
    try {
      enter();
    } catch (const Done&) {}
  } while (++choice_.taken < choice_.among.size());
  choice_ = outside;
}

std::size_t Collector::choose(const std::string& named, const std::vector<std::string>& among) {
  choice_.named = named, choice_.among = among;
  return choice_.taken;
}

std::vector<KnownKey> Collector::keys() const {
  std::vector<KnownKey> out = keys_;
  for (KnownKey& key : out) {
    // The reader makes one pass for each value of a chooser, a key such as "kind". The chooser itself is collected in
    // every pass, so its `chosen` lists all of its values. Another key with the same list was read in every pass, so
    // this key does not depend on the chooser.
    const bool always = std::any_of(keys_.begin(), keys_.end(), [&](const KnownKey& chooser) {
      return chooser.section == key.section && chooser.name == key.chooser && chooser.chosen == key.chosen;
    });
    if (always) key.chooser.clear(), key.chosen.clear();
  }
  // groups the keys by section, because a section inside another one is read between the keys of the outer section
  std::vector<std::string> sections;
  for (const KnownKey& key : out)
    if (std::find(sections.begin(), sections.end(), key.section) == sections.end()) sections.push_back(key.section);
  const auto place = [&](const KnownKey& key) { return std::find(sections.begin(), sections.end(), key.section); };
  std::stable_sort(out.begin(), out.end(), [&](const KnownKey& a, const KnownKey& b) { return place(a) < place(b); });
  return out;
}

}  // namespace macadam::scene
