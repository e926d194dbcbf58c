// SPDX-License-Identifier: GPL-3.0-or-later
/// \file table.hpp  Checked access to TOML tables: each section is read through one list of its keys, so the keys that
/// are known and the keys that are read cannot differ. Every error names file, line, key, what was found and expected.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "host/scene/toml.hpp"
#include "host/scene/units.hpp"

namespace macadam::scene {

/// What a number must satisfy besides being finite, and the words for it.
struct Rule {
  bool (*holds)(double);
  const char* words;
};
inline constexpr Rule any{[](double) { return true; }, "a number"};
inline constexpr Rule positive{[](double v) { return v > 0; }, "a positive number"};
inline constexpr Rule non_negative{[](double v) { return v >= 0; }, "a number that is not negative"};

class Section;

/// One value of a scene and where it stands.
class Value {
 public:
  /// A node of `file`, called `name` in messages; `path` is its dotted key.
  Value(std::string file, int line, std::string name, std::string path, const toml::node& node)
      : file_(std::move(file)), line_(line), name_(std::move(name)), path_(std::move(path)), node_(&node) {}

  /// A finite number that satisfies the rule, in SI units; text must carry a unit of the quantity.
  double number(const Quantity& quantity, const Rule& rule) const;
  /// An array of such numbers.
  std::vector<double> numbers(const Quantity& quantity, const Rule& rule) const;
  /// A whole number in [min, max]; 2e6 counts as whole, 5.5 does not.
  std::int64_t integer(std::int64_t min, std::int64_t max) const;
  /// true or false.
  bool boolean() const;
  /// Text that is not empty.
  std::string text() const;
  /// The position in `names` of this text.
  std::size_t choice(const std::vector<std::string>& names) const;
  /// The entries of an array.
  std::vector<Value> entries(const std::string& expected) const;
  /// The value as a section `[path]`.
  Section section() const;
  /// The value as sections `[[path]]`, at least one.
  std::vector<Section> sections() const;

  int line() const { return line_; }
  /// Whether the value is an array.
  bool is_array() const { return node_->is_array(); }
  /// Whether the value is written `inf`.
  bool is_infinite() const;
  /// The value as messages show it.
  std::string shown() const;
  /// \throws InputError for this value.
  [[noreturn]] void refuse(const std::string& found, const std::string& expected) const;

 private:
  const toml::array& array(const std::string& expected) const;

  std::string file_;
  int line_;
  std::string name_, path_;
  const toml::node* node_;
};

enum class Need : std::uint8_t { optional, required };

/// A key of a section, and what to do with its value.
struct Key {
  std::string name;
  Need need;
  std::function<void(const Value&)> read;
};

/// A TOML table of which every key has to be known.
class Section {
 public:
  /// The table `title` (as messages show it; empty for the whole file), its dotted key and its line (0: none).
  Section(std::string file, int line, std::string title, std::string path, const toml::table& table)
      : file_(std::move(file)), line_(line), title_(std::move(title)), path_(std::move(path)), table_(&table) {}

  /// Refuses unknown keys (naming the nearest known one), then reads the given keys in this order.
  /// \throws InputError for an unknown, missing or wrong key.
  void read(const std::vector<Key>& keys) const;

  /// The value of a key, if it is there.
  std::optional<Value> find(const std::string& key) const;
  const std::string& file() const { return file_; }
  int line() const { return line_; }
  /// Whether the key is there.
  bool has(const std::string& key) const { return table_->contains(key); }
  /// \throws InputError at the key's line, or at the section's where the key is absent.
  [[noreturn]] void refuse(const std::string& key, const std::string& found, const std::string& expected) const;

 private:
  std::string name(const std::string& key) const;

  std::string file_;
  int line_;
  std::string title_, path_;
  const toml::table* table_;
};

/// Readers for the keys of a section: each stores the checked value in `target`, which must outlive Section::read.
/// @{
using Reader = std::function<void(const Value&)>;
inline Reader into(double& target, const Quantity& quantity, const Rule& rule) {
  return [&target, &quantity, rule](const Value& value) { target = value.number(quantity, rule); };
}
inline Reader into(std::optional<double>& target, const Quantity& quantity, const Rule& rule) {
  return [&target, &quantity, rule](const Value& value) { target = value.number(quantity, rule); };
}
inline Reader into(std::vector<double>& target, const Quantity& quantity, const Rule& rule) {
  return [&target, &quantity, rule](const Value& value) { target = value.numbers(quantity, rule); };
}
template <class Integer>
Reader into(Integer& target, std::int64_t min, std::int64_t max = std::numeric_limits<std::int64_t>::max()) {
  return [&target, min, max](const Value& value) { target = static_cast<Integer>(value.integer(min, max)); };
}
inline Reader into(bool& target) {
  return [&target](const Value& value) { target = value.boolean(); };
}
template <class Enum>
Reader into(Enum& target, std::vector<std::pair<std::string, Enum>> names) {
  return [&target, names = std::move(names)](const Value& value) {
    std::vector<std::string> words;
    for (const auto& [word, meaning] : names) words.push_back(word);
    target = names[value.choice(words)].second;
  };
}
template <class Integer>
Reader into(std::optional<Integer>& target, std::int64_t min, std::int64_t max) {
  return [&target, min, max](const Value& value) { target = static_cast<Integer>(value.integer(min, max)); };
}
template <class Enum>
Reader into(std::optional<Enum>& target, std::vector<std::pair<std::string, Enum>> names) {
  return [&target, names = std::move(names)](const Value& value) {
    Enum found{};
    into<Enum>(found, names)(value);
    target = found;
  };
}
/// @}

}  // namespace macadam::scene
