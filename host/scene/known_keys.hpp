// SPDX-License-Identifier: GPL-3.0-or-later
/// \file known_keys.hpp  Lists every key that the scene reader knows. The list is made by the reader itself: it runs
/// over sections without values, and each key that it would read is collected instead.
#pragma once

#include <string>
#include <vector>

#include "host/scene/table.hpp"

namespace macadam::scene {

/// A key or a section of a scene.
struct KnownKey {
  std::string section;  ///< "[solver]", "[[contacts]]"; empty for a key outside of all sections
  std::string name;
  Need need = Need::optional;
  Words words;
  std::string text, usual;  ///< as in struct Key
  std::string chooser;      ///< key, such as "kind", that decides whether this key is allowed; empty if none does
  std::vector<std::string> chosen;  ///< values of the chooser with which this key is allowed
  bool operator==(const KnownKey&) const = default;
};

/// Returns all keys, section by section, in the order in which they are read.
std::vector<KnownKey> known_keys();

/// Collects keys. While a collector is in use, Section::read passes its keys to the collector instead of reading their
/// values.
class Collector {
 public:
  /// Thrown to leave the reader of a section once its keys are known, before the reader looks at their values.
  struct Done {};

  /// Adds one key. If the key is a section, calls `enter`, which reads the keys of the section. `enter` is called once
  /// for every value that choose() can return in this section.
  void add(const std::string& section, const std::string& named, const Key& key, const std::function<void()>& enter);
  /// The reader calls this function for a key, such as "kind", whose value decides which other keys its section has.
  /// `among` lists the possible values. Returns the index of the value to assume in the present pass through the
  /// section; add() makes one pass for each value.
  std::size_t choose(const std::string& named, const std::vector<std::string>& among);

  /// Returns the collected keys. A key that is read with several values of the chooser appears once.
  std::vector<KnownKey> keys() const;

 private:
  /// A key whose value decides which other keys its section has.
  struct Choice {
    std::string named;
    std::vector<std::string> among;  ///< possible values of the key
    std::size_t taken = 0;           ///< index of the value in the present pass
  };
  std::vector<KnownKey> keys_;
  Choice choice_;  ///< choice of the section that is being read
};

}  // namespace macadam::scene
