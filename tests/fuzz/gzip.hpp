// SPDX-License-Identifier: GPL-3.0-or-later
/// \file gzip.hpp  Texts within gzip, for mutators.
#pragma once

#include <string>
#include <string_view>

#include "tests/fuzz/mutate.hpp"

namespace macadam::fuzz {

/// What the bytes unpack to, as far as they do; 64 KiB at most.
std::string unpacked(std::string_view bytes);

/// As one stream, or as two behind each other.
std::string packed(const std::string& text, Random& random);

/// One line of the text so often that the whole is some megabytes: they pack to next to nothing.
std::string repeated(const std::string& text, Random& random);

}  // namespace macadam::fuzz
