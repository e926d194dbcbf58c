// SPDX-License-Identifier: GPL-3.0-or-later
/// \file gzip.hpp  Compresses texts with gzip and unpacks them, for mutators.
#pragma once

#include <string>
#include <string_view>

#include "tests/fuzz/mutate.hpp"

namespace macadam::fuzz {

/// Returns the text that the gzip bytes unpack to, up to the first invalid byte and at most 64 KiB.
std::string unpacked(std::string_view bytes);

/// Returns the text as one gzip stream, or as two streams in sequence.
std::string packed(const std::string& text, Random& random);

/// Returns the beginning of the text, followed by one piece of the text that is repeated up to some megabytes. The
/// repetitions compress to almost nothing.
std::string repeated(const std::string& text, Random& random);

}  // namespace macadam::fuzz
