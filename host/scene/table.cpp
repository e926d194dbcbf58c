// SPDX-License-Identifier: GPL-3.0-or-later
/// \file table.cpp  Checks types, ranges and unknown keys of TOML tables.
#include "host/scene/table.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "host/base/in_quotes.hpp"
#include "host/base/nearest.hpp"
#include "host/scene/known_keys.hpp"
#include "host/scene/scene_changes.hpp"
#include "macadam/error.hpp"

namespace macadam::scene {
namespace {

int line_of(const toml::source_region& region) { return static_cast<int>(region.begin.line); }

/// File and line of a value for messages; line 0 if no line applies.
struct Place {
  std::string file;
  int line;
};

/// Returns where a value was written: in the scene's file or in an option that set it.
Place place_of(const toml::source_region& region, const std::string& file) {
  if (region.path && region.path->starts_with(set_option)) return {*region.path, 0};
  return {file, line_of(region)};
}

std::string listed(const std::vector<std::string>& words) { return fmt::format("{}", fmt::join(words, ", ")); }

}  // namespace

std::string Value::shown() const {
  if (const auto* text = node_->as_string()) return in_quotes(text->get());
  if (const auto* integer = node_->as_integer()) return std::to_string(integer->get());
  if (const auto* real = node_->as_floating_point()) return fmt::format("{}", real->get());
  if (const auto* boolean = node_->as_boolean()) return boolean->get() ? "true" : "false";
  if (const auto* array = node_->as_array()) return fmt::format("an array of length {}", array->size());
  if (node_->is_table()) return "a table";
  return "a date or time";
}

void Value::refuse(const std::string& found, const std::string& expected) const {
  throw InputError(file_, line_, name_, found, expected);
}

double Value::number(const Quantity& quantity, const Rule& rule) const {
  std::optional<double> value;
  if (const auto* text = node_->as_string()) {
    value = parse(text->get(), quantity);
  } else if (const auto* integer = node_->as_integer()) {
    value = static_cast<double>(integer->get());
  } else if (const auto* real = node_->as_floating_point()) {
    value = real->get();
  }
  if (!value) refuse(shown(), accepted(quantity));
  if (!std::isfinite(*value)) refuse(shown(), "a finite number");
  if (!rule.holds(*value)) refuse(shown(), rule.words);
  return *value;
}

bool Value::is_infinite() const {
  const auto* real = node_->as_floating_point();
  return real && std::isinf(real->get()) && real->get() > 0;
}

const toml::array& Value::array(const std::string& expected) const {
  const auto* array = node_->as_array();
  if (!array) refuse(shown(), expected);
  return *array;
}

std::vector<Value> Value::entries(const std::string& expected) const {
  std::vector<Value> out;
  for (const toml::node& node : array(expected)) {
    const std::string entry = fmt::format("{}, entry {}", name_, out.size() + 1);
    const auto [file, line] = place_of(node.source(), file_);
    out.emplace_back(file, line, entry, path_, node);
  }
  return out;
}

std::vector<double> Value::numbers(const Quantity& quantity, const Rule& rule) const {
  std::vector<double> out;
  for (const Value& entry : entries("an array, each entry " + accepted(quantity)))
    out.push_back(entry.number(quantity, rule));
  return out;
}

std::int64_t Value::integer(std::int64_t min, std::int64_t max) const {
  const std::string expected = max == std::numeric_limits<std::int64_t>::max()
                                   ? fmt::format("an integer of at least {}", min)
                                   : fmt::format("an integer from {} to {}", min, max);
  constexpr double exact = 9007199254740992.0;  // 2^53: above it a double cannot represent every whole number
  std::optional<std::int64_t> value;
  if (const auto* integer = node_->as_integer()) {
    value = integer->get();
  } else if (const auto* real = node_->as_floating_point()) {
    if (std::abs(real->get()) <= exact && std::floor(real->get()) == real->get()) {
      value = static_cast<std::int64_t>(real->get());
    }
  }
  if (!value || *value < min || *value > max) refuse(shown(), expected);
  return *value;
}

bool Value::boolean() const {
  const auto* boolean = node_->as_boolean();
  if (!boolean) refuse(shown(), "true or false");
  return boolean->get();
}

std::string Value::text() const {
  const auto* text = node_->as_string();
  if (!text || text->get().empty()) refuse(shown(), "text that is not empty");
  for (const char c : text->get()) {
    if (std::iscntrl(static_cast<unsigned char>(c)))
      refuse(fmt::format("{} with the control character U+{:04X}", shown(), static_cast<unsigned char>(c)),
             "text without control characters");
  }
  return text->get();
}

std::size_t Value::choice(const std::vector<std::string>& names) const {
  if (collector_) return collector_->choose(name_, names);
  const auto* text = node_->as_string();
  const auto found = text ? std::find(names.begin(), names.end(), text->get()) : names.end();
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  std::vector<std::string> words;
  for (const auto& name : names) words.push_back(in_quotes(name));
  refuse(shown(), (words.size() > 1 ? "one of " : "") + listed(words));
}

Section Value::section() const {
  const auto* table = node_->as_table();
  if (!table) refuse(shown(), "a section [" + path_ + "]");
  return Section(file_, line_, "[" + path_ + "]", path_, *table, collector_);
}

std::vector<Section> Value::sections() const {
  const std::string expected = "sections [[" + path_ + "]], with double brackets";
  std::vector<Section> out;
  if (collector_) return {Section(file_, line_, "[[" + path_ + "]]", path_, *node_->as_table(), collector_)};
  for (const toml::node& node : array(expected)) {
    const auto* table = node.as_table();
    const auto [file, line] = place_of(node.source(), file_);
    const Value entry(file, line, name_, path_, node);
    if (!table) entry.refuse(entry.shown(), expected);
    out.emplace_back(file, line, "[[" + path_ + "]]", path_, *table);
  }
  if (out.empty()) refuse("none", expected);
  return out;
}

std::string Section::name(const std::string& key) const {
  return title_.empty() ? "[" + key + "]" : title_ + " " + key;
}

std::optional<Value> Section::find(const std::string& key) const {
  const auto path_of_key = [&] { return path_.empty() ? key : path_ + "." + key; };
  if (collector_) return Value(file_, 0, name(key), path_of_key(), *table_, collector_);
  const auto found = table_->find(key);
  if (found == table_->end()) return {};
  const auto [file, line] = place_of(found->first.source(), file_);
  return Value(file, line, name(key), path_of_key(), found->second);
}

void Section::refuse(const std::string& key, const std::string& found, const std::string& expected) const {
  if (const auto value = find(key)) value->refuse(found, expected);
  throw InputError(file_, line_, name(key), found, expected);
}

void Section::read(const std::vector<Key>& keys) const {
  if (collector_) {
    for (const Key& key : keys) {
      collector_->add(title_, name(key.name), key, [&] { key.read.read(*find(key.name)); });
    }
    throw Collector::Done();
  }
  const std::string kind = title_.empty() ? "section" : "key";
  std::vector<std::string> known;
  for (const Key& key : keys) known.push_back(key.name);
  for (const auto& [key, node] : *table_) {
    const std::string word(key.str());
    if (std::find(known.begin(), known.end(), word) == known.end()) {
      refuse(word, "an unknown " + kind, expected_one_of(word, known));
    }
  }
  for (const Key& key : keys) {
    if (const auto value = find(key.name)) {
      key.read.read(*value);
    } else if (key.need == Need::required) {
      refuse(key.name, "nothing", "this " + kind + ", which is required");
    }
  }
}

}  // namespace macadam::scene
