// SPDX-License-Identifier: GPL-3.0-or-later
/// \file statistics.hpp  Computes the statistics of a library of shapes, as in Tables 1 and 2 of [1].
#pragma once

#include <array>
#include <string>
#include <vector>

#include "macadam/shape.hpp"

namespace macadam {

/// A geometrical property, which is a column of every table.
struct ShapeProperty {
  const char* name;    ///< symbol that [1] uses
  const char* column;  ///< heading in CSV files, with the SI unit
  const char* unit;    ///< unit in the printed table, e.g. `"mm"`
  double per_unit;     ///< number of `unit` per SI unit, e.g. 1e3 for mm
  int decimals;        ///< number of decimals in the printed table
  bool standardised;   ///< true for SI and Fl: their standards define them for D^I ≥ 4 mm only, so tables leave out
                       ///< smaller shapes
  bool correlated;     ///< whether the property has a row in the correlation matrix
  double (*value)(const ShapeMeasure&);  ///< returns the property in SI units
  std::array<double, 3> paper;  ///< minimum, average and maximum of the 82 aggregates in reference [1], in `unit`
};

/// Returns all properties in the order of [1], Table 1: points, facets, D^L, D^I, D^S, V, A, SI, F, Fl, E, ψ^w, ψ^A.
const std::vector<ShapeProperty>& shape_properties();

/// Returns the value of a property, or NaN if the tables leave this shape out.
double tabulated(const ShapeProperty& property, const ShapeMeasure& shape);

/// Minimum, average and maximum of one property over a library.
struct Spread {
  double min = 0, average = 0, max = 0;  ///< NaN if no shape has a value
  std::int64_t shapes = 0;               ///< number of shapes that have a value
};
/// Computes the statistics of one property, with the values of tabulated().
Spread spread_of(const ShapeProperty& property, const std::vector<ShapeMeasure>& shapes);

/// Returns Pearson's correlation coefficient over the pairs of values of which neither is NaN. Returns NaN if there are
/// fewer than two such pairs or if one of the variables is constant.
double pearson(const std::vector<double>& x, const std::vector<double>& y);

/// Returns the matrix of correlation coefficients of the properties that are `correlated`.
std::vector<std::vector<double>> correlation_matrix(const std::vector<ShapeMeasure>& shapes);

/// Returns CSV text: `name`, one column per property, and the two sieves of the class [m] (the upper one is empty above
/// the largest sieve). All values are in SI units.
std::string shapes_csv(const std::vector<std::string>& names, const std::vector<ShapeMeasure>& shapes);

/// Returns CSV text, one row per property: number of shapes; minimum, average and maximum; then the values published in
/// [1], in columns paper_min, paper_average and paper_max. All values are in SI units.
std::string statistics_csv(const std::vector<ShapeMeasure>& shapes);

/// Returns the correlation matrix as CSV text with headings.
std::string correlation_csv(const std::vector<ShapeMeasure>& shapes);

/// Returns all three tables for a terminal: Table 1, number of shapes per sieve class, Table 2.
std::string statistics_text(const std::vector<ShapeMeasure>& shapes);

}  // namespace macadam
