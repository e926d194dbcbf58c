// SPDX-License-Identifier: GPL-3.0-or-later
// scene_text.cpp  Finds values in the text by the positions that the TOML parser reports. The text is parsed again for
// every change.
#include "host/scene/scene_text.hpp"

#include <fmt/format.h>

#include "host/scene/sections.hpp"
#include "host/scene/toml.hpp"
#include "macadam/error.hpp"

namespace macadam::scene {
namespace {

/// Returns the byte index of a place in the text. The parser's columns count characters of UTF-8.
std::size_t offset_of(const std::string& text, const toml::source_position& place) {
  std::size_t at = 0;
  for (toml::source_index line = 1; line < place.line; ++line) at = text.find('\n', at) + 1;
  if (at == 0 && text.starts_with("\xEF\xBB\xBF")) at = 3;  // a byte-order mark
  for (toml::source_index column = 1; column < place.column && at < text.size(); ++column) {
    ++at;
    while (at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0) == 0x80) ++at;
  }
  return at;
}

/// Returns a TOML number that is read back as the same double.
std::string real(double v) {
  const std::string text = fmt::format("{}", v);
  return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

/// Returns the text in TOML's basic quotes.
std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

/// Bytes of a text and their replacement.
struct Change {
  std::size_t begin, end;  ///< bytes that are replaced
  std::string by;
};

Change replaced(const std::string& text, const toml::node& node, std::string by) {
  return {offset_of(text, node.source().begin), offset_of(text, node.source().end), std::move(by)};
}

/// Returns the change that sets one key: its value is replaced if the key is there, otherwise the key is added before
/// the first key of the table.
Change set(const std::string& text, const toml::table& table, const std::string& key, std::string value) {
  if (const toml::node* node = table.get(key)) return replaced(text, *node, std::move(value));
  toml::source_position first{~toml::source_index{0}, 0};
  for (const auto& [k, v] : table)
    if (!v.is_table() || v.as_table()->is_inline()) first = std::min(first, k.source().begin);
  if (first.line == ~toml::source_index{0})
    throw RunError("the key " + key + " cannot be set in a table that has no keys of its own");
  const std::size_t at = offset_of(text, first);
  return {at, at, key + " = " + value + (table.is_inline() ? ", " : "\n")};
}

/// Returns the change that sets a value of a law. `name` is a key of its section, or `E_2` for the second entry of `E`.
Change set_value(const std::string& text, const toml::table& section, const std::string& name, double value) {
  const toml::array* entries =
      name.size() > 2 && name[1] == '_' && name[2] != 'm' ? section[name.substr(0, 1)].as_array() : nullptr;
  return entries ? replaced(text, *entries->get(std::stoul(name.substr(2)) - 1), real(value))
                 : set(text, section, name, real(value));
}

}  // namespace

void SceneText::set_contact(PairType pair, const std::string& name, double value) {
  const toml::table root = toml::parse(text_);
  Change change{0, 0, ""};
  for (const toml::node& node : *root["contacts"].as_array()) {
    const toml::table& section = *node.as_table();
    if (section["pair"].value<std::string>() != to_string(pair)) continue;
    change = set_value(text_, section, name, value);
  }
  replace(change.begin, change.end, change.by);
}

void SceneText::set_material(Phase phase, const std::string& name, double value) {
  const toml::table root = toml::parse(text_);
  const char* section = phase == Phase::mastic ? "mastic" : "aggregate";
  const Change change = set_value(text_, *root["materials"][section].as_table(), name, value);
  replace(change.begin, change.end, change.by);
}

void SceneText::set_seed(std::uint64_t seed) {
  const toml::table root = toml::parse(text_);
  const std::uint64_t given = root["specimen"]["seed"].value<std::uint64_t>().value_or(SpecimenSpec{}.seed);
  if (given == seed) return;
  const Change change = set(text_, *root["specimen"].as_table(), "seed", fmt::format("{}", seed));
  replace(change.begin, change.end, change.by);
}

void SceneText::move(const std::filesystem::path& from, const std::filesystem::path& to) {
  namespace fs = std::filesystem;
  // the text is parsed for each change, because a change moves the text behind it
  for (const bool shapes : {false, true}) {
    const toml::table root = toml::parse(text_);
    const auto view = shapes ? root["specimen"]["shapes"]["library"] : root["specimen"]["file"];
    const auto name = view.value<std::string>();
    if (!name || (shapes && shipped_library(*name)) || fs::path(*name).is_absolute()) continue;
    const fs::path moved =
        fs::weakly_canonical(fs::absolute(from) / *name).lexically_relative(fs::weakly_canonical(fs::absolute(to)));
    // "./" marks the name as the name of a folder, even if a built-in library has the same name
    const Change change = replaced(text_, *view.node(), quoted((shapes ? "./" : "") + moved.string()));
    replace(change.begin, change.end, change.by);
  }
}

}  // namespace macadam::scene
