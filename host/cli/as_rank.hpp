// SPDX-License-Identifier: GPL-3.0-or-later
/// \file as_rank.hpp  A command that several processes run together.
#pragma once

#include <functional>

#include "macadam/ranks.hpp"

namespace macadam {

/// Runs f() as one of several processes, of which the first alone writes to standard output. An error of any ends all,
/// as the others would wait for it for ever. `interrupted_together`: set by f() where from then on all of them are
/// interrupted at the same step. \throws InterruptedError then, on the first.
void as_rank(Ranks& team, const std::function<void(bool& interrupted_together)>& f);

}  // namespace macadam
