// SPDX-License-Identifier: GPL-3.0-or-later
/// \file known_keys.hpp  Every key that the reader of scenes knows, as the reader itself has it: it is run over
/// sections without values, and what it would read is collected in place of reading it.
#pragma once

#include <string>
#include <vector>

#include "host/scene/table.hpp"

namespace macadam::scene {

/// A key, or a section, of a scene.
struct KnownKey {
  std::string section;  ///< "[solver]", "[[contacts]]"; empty: of the whole file
  std::string name;
  Need need = Need::optional;
  Words words;
  std::string text, usual;  ///< as in Key
  std::string chooser;      ///< the key of the section that decides whether it may be there: "kind"; empty: none
  std::vector<std::string> chosen;  ///< its values with which it may be
  bool operator==(const KnownKey&) const = default;
};

/// All of them, a section after the other, as they are read.
std::vector<KnownKey> known_keys();

/// What Section::read does with its keys while they are collected.
class Collector {
 public:
  /// Leaves the reader of a section once its keys are known, before it looks at their values.
  struct Done {};

  /// `enter` reads the key's value: what is in it where it is a section, once for every choice that is made in there.
  void add(const std::string& section, const std::string& named, const Key& key, const std::function<void()>& enter);
  /// A text that decides what else its section takes: one of them after the other.
  std::size_t choose(const std::string& named, const std::vector<std::string>& among);

  /// What was collected; what several choices have in common stands once.
  std::vector<KnownKey> keys() const;

 private:
  struct Choice {
    std::string named;
    std::vector<std::string> among;
    std::size_t taken = 0;
  };
  std::vector<KnownKey> keys_;
  Choice choice_;  ///< of the section that is being read
};

}  // namespace macadam::scene
