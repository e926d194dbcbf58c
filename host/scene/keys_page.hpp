// SPDX-License-Identifier: GPL-3.0-or-later
/// \file keys_page.hpp  Reference of all keys of a scene, made from the keys that the scene reader knows.
#pragma once

#include <string>

namespace macadam::scene {

/// Return the reference as a page of Markdown (docs/keys.md), or as JSON.
/// @{
std::string keys_page();
std::string keys_json();
/// @}

}  // namespace macadam::scene
