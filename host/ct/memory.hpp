// SPDX-License-Identifier: GPL-3.0-or-later
/// \file memory.hpp  How much memory there is to take.
#pragma once

namespace macadam::ct {

/// What the machine has free, or this process may take of it, whichever is less [bytes].
double memory_available();

}  // namespace macadam::ct
