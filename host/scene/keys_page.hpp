// SPDX-License-Identifier: GPL-3.0-or-later
/// \file keys_page.hpp  Makes the reference of all keys of a scene from the keys that the scene reader knows.
#pragma once

#include <string>

namespace macadam::scene {

/// Return the reference as a page of Markdown (docs/keys.md), or as JSON.
/// @{
std::string keys_page();
std::string keys_json();
/// @}

}  // namespace macadam::scene
