// SPDX-License-Identifier: GPL-3.0-or-later
// text_edits.cpp  Converts positions of the TOML parser to positions in the text.
#include "host/scene/text_edits.hpp"

#include <algorithm>

namespace macadam::scene {

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

std::string in_toml_quotes(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

TextEdit replaced(const std::string& text, const toml::node& value, std::string by) {
  return {offset_of(text, value.source().begin), offset_of(text, value.source().end), std::move(by)};
}

std::optional<TextEdit> added(const std::string& text, const toml::table& table, const std::string& key,
                              const std::string& value) {
  toml::source_position first{~toml::source_index{0}, 0};
  for (const auto& [k, v] : table)
    if (!v.is_table() || v.as_table()->is_inline()) first = std::min(first, k.source().begin);
  if (first.line == ~toml::source_index{0}) return {};
  const std::size_t at = offset_of(text, first);
  return TextEdit{at, at, key + " = " + value + (table.is_inline() ? ", " : "\n")};
}

}  // namespace macadam::scene
