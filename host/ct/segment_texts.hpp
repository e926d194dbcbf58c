// SPDX-License-Identifier: GPL-3.0-or-later
/// \file segment_texts.hpp  What is said in words of a segmentation: region, memory.
#pragma once

#include <string>

#include "macadam/ct.hpp"

namespace macadam::ct {

/// found, whole, cylinder, prism, cylinder:x,y,diameter[,z0,z1] or prism:x0,y0,z0,x1,y1,z1. \throws InputError.
void read_region(const std::string& text, SegmentOptions& options);

/// Bytes that may be taken: "3 GB", "800 MB"; empty: four fifths of what is free, for the system and others take some
/// too. \throws InputError.
double memory_of(const std::string& text);

}  // namespace macadam::ct
