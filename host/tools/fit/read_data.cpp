// SPDX-License-Identifier: GPL-3.0-or-later
// read_data.cpp  Reads measured moduli from the columns of a laboratory's table.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "host/tools/fit/laboratory_columns.hpp"
#include "host/tools/fit/laboratory_table.hpp"
#include "host/tools/fit/unit_question.hpp"
#include "host/base/in_quotes.hpp"
#include "host/base/nearest.hpp"
#include "macadam/error.hpp"
#include "macadam/fit.hpp"

namespace macadam {
namespace fitting {
namespace {

constexpr std::size_t most_points = 10'000;  // because the least-squares matrices are dense
/// A column name that differs from a known name by at most this number of letters is reported as a misspelling.
constexpr std::size_t misspelt = 2;

/// Reads the measurements from one table.
class DataReader {
 public:
  DataReader(const std::filesystem::path& file, std::optional<double> poisson, Measured needed)
      : poisson_(poisson),
        needs_modulus_(needed != Measured::phase),
        needs_phase_(needed != Measured::modulus),
        complaints_(file.string()),
        table_(read_laboratory_table(file, complaints_)) {
    data_.source = file.string();
  }

  ModulusData read() {
    for (std::size_t i = 0; i < table_.names.size(); ++i) understand(i);
    choose();
    const bool is_header_sound = complaints_.empty();
    if (is_header_sound && table_.rows.empty()) complaints_.add(0, "measurements", "only a header", "lines of numbers");
    if (table_.rows.size() > most_points) {
      complaints_.add(0, "measurements", fmt::format("{}", table_.rows.size()), fmt::format("at most {}", most_points));
      complaints_.throw_if_any();
    }
    ModulusData sound = data_;  // the measurements in which no fault was found
    for (const LaboratoryTable::Row& row : table_.rows) {
      const std::size_t before = complaints_.count();
      add_point(row);
      if (complaints_.count() == before) sound.points.push_back(data_.points.back());
    }
    if (is_header_sound) ask_about_units(sound, columns_read(), complaints_);
    complaints_.throw_if_any();
    return std::move(data_);
  }

 private:
  struct Used {
    LaboratoryColumn column;
    std::size_t at;  ///< column number in the table
  };

  bool has(Quantity quantity) const { return used_.contains(quantity); }
  void complain_of_header(const std::string& found, const std::string& expected) {
    complaints_.add(table_.header_line, "header", found, expected);
  }

  /// Returns whether a column has no values.
  bool is_blank(std::size_t at) const {
    return !table_.rows.empty() && std::all_of(table_.rows.begin(), table_.rows.end(),
                                               [&](const LaboratoryTable::Row& row) { return row.cells[at].empty(); });
  }

  /// Assigns one column of the header to a quantity by its name, reports it as misspelt, or passes it over.
  void understand(std::size_t at) {
    const std::string& name = table_.names[at];
    const std::string unit = table_.units ? unit_suffix(table_.units->cells[at]) : "";
    const LaboratoryColumn* column = find_column(name);
    if (!column && !unit.empty()) column = find_column(name + "_" + unit);  // for example "phase" above "deg"
    if (!column) return pass_over(name);
    if (is_blank(at)) return;
    if (!unit.empty() && unit != "-" && !column->name.ends_with("_" + unit) && !column->unit.empty()) {
      complaints_.add(table_.units->line, "unit of " + column->name, in_quotes(table_.units->cells[at]),
                      column->unit + ", as the name of the column says");
    }
    if (!used_.emplace(column->quantity, Used{*column, at}).second)
      complain_of_header(in_quotes(name) + (used_.at(column->quantity).column.name == column->name
                                                ? " twice"
                                                : " beside " + used_.at(column->quantity).column.name),
                         "each column once");
  }

