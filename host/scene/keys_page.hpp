// SPDX-License-Identifier: GPL-3.0-or-later
/// \file keys_page.hpp  The reference of every key that a scene may have, as the reader knows them.
#pragma once

#include <string>

namespace macadam::scene {

/// As a page of Markdown, docs/keys.md, and as JSON.
/// @{
std::string keys_page();
std::string keys_json();
/// @}

}  // namespace macadam::scene
