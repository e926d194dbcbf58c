// SPDX-License-Identifier: GPL-3.0-or-later
/// \file fault_signals.hpp  Says on standard error that the program ends by a fault of memory or arithmetic.
#pragma once

namespace macadam {

/// From now on, SIGSEGV, SIGBUS, SIGILL and SIGFPE write one line with the likely reasons before they end the program
/// as usual. A handler that is already there (of a sanitizer, say) is kept. Without the line, a program that runs in
/// the background ends without a word.
void report_fault_signals();

}  // namespace macadam