  /// Handles an unknown column name: a fault if it resembles a known one or lacks its unit, otherwise an unused column.
  void pass_over(const std::string& name) {
    if (name.empty()) return;
    std::vector<std::string> known;
    bool without_unit = false;
    for (const LaboratoryColumn& column : laboratory_columns()) {
      known.push_back(column.name);
      without_unit = without_unit || column.name.starts_with(name + "_");
    }
    const std::string meant = nearest(name, known);
    if (without_unit || letters_between(name, meant) <= misspelt) {
      misspelt_ = true;
      complain_of_header(in_quotes(name), fmt::format("{} (the nearest of {})", meant, fmt::join(known, ", ")));
    } else {
      data_.unused.push_back(name);
    }
  }

  /// Decides which columns are used, and reports if they do not suffice.
  void choose() {
    using enum Quantity;
    if (table_.names.empty()) return;
    const bool shear = has(g_star) || has(g_prime) || has(g_double_prime);
    if (shear && (has(e_star) || has(e_prime) || has(e_double_prime))) {
      complain_of_header("columns of E* and of G*", "only one of the two");
      return;
    }
    star_ = shear ? g_star : e_star, real_ = shear ? g_prime : e_prime,
    imaginary_ = shear ? g_double_prime : e_double_prime;
    deviation_ = shear ? g_star_std : e_star_std;
    parts_ = has(real_) && has(imaginary_) && ((needs_modulus_ && !has(star_)) || (needs_phase_ && !has(phase)));
    data_.moduli = parts_ || has(star_), data_.phases = parts_ || has(phase), data_.temperatures = has(temperature);
    if (misspelt_) return;  // a column that seems to be missing may be present under a misspelt name
    if (!has(frequency)) complain_of_missing("a column frequency_hz");
    if ((needs_modulus_ && !data_.moduli) || (needs_phase_ && !data_.phases)) {
      complain_of_missing(!needs_phase_ ? "a column e_star_pa or g_star_pa"
                          : !needs_modulus_
                              ? "a column phase_deg"
                              : "e_star_pa or g_star_pa with phase_deg, or e_prime_pa with e_double_prime_pa");
    }
    choose_deviations();
    if (shear && !poisson_)
      complaints_.add(table_.header_line, "column g_star_pa", "no Poisson's ratio",
                      "a ratio in --poisson, because |E*| = 2 (1 + ratio) |G*|");
    if (!shear && poisson_) {
      complaints_.add(table_.header_line, "column e_star_pa", "a Poisson's ratio",
                      "no Poisson's ratio, because the file already has |E*|");
    } else if (poisson_ && !(*poisson_ > -1 && *poisson_ <= 0.5)) {
      complaints_.add(table_.header_line, "Poisson's ratio", fmt::format("{}", *poisson_),
                      "a number above -1, at most 0.5");
    }
  }

  void complain_of_missing(const std::string& expected) {
    complain_of_header(in_quotes(fmt::format("{}", fmt::join(table_.names, std::string(1, table_.separator)))),
                       expected);
  }

  /// Decides whether the columns of standard deviations are used, and assigns units to them.
  void choose_deviations() {
    using enum Quantity;
    if (has(deviation_ == e_star_std ? g_star_std : e_star_std))
      complain_of_header(deviation_ == e_star_std ? "g_star_std" : "e_star_std",
                         deviation_ == e_star_std ? "e_star_std, because the moduli are |E*|"
                                                  : "g_star_std, because the moduli are |G*|");
    const bool modulus = has(deviation_), angle = has(phase_std);
    data_.deviations = (modulus || !needs_modulus_) && (angle || !needs_phase_);
    if (!data_.deviations && (modulus || angle))
      complain_of_header(modulus ? "the standard deviation of the modulus alone" : "phase_std alone",
                         "standard deviations of both modulus and phase, or of none");
    // a standard deviation has the unit of the column whose values it belongs to
    const auto take_unit = [&](Quantity of, Quantity from) {
      if (!has(of) || !has(from)) return;
      LaboratoryColumn& column = used_.at(of).column;
      const LaboratoryColumn& source = used_.at(from).column;
      column.unit = source.unit, column.factor = source.factor;
      if (!table_.units) return;
      const std::string& cell = table_.units->cells[used_.at(of).at];
      const std::string unit = unit_suffix(cell);
      if (unit.empty() || unit == "-" || source.name.ends_with("_" + unit)) return;
      complaints_.add(table_.units->line, "unit of " + column.name, in_quotes(cell),
                      source.unit + ", the unit of " + source.name);
    };
    take_unit(deviation_, parts_ ? real_ : star_);
    take_unit(phase_std, phase);
    if (has(phase_std) && used_.at(phase_std).column.unit.empty()) used_.at(phase_std).column.unit = "degrees";
  }

