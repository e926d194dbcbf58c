// SPDX-License-Identifier: GPL-3.0-or-later
/// \file json.hpp  Writes and reads rows in Google Benchmark's JSON format, so that its compare.py can read them.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "host/tools/bench/measure.hpp"

namespace macadam::bench {

/// Returns the context that a reader needs to judge the times: machine, versions, date.
nlohmann::ordered_json context_of(const MachineSpeed& machine, Backend backend);

/// Returns an entry for every repetition. Rows with several repetitions also get entries for mean, median, standard
/// deviation and coefficient of variation.
nlohmann::ordered_json json_of(const nlohmann::ordered_json& context, const std::vector<BenchRow>& rows);

/// Reads names and repetitions from a file in this format, written by Macadam or by any other program. \throws
/// InputError
std::vector<BenchRow> read_rows(const std::filesystem::path& file);

/// Comparison of a row that both files contain.
struct Comparison {
  std::string name;
  double before, now;   ///< medians [s]
  bool slower, faster;  ///< whether the difference is larger than noise
};

/// Compares the rows with equal names. A row counts as slower if its median is more than 2 % larger and every
/// repetition is slower than every repetition before. If both files have seven repetitions of the same program, the
/// second condition is met by chance once in 3,432 comparisons, the number of ways to choose 7 of 14.
std::vector<Comparison> compare(const std::vector<BenchRow>& before, const std::vector<BenchRow>& now);

}  // namespace macadam::bench
