// SPDX-License-Identifier: GPL-3.0-or-later
/// \file report.hpp  Writes the results as CSV, from which scripts/documents takes the numbers in docs/verification.md.
#pragma once

#include <filesystem>

#include "bench/stability/stability.hpp"

namespace macadam::stability {

/// Results of a case.
struct Outcome {
  Case of;
  Rows rows;
  double seconds = 0;
  std::string error;  ///< message of the exception that stopped the case, which counts as a failure; empty if there was
                      ///< none

  int failed() const;  ///< number of rows that do not pass, plus one for an error
};

/// When and on what machine the cases ran, for the head of the file.
struct Circumstances {
  std::string date, commit, processor, effort;
  std::string cuda;  ///< device on which cuda ran, or why it was skipped
};

void write_csv(const std::filesystem::path& file, const std::vector<Outcome>& outcomes, const Circumstances& where);

/// Returns the text of a row for a terminal, one line.
std::string to_line(const Row& row);

}  // namespace macadam::stability
