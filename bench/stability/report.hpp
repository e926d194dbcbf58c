// SPDX-License-Identifier: GPL-3.0-or-later
/// \file report.hpp  The table as CSV, of which scripts/documents makes docs/stability.md.
#pragma once

#include <filesystem>

#include "bench/stability/stability.hpp"

namespace macadam::stability {

/// A case that has run.
struct Outcome {
  Case of;
  Rows rows;
  double seconds = 0;
  std::string error;  ///< what it threw; a failure

  int failed() const;  ///< rows that do not pass, and one for an error
};

/// Where and when, as the head says it.
struct Circumstances {
  std::string date, commit, processor, effort;
  std::string cuda;  ///< in words: run, or why not
};

void write_csv(const std::filesystem::path& file, const std::vector<Outcome>& outcomes, const Circumstances& where);

/// One line of a row for a terminal.
std::string to_line(const Row& row);

}  // namespace macadam::stability
