// SPDX-License-Identifier: GPL-3.0-or-later
/// \file in_quotes.hpp  Puts text from a file into quotes, for messages.
#pragma once

#include <string>
#include <string_view>

namespace macadam {

/// Returns the text in quotes, in a form that fits into one line of a message. Control characters become `?`. Text
/// longer than 60 bytes is cut, never within a UTF-8 character.
inline std::string in_quotes(std::string_view text) {
  std::size_t longest = 60;
  while (longest > 0 && text.size() > longest && (static_cast<unsigned char>(text[longest]) & 0xC0) == 0x80) --longest;
  std::string out(text.substr(0, longest));
  for (char& c : out)
    if (static_cast<unsigned char>(c) < ' ' || c == 0x7F) c = '?';
  return '"' + out + (text.size() > longest ? "…\"" : "\"");
}

}  // namespace macadam
