// SPDX-License-Identifier: GPL-3.0-or-later
/// \file statistics.hpp  What a library of shapes is like as a whole: Tables 1 and 2 of [1].
#pragma once

#include <array>
#include <string>
#include <vector>

#include "macadam/shape.hpp"

namespace macadam {

/// One geometrical property: a column of every table.
struct ShapeProperty {
  const char* name;    ///< the symbol of [1]
  const char* column;  ///< heading in CSV files, with the SI unit
  const char* unit;    ///< in the printed table, e.g. `"mm"`
  double per_unit;     ///< SI value × this = number in that unit
  int decimals;        ///< in the printed table
  bool standardised;   ///< SI and Fl: defined by their standards for D^I ≥ 4 mm only; tables leave smaller shapes out
  bool correlated;     ///< has a row in the correlation matrix
  double (*value)(const ShapeMeasure&);  ///< [SI]
  std::array<double, 3> paper;           ///< min, average, max of the 82 aggregates of [1], in `unit`
};

/// In the order of [1], Table 1: points, facets, D^L, D^I, D^S, V, A, SI, F, Fl, E, ψ^w, ψ^A.
const std::vector<ShapeProperty>& shape_properties();

/// The property where the tables count it, NaN elsewhere.
double tabulated(const ShapeProperty& property, const ShapeMeasure& shape);

struct Spread {
  double min = 0, average = 0, max = 0;  ///< NaN where no shape counts
  std::int64_t shapes = 0;               ///< that count
};
Spread spread_of(const ShapeProperty& property, const std::vector<ShapeMeasure>& shapes);

/// Pearson's coefficient over the pairs of which both are numbers; NaN below two pairs or where one does not vary.
double pearson(const std::vector<double>& x, const std::vector<double>& y);

/// Rows and columns are the properties that are `correlated`.
std::vector<std::vector<double>> correlation_matrix(const std::vector<ShapeMeasure>& shapes);

/// `name,` and one column a property, then the two sieves of the class [m] (empty where there is none above); SI units.
std::string shapes_csv(const std::vector<std::string>& names, const std::vector<ShapeMeasure>& shapes);

/// The table of minimum, average and maximum, those of [1] beside ours; SI units.
std::string statistics_csv(const std::vector<ShapeMeasure>& shapes);

/// The correlation matrix with headings.
std::string correlation_csv(const std::vector<ShapeMeasure>& shapes);

/// All three for a terminal: Table 1, shapes by sieve class, Table 2.
std::string statistics_text(const std::vector<ShapeMeasure>& shapes);

}  // namespace macadam
