// SPDX-License-Identifier: GPL-3.0-or-later
/// \file text_edits.hpp  Edits the text of a TOML file at the positions that the parser reports. Everything outside of
/// the edited values stays as it is.
#pragma once

#include <optional>
#include <string>

#include "host/scene/toml.hpp"

namespace macadam::scene {

/// Bytes of a text and their replacement.
struct TextEdit {
  std::size_t begin, end;  ///< bytes that are replaced
  std::string by;

  std::string applied_to(std::string text) const { return text.replace(begin, end - begin, by); }
};

/// Returns the byte index of a place in the text. The parser's columns count characters of UTF-8.
std::size_t offset_of(const std::string& text, const toml::source_position& place);

/// Returns the text in TOML's basic quotes.
std::string in_toml_quotes(const std::string& text);

/// Returns the edit that replaces the text of a value, which was parsed from `text`.
TextEdit replaced(const std::string& text, const toml::node& value, std::string by);

/// Returns the edit that adds `key = value` before the first key of a table, which was parsed from `text`; nothing if
/// the table has no keys of its own.
std::optional<TextEdit> added(const std::string& text, const toml::table& table, const std::string& key,
                              const std::string& value);

}  // namespace macadam::scene
