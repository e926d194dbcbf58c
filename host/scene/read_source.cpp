// SPDX-License-Identifier: GPL-3.0-or-later
// read_source.cpp  Reads the file that `from` in [materials.mastic] names.
#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

#include "host/scene/sections.hpp"
#include "macadam/error.hpp"

namespace macadam::scene {
namespace {

/// Returns the path without symbolic links and dots, so that two names of one file are equal.
std::filesystem::path one_name(const std::filesystem::path& file) {
  std::error_code error;
  std::filesystem::path out = std::filesystem::weakly_canonical(std::filesystem::absolute(file), error);
  return error ? file.lexically_normal() : out;
}

/// Refuses a scene that leads back to itself. The message names all files of the circle.
void require_no_circle(const Value& value, const ReadingFile& reading, const std::filesystem::path& file) {
  std::string way = file.string();
  for (const ReadingFile* outer = &reading; outer; outer = outer->outer) {
    way = outer->file.string() + " -> " + way;
    if (one_name(outer->file) == one_name(file))
      value.refuse(way, "scenes whose mastic does not lead back to the scene itself");
  }
}

/// Calls f, which reads the file that `from` names. If the file is refused, the message names both files.
template <class F>
auto read_inside(const Value& value, F&& f) {
  std::string fault;
  try {
    return f();
  } catch (const InputError& refused) { fault = refused.what(); }
  value.refuse("a file that is refused: " + fault, "a scene or law that is valid by itself");
}

/// Takes the law of the mastic in another scene, at its reference temperature, as the provisional law until the
/// specimen of that scene is solved.
std::optional<double> take_scene(const Value& value, const ReadingFile& reading, PhaseLaws& phases) {
  auto inner = read_inside(value, [&] { return std::make_shared<Scene>(read_inner_scene(reading)); });
  constexpr auto mm = static_cast<std::size_t>(PairType::mm);
  const LawTable laws = reference_laws(*inner);
  if (!laws[mm])
    value.refuse(fmt::format("{} without a law of mastic", reading.file.string()), "a scene whose specimen has mastic");
  const laws::Shift* shift = nullptr;
  Law law = laws::Elastic{1e9, 1};
  for (std::size_t pair = 0; pair < pair_types; ++pair) {
    if (!laws[pair] || !laws::flows(*laws[pair])) continue;
    if (shift && *shift != inner->shifts[pair])
      value.refuse(fmt::format("{}, whose laws have different shifts", reading.file.string()),
                   "a scene whose viscoelastic laws have the same shift, which is then the shift of its specimen");
    if (!shift) law = *laws[pair];
    shift = &inner->shifts[pair];
  }
  if (!shift) law = *laws[mm];
  std::visit([](auto& one) { one.alpha = 1; }, law);
  phases.mastic = std::move(law);
  if (shift) phases.shift = *shift;
  const std::optional<double> poisson = inner->materials.mastic_poisson_ratio;
  phases.source = MasticSource{reading.file, std::move(inner)};
  return poisson;
}

/// Takes the law of `law.toml`: the law of its only pair, or of its [materials.mastic].
std::optional<double> take_law(const Value& value, const ReadingFile& reading, const toml::table& table,
                               PhaseLaws& phases) {
  const Section root(reading.file.string(), 0, "", "", table);
  LawTable laws;
  ShiftLaws shifts;
  LawRanges ranges;
  Deltas deltas = all_one;
  NetworkSpec network;
  TemperatureTables tables;
  Materials materials;
  const auto read_mastic = [&](const Value& mastic) {
    materials = read_mastic_alone(mastic.section(), reading, phases);
  };
  const auto read_pairs = [&](const Value& v) {
    laws = read_contacts(v.sections(), shifts, ranges, deltas, network, tables);
  };
  const auto read_materials = [&](const Value& v) {
    v.section().read({{"mastic", Need::required, section_by(read_mastic)}});
  };
  read_inside(value, [&] {
    root.read({{"contacts", Need::optional, sections_by(read_pairs)},
               {"materials", Need::optional, section_by(read_materials)}});
  });
  std::size_t found = phases.mastic.has_value();
  for (std::size_t pair = 0; pair < pair_types; ++pair) {
    if (!laws[pair]) continue;
    ++found;
    phases.mastic = laws[pair], phases.shift = shifts[pair], phases.range = ranges[pair];
  }
  if (found != 1)
    value.refuse(fmt::format("{} with {} laws", reading.file.string(), found),
                 "a scene, or a file with one law, such as law.toml of macadam fit");
  const bool linear = std::visit([]<class L>(const L&) { return series_law<L>; }, *phases.mastic);
  if (!linear)
    value.refuse(fmt::format("{} with a law that can break", reading.file.string()),
                 "a linear law, because it acts in series with rock");
  std::visit([](auto& one) { one.alpha = 1; }, *phases.mastic);
  return materials.mastic_poisson_ratio;
}

/// Takes the chain of `kelvin.csv`, and the range of times in its comment.
void take_chain(const Value& value, const std::filesystem::path& file, PhaseLaws& phases) {
  std::ifstream in(file);
  laws::GeneralisedKelvin law;
  law.C_m = std::numeric_limits<double>::infinity();
  bool maxwell = false, head = false;
  int number = 0;
  const auto refuse = [&](const std::string& found, const std::string& expected) {
    value.refuse(fmt::format("{}:{}: {}", file.string(), number, found), expected);
  };
  for (std::string line; std::getline(in, line);) {
    ++number;
    double from = 0, to = 0;
    if (std::sscanf(line.c_str(), "# Valid from %lf to %lf s", &from, &to) == 2 && from > 0 && to >= from)
      phases.range = {1 / (2 * std::numbers::pi * to), 1 / (2 * std::numbers::pi * from)};
    if (line.empty() || line.front() == '#') continue;
    std::vector<std::string> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
    if (!head) {
      if (line != "unit,time_s,compliance_1_pa,E_pa,C_pa_s")
        refuse(line, "the header unit,time_s,compliance_1_pa,E_pa,C_pa_s of kelvin.csv");
      head = true;
      continue;
    }
    const auto positive_number = [&](std::size_t at) {
      char* end = nullptr;
      const double v = at < cells.size() ? std::strtod(cells[at].c_str(), &end) : 0;
      if (!(v > 0) || *end != '\0')
        refuse(line, "a row of kelvin.csv: a name, a time, a compliance, and positive E and C");
      return v;
    };
    const double spring = positive_number(3), dashpot = positive_number(4);
    if (cells.front() == "maxwell") {
      maxwell = true, law.E_m = spring, law.C_m = dashpot;
    } else {
      law.E.push_back(spring), law.C.push_back(dashpot);
    }
  }
  if (!maxwell) refuse("no row maxwell", "the chain of a specimen, as tests of kind relaxation and creep write it");
  constexpr int most = laws::GeneralisedKelvin::max_units;
  if (law.units() > most)
    refuse(fmt::format("{} Kelvin units", law.units()),
           fmt::format("at most {}; if from names the scene of that specimen instead, the chain has at most {} units",
                       most, most));
  law.alpha = 1;
  phases.mastic = std::move(law);
}

}  // namespace

std::optional<double> read_source(const Value& value, const ReadingFile& reading, PhaseLaws& phases) {
  const std::filesystem::path file = (reading.file.parent_path() / value.text()).lexically_normal();
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
    value.refuse("no file " + file.string(),
                 "another scene, law.toml or kelvin.csv; paths are relative to the scene's folder");
  if (file.extension() == ".csv") {
    take_chain(value, file, phases);
    return {};
  }
  require_no_circle(value, reading, file);
  const ReadingFile inner{file, &reading};
  std::string text;
  const toml::table table = read_inside(value, [&] { return read_toml(file, "scene", text); });
  return table.contains("specimen") ? take_scene(value, inner, phases) : take_law(value, inner, table, phases);
}

}  // namespace macadam::scene
