// SPDX-License-Identifier: GPL-3.0-or-later
/// \file in_quotes.hpp  Text of a file in a message.
#pragma once

#include <string>
#include <string_view>

namespace macadam {

/// In quotes, printable, not too long.
inline std::string in_quotes(std::string_view text) {
  constexpr std::size_t longest = 60;
  std::string out(text.substr(0, longest));
  for (char& c : out)
    if (c < ' ' || c > '~') c = '?';
  return '"' + out + (text.size() > longest ? "…\"" : "\"");
}

}  // namespace macadam
