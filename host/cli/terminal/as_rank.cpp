// SPDX-License-Identifier: GPL-3.0-or-later
// as_rank.cpp  Decides which of the processes prints, and ends all of them together.
#include "host/cli/terminal/as_rank.hpp"

#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <new>
#include <string>
#include <thread>

#include "host/cli/terminal/json_lines.hpp"
#include "host/cli/terminal/streams.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

/// Ends all processes after an error. Processes other than the first wait before they report the error. If all
/// processes have the same error, only the first one reports it, because it ends the others while they wait.
[[noreturn]] void end_all(Ranks& team, const std::exception& error, const char* why, int code) {
  const bool first = team.number() == 0;
  if (!first) std::this_thread::sleep_for(std::chrono::seconds(10));
  say_error("macadam: {}{}\n", first ? "" : fmt::format("rank {}: ", team.number()), why);
  print_json_error(error);
  print_json_end(code);
  flush_output();
  team.end_all(code);
  std::_Exit(code);
}

}  // namespace

void as_rank(Ranks& team, const std::function<void(bool&)>& f) {
  const bool first = team.number() == 0;
  if (!first) silence_output();
  omp_set_num_threads(std::max(1, omp_get_max_threads() / team.count_on_host()));
  bool together = false;
  try {
    f(together);
    team.leave();
  } catch (const InterruptedError& error) {
    if (!together) end_all(team, error, error.what(), 1);
    team.leave();  // before this call the first rank has written the checkpoint
    if (first) throw;
  } catch (const std::bad_alloc& error) {
    end_all(team, error, "out of memory", 1);
  } catch (const std::exception& error) {
    end_all(team, error, error.what(), dynamic_cast<const InputError*>(&error) ? 2 : 1);
  }
}

}  // namespace macadam
