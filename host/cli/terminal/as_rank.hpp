// SPDX-License-Identifier: GPL-3.0-or-later
/// \file as_rank.hpp  Runs a command in several processes together.
#pragma once

#include <functional>

#include "macadam/ranks.hpp"

namespace macadam {

/// Runs f() as one of several processes, of which only the first writes to standard output. An error in one process
/// ends all of them, because the others would wait for it forever. f() sets `interrupted_together` once an
/// interruption stops all processes at the same step. \throws InterruptedError in that case, in the first process.
void as_rank(Ranks& team, const std::function<void(bool& interrupted_together)>& f);

}  // namespace macadam
