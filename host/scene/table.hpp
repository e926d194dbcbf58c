// SPDX-License-Identifier: GPL-3.0-or-later
/// \file table.hpp  Gives checked access to TOML tables. Each section is read through one list of its keys, so that
/// the reader cannot read a key that it does not know, or know a key without reading it. Every error names the file,
/// the line, the key, the value found and the values expected.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "host/scene/toml.hpp"
#include "host/base/units.hpp"

namespace macadam::scene {

/// A condition that a finite number must satisfy, and its description for messages.
struct Rule {
  bool (*holds)(double);
  const char* words;
};
inline constexpr Rule any{[](double) { return true; }, "a number"};
inline constexpr Rule positive{[](double v) { return v > 0; }, "a positive number"};
inline constexpr Rule non_negative{[](double v) { return v >= 0; }, "a number that is not negative"};
/// For Poisson's ratios.
inline constexpr Rule of_poisson{[](double v) { return v > -1 && v < 0.5; }, "a ratio above -1 and below 0.5"};

class Section;
class Collector;

/// One value of a scene, with its file, line and name for messages.
class Value {
 public:
  /// `node` is the value in `file`, `name` is what messages call it, and `path` is its dotted key.
  Value(std::string file, int line, std::string name, std::string path, const toml::node& node,
        Collector* collector = nullptr)
      : file_(std::move(file)),
        line_(line),
        name_(std::move(name)),
        path_(std::move(path)),
        node_(&node),
        collector_(collector) {}

  /// Returns a finite number that satisfies the rule, in SI units. Text must have a unit of the quantity.
  double number(const Quantity& quantity, const Rule& rule) const;
  /// Returns an array of numbers, each checked as by number().
  std::vector<double> numbers(const Quantity& quantity, const Rule& rule) const;
  /// Returns a whole number in [min, max]; 2e6 counts as whole, 5.5 does not.
  std::int64_t integer(std::int64_t min, std::int64_t max) const;
  bool boolean() const;
  /// Returns the text, which must not be empty.
  std::string text() const;
  /// Returns the index of this text in `names`.
  std::size_t choice(const std::vector<std::string>& names) const;
  /// Returns the entries of an array.
  std::vector<Value> entries(const std::string& expected) const;
  /// Returns the value as a section `[path]`.
  Section section() const;
  /// Returns the value as sections `[[path]]`, at least one.
  std::vector<Section> sections() const;

  int line() const { return line_; }
  bool is_array() const { return node_->is_array(); }
  bool is_table() const { return node_->is_table(); }
  /// Returns whether the value is text, as numbers with a unit are.
  bool is_text() const { return node_->is_string(); }
  /// Returns whether the value is written `inf`.
  bool is_infinite() const;
  /// Returns the value as messages show it.
  std::string shown() const;
  /// Always throws an InputError about this value.
  [[noreturn]] void refuse(const std::string& found, const std::string& expected) const;

 private:
  const toml::array& array(const std::string& expected) const;

  std::string file_;
  int line_;
  std::string name_, path_;
  const toml::node* node_;
  Collector* collector_;
};

enum class Need : std::uint8_t { optional, required };

/// Description of a value, for people. A member that does not apply is empty.
struct Words {
  std::string type = {};                  ///< "number", "list of numbers", "text", "section", …
  const Quantity* quantity = nullptr;     ///< units of a number; null for other values
  std::string rule = {};                  ///< condition that the value must satisfy
  std::string usual = {};                 ///< default, as a scene would write it
  std::vector<std::string> choices = {};  ///< allowed texts
  bool operator==(const Words&) const = default;
};

/// The function that reads the value of a key, and the description of the value.
struct Reader {
  template <class F>
  requires std::is_invocable_v<F, const Value&> Reader(F f, Words in_words = {})
      : read(std::move(f)), words(std::move(in_words)) {}

  std::function<void(const Value&)> read;
  Words words;
};

/// A key of a section and the reader of its value.
struct Key {
  std::string name;
  Need need;
  Reader read;
  std::string text = {};   ///< meaning of the key, for people
  std::string usual = {};  ///< effect of leaving the key out, in words, if the default is not a fixed value
};

/// A TOML table in which every key must be known.
class Section {
 public:
  /// `title` is what messages call the table (empty for the whole file), `path` is its dotted key, and `line` is 0 if
  /// the table has no line.
  Section(std::string file, int line, std::string title, std::string path, const toml::table& table,
          Collector* collector = nullptr)
      : file_(std::move(file)),
        line_(line),
        title_(std::move(title)),
        path_(std::move(path)),
        table_(&table),
        collector_(collector) {}

