// SPDX-License-Identifier: GPL-3.0-or-later
/// \file json.hpp  Rows as Google Benchmark writes them, so that its compare.py reads them.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "host/bench/measure.hpp"

namespace macadam::bench {

/// Machine, versions, date: what a reader of the times must know.
nlohmann::ordered_json context_of(const MachineSpeed& machine, Backend backend);

/// Every repetition, and mean, median, standard deviation and coefficient of variation where there are several.
nlohmann::ordered_json json_of(const nlohmann::ordered_json& context, const std::vector<BenchRow>& rows);

/// Names and repetitions of a file of this kind, of Macadam's or of any program's. \throws InputError
std::vector<BenchRow> read_rows(const std::filesystem::path& file);

/// A row of both files, compared.
struct Comparison {
  std::string name;
  double before, now;   ///< medians [s]
  bool slower, faster;  ///< beyond noise
};

/// Rows of the same names. Slower beyond noise: by more than 2 % in the median, and every repetition slower than every
/// one before, which seven and seven of the same thing are once in 3,432 times.
std::vector<Comparison> compare(const std::vector<BenchRow>& before, const std::vector<BenchRow>& now);

}  // namespace macadam::bench
