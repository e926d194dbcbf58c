// SPDX-License-Identifier: GPL-3.0-or-later
/// \file stop_signals.hpp  Handles the signals that ask the program to stop: Ctrl-C, SIGTERM from a queueing system,
/// SIGHUP from a terminal that closes.
#pragma once

namespace macadam {

/// Installs the signal handlers. The first of these signals asks the program to stop. Signals within the next two
/// seconds are ignored, because one request may send two signals: coreutils' timeout signals its child and then the
/// child's group. A later signal ends the program at once. Signals that are ignored already, as under nohup, stay
/// ignored.
void listen_to_stop_signals();

/// Returns whether a signal has asked the program to stop.
bool stop_asked();

}  // namespace macadam
