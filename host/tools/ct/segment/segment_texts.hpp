// SPDX-License-Identifier: GPL-3.0-or-later
/// \file segment_texts.hpp  Reads the command's options for the region and the memory.
#pragma once

#include <string>

#include "macadam/ct.hpp"

namespace macadam::ct {

/// Sets the region from a text: found, whole, cylinder, prism, cylinder:x,y,diameter[,z0,z1] or
/// prism:x0,y0,z0,x1,y1,z1. \throws InputError.
void read_region(const std::string& text, SegmentOptions& options);

/// Returns the bytes of memory that may be used, from a text such as "3 GB" or "800 MB". For an empty text returns four
/// fifths of the free memory, which leaves some to the system and other programs. \throws InputError.
double memory_of(const std::string& text);

}  // namespace macadam::ct
