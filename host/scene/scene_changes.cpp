// SPDX-License-Identifier: GPL-3.0-or-later
// scene_changes.cpp  Changes the tables of a scene, and then its text. There are several ways to write a value into a
// text. They are tried one after the other, until a text has the same content as the changed tables.
#include "host/scene/scene_changes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <sstream>

#include "host/base/in_quotes.hpp"
#include "host/base/nearest.hpp"
#include "host/scene/sections.hpp"
#include "host/scene/text_edits.hpp"
#include "macadam/error.hpp"

namespace macadam::scene {
namespace {

/// One text KEY=VALUE. Each part of the path is a key of the parsed line, which knows the line as its source.
struct SetValue {
  std::string source;            ///< `--set KEY=VALUE`, for messages
  std::string written;           ///< the value as TOML text
  toml::table line;              ///< the line as the parser read it
  std::vector<toml::key> path;   ///< parts of the dotted key
  const toml::node* value = {};  ///< the value in `line`

  [[noreturn]] void refuse(const std::string& found, const std::string& expected) const {
    throw InputError(source, 0, "key", found, expected);
  }
};

std::string trimmed(const std::string& text) {
  const auto begin = text.find_first_not_of(' '), end = text.find_last_not_of(' ');
  return begin == std::string::npos ? "" : text.substr(begin, end - begin + 1);
}

/// Returns whether a text may stand for itself without quotes.
bool is_plain(const std::string& text) {
  return std::all_of(text.begin(), text.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c >= 0x80 ||
           std::string_view(" ._-+%/").find(static_cast<char>(c)) != std::string::npos;
  });
}

SetValue parsed(const std::string& change) {
  SetValue out;
  out.source = std::string(set_option) + change;
  const auto refuse = [&](const std::string& found) {
    throw InputError(out.source, 0, "TOML syntax", found, "KEY=VALUE, such as solver.tolerance=1e-3");
  };
  const auto sign = change.find('=');
  if (sign == std::string::npos) refuse("no \"=\"");
  const std::string key = trimmed(change.substr(0, sign));
  out.written = trimmed(change.substr(sign + 1));
  if (key.empty()) refuse("no key");
  // in TOML these begin a comment and the header of a section
  if (key[0] == '#' || key[0] == '[') refuse("the key " + in_quotes(key));
  if (out.written.empty()) refuse("no value");
  if (std::any_of(change.begin(), change.end(), [](unsigned char c) { return c < ' '; })) refuse("a control character");
  const auto read = [&] { out.line = parse_toml(key + " = " + out.written, out.source, out.source); };
  try {
    read();
  } catch (const InputError&) {
    if (!is_plain(out.written)) {
      try {
        (void)toml::parse(key + " = " + out.written);
      } catch (const toml::parse_error& error) { refuse(std::string(error.description())); }
      throw;  // the line is too long
    }
    out.written = in_toml_quotes(out.written);
    try {
      read();
    } catch (const InputError&) { refuse("the key " + in_quotes(key)); }
  }
  const toml::node* at = &out.line;
  while (at->is_table() && !at->as_table()->is_inline()) {
    if (at->as_table()->empty()) refuse("the key " + in_quotes(key));
    const auto first = at->as_table()->begin();  // the pair below lives in the iterator
    const auto& [part, below] = *first;
    out.path.push_back(part), at = &below;
  }
  out.value = at;
  return out;
}

/// Returns the index of an entry that is named by its pair or by its number.
std::size_t index_of(const toml::array& entries, const SetValue& set, std::size_t part) {
  const std::string name(set.path[part].str());
  std::vector<std::string> pairs;
  for (std::size_t k = 0; k < entries.size(); ++k) {
    const auto* entry = entries[k].as_table();
    const auto pair = entry ? (*entry)["pair"].value<std::string>() : std::nullopt;
    if (pair == name) return k;
    if (pair) pairs.push_back(*pair);
  }
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  if (error == std::errc{} && end == name.data() + name.size() && number < entries.size()) return number;
  const std::string numbers =
      entries.empty() ? "an empty list" : fmt::format("a number from 0 to {}", entries.size() - 1);
  set.refuse(in_quotes(name) + ", which the scene does not have",
             pairs.empty() ? numbers : expected_one_of(name, pairs) + ", or " + numbers);
}

/// Returns what one part of the path names in `at`; nullptr if a table does not have it.
const toml::node* step(const toml::node& at, const SetValue& set, std::size_t part) {
  if (const auto* table = at.as_table()) return table->get(set.path[part].str());
  if (const auto* array = at.as_array()) return array->get(index_of(*array, set, part));
  set.refuse(fmt::format("a value at {} in the scene", in_quotes(std::string(set.path[part - 1].str()))),
             "a section or a list there");
}

std::string key_text(const toml::key& key) {
  const std::string name(key.str());
  const bool bare = !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '-';
  });
  return bare ? name : in_toml_quotes(name);
}

/// Returns parts of the path with dots between them.
std::string dotted(const SetValue& set, std::size_t begin, std::size_t end) {
  std::string out;
  for (std::size_t k = begin; k < end; ++k) out += (k > begin ? "." : "") + key_text(set.path[k]);
  return out;
}

