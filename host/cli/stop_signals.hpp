// SPDX-License-Identifier: GPL-3.0-or-later
/// \file stop_signals.hpp  Ctrl-C, SIGTERM of a queueing system, SIGHUP of a terminal that closes.
#pragma once

namespace macadam {

/// From now on the first of these signals asks to stop and those of the next two seconds are taken for its echo:
/// coreutils' timeout sends one to its child and another to the group of it. A later one ends the program at once.
/// Signals that are ignored, as nohup has it, stay so.
void listen_to_stop_signals();

/// Whether a signal has asked to stop.
bool stop_asked();

}  // namespace macadam
