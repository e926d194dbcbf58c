// SPDX-License-Identifier: GPL-3.0-or-later
/// \file stop_signals.hpp  Handles the signals that ask the program to stop: Ctrl-C, SIGTERM from a queueing system,
/// SIGHUP from a terminal that closes.
#pragma once

namespace macadam {

/// From now on the first of these signals asks to stop. Those of the next two seconds are ignored as its echo:
/// coreutils' timeout sends one to its child and another to the child's group. A later one ends the program at once.
/// Signals that are ignored already, as under nohup, stay ignored.
void listen_to_stop_signals();

/// Whether a signal has asked to stop.
bool stop_asked();

}  // namespace macadam