  /// Refuses unknown keys, naming the nearest known one, then reads the given keys in this order. With a collector it
  /// reads no values. Instead it passes these keys, and the keys of the sections among them, to the collector and
  /// throws Collector::Done. \throws InputError for an unknown, missing or wrong key.
  void read(const std::vector<Key>& keys) const;

  /// Returns the value of a key, if the key is there.
  std::optional<Value> find(const std::string& key) const;
  const std::string& file() const { return file_; }
  int line() const { return line_; }
  bool has(const std::string& key) const { return table_->contains(key); }
  /// Always throws an InputError, which names the line of the key or, if the key is absent, the line of the section.
  [[noreturn]] void refuse(const std::string& key, const std::string& found, const std::string& expected) const;

 private:
  std::string name(const std::string& key) const;

  std::string file_;
  int line_;
  std::string title_, path_;
  const toml::table* table_;
  Collector* collector_;
};

/// Return a default as a scene would write it; an empty text for values without a default.
/// @{
inline std::string written(double value) { return fmt::format("{}", value); }
inline std::string written(const std::optional<double>&) { return ""; }
inline std::string written(const std::vector<double>&) { return ""; }
/// @}

/// Return readers for the keys of a section. Each reader stores the checked value in `target`, which must outlive
/// Section::read and holds the default until then.
/// @{
inline Reader into(double& target, const Quantity& quantity, const Rule& rule) {
  return {[&target, &quantity, rule](const Value& value) { target = value.number(quantity, rule); },
          {"number", &quantity, rule.words, written(target)}};
}
inline Reader into(std::optional<double>& target, const Quantity& quantity, const Rule& rule) {
  return {[&target, &quantity, rule](const Value& value) { target = value.number(quantity, rule); },
          {"number", &quantity, rule.words}};
}
inline Reader into(std::vector<double>& target, const Quantity& quantity, const Rule& rule) {
  return {[&target, &quantity, rule](const Value& value) { target = value.numbers(quantity, rule); },
          {"list of numbers", &quantity, rule.words}};
}
/// Returns a reader of a positive number whose unit is easily forgotten. A number with a unit only has to be positive.
/// A number without a unit must satisfy `bare`, a rule that is true only for plausible values in SI units.
inline Reader positive_into(double& target, const Quantity& quantity, const Rule& bare) {
  return {[&target, &quantity, bare](const Value& value) {
            target = value.number(quantity, value.is_text() ? positive : bare);
          },
          {"number", &quantity, bare.words, written(target)}};
}
/// Returns the description of whole numbers in a range.
inline Words whole_numbers(std::int64_t min, std::int64_t max, std::string usual = "") {
  return {"whole number", nullptr,
          max == std::numeric_limits<std::int64_t>::max() ? fmt::format("at least {}", min)
                                                          : fmt::format("from {} to {}", min, max),
          std::move(usual)};
}
template <class Integer>
Reader into(Integer& target, std::int64_t min, std::int64_t max = std::numeric_limits<std::int64_t>::max()) {
  return {[&target, min, max](const Value& value) { target = static_cast<Integer>(value.integer(min, max)); },
          whole_numbers(min, max, fmt::format("{}", target))};
}
inline Reader into(bool& target) {
  return {[&target](const Value& value) { target = value.boolean(); },
          {"true or false", nullptr, "", target ? "true" : "false"}};
}
template <class Enum>
Reader into(Enum& target, std::vector<std::pair<std::string, Enum>> names) {
  Words words{"one of", nullptr, "", "", {}};
  for (const auto& [word, meaning] : names) {
    words.choices.push_back(word);
    if (meaning == target) words.usual = '"' + word + '"';
  }
  return {[&target, names = std::move(names), choices = words.choices](const Value& value) {
            target = names[value.choice(choices)].second;
          },
          words};
}
template <class Integer>
Reader into(std::optional<Integer>& target, std::int64_t min, std::int64_t max) {
  return {[&target, min, max](const Value& value) { target = static_cast<Integer>(value.integer(min, max)); },
          whole_numbers(min, max)};
}
template <class Enum>
Reader into(std::optional<Enum>& target, std::vector<std::pair<std::string, Enum>> names) {
  Words words{"one of", nullptr, "", "", {}};
  for (const auto& [word, meaning] : names) words.choices.push_back(word);
  return {[&target, names = std::move(names)](const Value& value) {
            Enum found{};
            into<Enum>(found, names).read(value);
            target = found;
          },
          words};
}
/// Return a reader of one section, or of several sections with the same name.
template <class F>
Reader section_by(F read) {
  return {std::move(read), {"section"}};
}
template <class F>
Reader sections_by(F read) {
  return {std::move(read), {"sections"}};
}
/// @}

}  // namespace macadam::scene