  /// Returns the factor by which a modulus of the table becomes |E*|.
  double modulus_factor() const { return star_ == Quantity::g_star && poisson_ ? 2 * (1 + *poisson_) : 1; }

  /// Returns the names of the columns that give modulus, phase and temperature.
  ColumnsRead columns_read() const {
    const auto name_of = [&](Quantity quantity) { return has(quantity) ? used_.at(quantity).column.name : ""; };
    return {name_of(parts_ ? real_ : star_), parts_ ? "" : name_of(Quantity::phase), name_of(Quantity::temperature),
            modulus_factor()};
  }

  /// Returns the value of a quantity in a row [SI]; 0 if there is no such column. Adds an impossible value to the
  /// complaints, the list of faults that one error reports together.
  double value(const LaboratoryTable::Row& row, Quantity quantity) {
    const auto found = used_.find(quantity);
    if (found == used_.end()) return 0;
    const auto& [column, at] = found->second;
    const std::optional<double> number = number_in(table_, row.cells[at]);
    const double si = number ? column.factor * *number + column.offset : std::nan("");
    if (const std::string expected = expected_of(column, si); !expected.empty())
      complaints_.add(row.line, "column " + column.name, in_quotes(row.cells[at]), expected);
    return si;
  }

  void add_point(const LaboratoryTable::Row& row) {
    using enum Quantity;
    const double factor = modulus_factor();
    ModulusPoint p;
    p.frequency_hz = value(row, frequency);
    if (parts_) {
      const double real = value(row, real_), imaginary = value(row, imaginary_);
      p.e_star_pa = factor * std::hypot(real, imaginary);
      p.phase_deg = std::atan2(imaginary, real) * 180 / std::numbers::pi;
      if (const std::string expected = expected_of(*find_column("phase_deg"), p.phase_deg);
          std::isfinite(p.phase_deg) && !expected.empty()) {
        complaints_.add(row.line,
                        fmt::format("columns {} and {}", used_.at(real_).column.name, used_.at(imaginary_).column.name),
                        fmt::format("a phase of {:.3g} degrees", p.phase_deg), expected);
      }
    } else {
      p.e_star_pa = factor * value(row, star_);
      p.phase_deg = value(row, phase);
    }
    p.temperature_c = value(row, temperature);
    p.e_star_std = factor * value(row, deviation_);
    p.phase_std = value(row, phase_std);
    p.line = row.line;
    data_.points.push_back(p);
  }

  std::optional<double> poisson_;
  bool needs_modulus_, needs_phase_;
  Complaints complaints_;
  LaboratoryTable table_;
  ModulusData data_;
  std::map<Quantity, Used> used_;
  Quantity star_ = Quantity::e_star, real_ = Quantity::e_prime, imaginary_ = Quantity::e_double_prime,
           deviation_ = Quantity::e_star_std;
  bool parts_ = false, misspelt_ = false;
};

}  // namespace
}  // namespace fitting

ModulusData read_modulus_data(const std::filesystem::path& file, std::optional<double> poisson, Measured needed) {
  return fitting::DataReader(file, poisson, needed).read();
}

}  // namespace macadam