/// Sets the value in the tables of the scene. Nodes are moved out of the line, because a copy of a node has no source.
void set_in(toml::table& root, SetValue& set) {
  toml::node *at = &root, *from = &set.line;
  for (std::size_t k = 0; k < set.path.size(); ++k) {
    toml::node* below = from->as_table()->get(set.path[k].str());
    toml::node* const next = const_cast<toml::node*>(step(*at, set, k));
    if (auto* array = at->as_array(); array && k + 1 == set.path.size()) {
      const auto place = array->cbegin() + std::ptrdiff_t(index_of(*array, set, k));
      below->visit([&](auto& one) { array->replace(place, std::move(one)); });
      return;
    }
    if (!next || k + 1 == set.path.size()) {
      toml::table& table = *at->as_table();
      if (!next && k + 1 < set.path.size()) {
        const std::string number(set.path[k + 1].str());
        if (std::all_of(number.begin(), number.end(), [](unsigned char c) { return std::isdigit(c) != 0; }))
          set.refuse("no list " + dotted(set, 0, k + 1) + " in the scene",
                     dotted(set, 0, k + 1) + "=[{…}], the whole list");
      }
      table.erase(set.path[k].str());  // otherwise the table would keep the old key with its old source
      below->visit([&](auto& one) { table.insert_or_assign(set.path[k], std::move(one)); });
      return;
    }
    at = next, from = below;
  }
}

/// Returns whether a node was written with headers: [section] or [[section]].
bool has_header(const toml::node& node) {
  if (const auto* table = node.as_table()) return !table->is_inline();
  const auto* array = node.as_array();
  return array && !array->empty() && array->is_array_of_tables() && has_header(*array->get(0));
}

/// Collects the positions of the headers in a node.
void find_headers(const std::string& text, const toml::node& node, std::vector<std::size_t>& out) {
  if (const auto* table = node.as_table(); table && !table->is_inline()) {
    const std::size_t at = offset_of(text, table->source().begin);
    if (at < text.size() && text[at] == '[') out.push_back(at);
    for (const auto& [key, below] : *table) find_headers(text, below, out);
  } else if (const auto* array = node.as_array()) {
    for (const toml::node& below : *array) find_headers(text, below, out);
  }
}

/// Returns the text without the sections of a node that has headers. A section ends at the next header.
std::string without_sections(std::string text, const toml::table& root, const toml::node& node) {
  std::vector<std::size_t> all, of_node;
  find_headers(text, root, all), find_headers(text, node, of_node);
  std::sort(all.begin(), all.end()), std::sort(of_node.rbegin(), of_node.rend());
  of_node.erase(std::unique(of_node.begin(), of_node.end()), of_node.end());
  for (const std::size_t begin : of_node) {
    const auto next = std::upper_bound(all.begin(), all.end(), begin);
    const std::size_t end = next == all.end() ? text.size() : *next;
    text.erase(begin, end - begin);
  }
  return text;
}

std::string formatted(const toml::table& table) {
  std::ostringstream out;
  out << toml::toml_formatter(table) << '\n';
  return out.str();
}

/// Returns the texts that may have the value, the most readable one first. Not each of them is right.
std::vector<std::string> candidates(const std::string& text, const SetValue& set) {
  const toml::table root = toml::parse(text);
  const toml::node *at = &root, *next = nullptr;
  std::size_t k = 0;
  bool in_list = false;
  for (; k < set.path.size() && (next = step(*at, set, k)); ++k) in_list = in_list || at->is_array(), at = next;
  const std::string end = text.empty() || text.ends_with('\n') ? "\n" : "\n\n";
  const std::string last = dotted(set, set.path.size() - 1, set.path.size());
  const std::string in_section = end + (set.path.size() > 1 ? "[" + dotted(set, 0, set.path.size() - 1) + "]\n" : "") +
                                 last + " = " + set.written + "\n";
  std::vector<std::string> out;
  if (k == set.path.size()) {  // the value exists
    if (!has_header(*at)) return {replaced(text, *at, set.written).applied_to(text)};
    const std::string rest = without_sections(text, root, *at);
    if (const auto* table = set.value->as_table()) {
      std::string section = "\n[" + dotted(set, 0, k) + "]\n";
      for (const auto& [key, node] : *table) {
        std::ostringstream value;
        node.visit([&](const auto& one) { value << toml::table{{"v", one}}; });  // `{ v = VALUE }` or `v = VALUE`
        section += key_text(key) + value.str().substr(value.str().find(" = ")) + "\n";
      }
      out.push_back(rest + section);
    }
    return out;
  }
  const std::string below = dotted(set, k, set.path.size());
  if (!in_list && k + 1 < set.path.size()) out.push_back(text + in_section);
  if (const auto* table = at->as_table()) {
    if (const auto edit = added(text, *table, below, set.written)) out.push_back(edit->applied_to(text));
    if (k > 0) {  // behind the header of a section without keys
      const std::size_t line = text.find('\n', offset_of(text, table->source().begin));
      const std::size_t place = line == std::string::npos ? text.size() : line + 1;
      out.push_back(text.substr(0, place) + (line == std::string::npos ? "\n" : "") + below + " = " + set.written +
                    "\n" + text.substr(place));
    }
  }
  if (!in_list) out.push_back(text + in_section);
  return out;
}

bool has_content(const std::string& text, const toml::table& table) {
  try {
    return toml::parse(text) == table;
  } catch (const toml::parse_error&) { return false; }
}

}  // namespace

ChangedScene with_changes(toml::table table, std::string text, const std::vector<std::string>& changes) {
  ChangedScene out{std::move(table), std::move(text)};
  for (const std::string& change : changes) {
    SetValue set = parsed(change);
    std::vector<std::string> texts = candidates(out.text, set);
    set_in(out.table, set);
    texts.push_back(formatted(out.table));  // without comments
    const auto right =
        std::find_if(texts.begin(), texts.end(), [&](const std::string& t) { return has_content(t, out.table); });
    // values that are not equal to themselves (nan) have no right text; the reader refuses them
    out.text = right == texts.end() ? texts.back() : *right;
  }
  return out;
}

}  // namespace macadam::scene
