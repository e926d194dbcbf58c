// SPDX-License-Identifier: GPL-3.0-or-later
// statistics.cpp  Makes every table from one list of properties.
#include "host/shapes/library/statistics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "host/files/result_files.hpp"
#include "host/files/result_folder.hpp"

namespace macadam {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double standard_size = 4e-3;  // [m]; EN 933-3 and EN 933-4 apply to larger particles

std::vector<ShapeProperty> correlated_properties() {
  std::vector<ShapeProperty> out;
  std::copy_if(shape_properties().begin(), shape_properties().end(), std::back_inserter(out),
               [](const ShapeProperty& p) { return p.correlated; });
  return out;
}

std::string to_decimals(double x, int decimals) { return std::isfinite(x) ? fmt::format("{:.{}f}", x, decimals) : "-"; }

/// Formats a number for CSV files; NaN gives an empty field.
std::string number(double x) { return std::isfinite(x) ? fmt::format("{}", x) : ""; }

}  // namespace

const std::vector<ShapeProperty>& shape_properties() {
  using M = const ShapeMeasure&;
  static const std::vector<ShapeProperty> properties{
      {"points", "points", "", 1, 0, false, false, [](M m) { return double(m.points); }, {25, 167, 411}},
      {"facets", "facets", "", 1, 0, false, false, [](M m) { return double(m.facets); }, {46, 330, 818}},
      {"D^L", "d_long_m", "mm", 1e3, 2, false, true, [](M m) { return m.d_long; }, {1.02, 5.95, 18.66}},
      {"D^I", "d_intermediate_m", "mm", 1e3, 2, false, true, [](M m) { return m.d_intermediate; }, {0.48, 3.94, 12.59}},
      {"D^S", "d_short_m", "mm", 1e3, 2, false, true, [](M m) { return m.d_short; }, {0.32, 2.56, 8.83}},
      {"V", "volume_m3", "mm³", 1e9, 2, false, true, [](M m) { return m.volume; }, {0.07, 84.23, 851.22}},
      {"A", "area_m2", "mm²", 1e6, 2, false, true, [](M m) { return m.area; }, {1.05, 80.60, 511.19}},
      {"SI", "shape_index", "", 1, 2, true, true, [](M m) { return m.shape_index(); }, {1.50, 2.55, 4.68}},
      {"F", "flatness", "", 1, 2, false, true, [](M m) { return m.flatness(); }, {0.37, 0.64, 0.91}},
      {"Fl", "flakiness", "", 1, 2, true, true, [](M m) { return m.flakiness(); }, {0.31, 0.57, 0.85}},
      {"E", "elongation", "", 1, 2, false, true, [](M m) { return m.elongation(); }, {0.39, 0.70, 0.97}},
      {"psi^w", "sphericity_true", "", 1, 2, false, true, [](M m) { return m.sphericity_true; }, {0.73, 0.86, 0.96}},
      {"psi^A",
       "sphericity_working",
       "",
       1,
       2,
       false,
       true,
       [](M m) { return m.sphericity_working(); },
       {0.68, 0.85, 0.94}}};
  return properties;
}

double tabulated(const ShapeProperty& property, const ShapeMeasure& shape) {
  return property.standardised && shape.d_intermediate < standard_size ? nan : property.value(shape);
}

Spread spread_of(const ShapeProperty& property, const std::vector<ShapeMeasure>& shapes) {
  Spread spread{nan, nan, nan, 0};
  double sum = 0;
  for (const ShapeMeasure& shape : shapes) {
    const double x = tabulated(property, shape);
    if (!std::isfinite(x)) continue;
    spread.min = std::fmin(spread.min, x);  // fmin and fmax ignore a NaN argument
    spread.max = std::fmax(spread.max, x);
    sum += x;
    ++spread.shapes;
  }
  if (spread.shapes > 0) spread.average = sum / static_cast<double>(spread.shapes);
  return spread;
}

double pearson(const std::vector<double>& x, const std::vector<double>& y) {
  double n = 0, mean_x = 0, mean_y = 0, xx = 0, yy = 0, xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!std::isfinite(x[i]) || !std::isfinite(y[i])) continue;
    n += 1;
    // Moments about the running means do not lose digits when the spread is small compared with the mean.
    const double dx = x[i] - mean_x, dy = y[i] - mean_y, weight = (n - 1) / n;
    mean_x += dx / n;
    mean_y += dy / n;
    xx += weight * (dx * dx);
    yy += weight * (dy * dy);
    xy += weight * (dx * dy);
  }
  return xx > 0 && yy > 0 ? std::clamp(xy / (std::sqrt(xx) * std::sqrt(yy)), -1.0, 1.0) : nan;
}

std::vector<std::vector<double>> correlation_matrix(const std::vector<ShapeMeasure>& shapes) {
  std::vector<std::vector<double>> columns;
  for (const ShapeProperty& property : correlated_properties()) {
    auto& column = columns.emplace_back();
    for (const ShapeMeasure& shape : shapes) column.push_back(tabulated(property, shape));
  }
  std::vector<std::vector<double>> matrix;
  for (const auto& x : columns) {
    auto& row = matrix.emplace_back();
    for (const auto& y : columns) row.push_back(pearson(x, y));
  }
  return matrix;
}

std::string shapes_csv(const std::vector<std::string>& names, const std::vector<ShapeMeasure>& shapes) {
  std::string text = "name";
  for (const ShapeProperty& property : shape_properties()) text += fmt::format(",{}", property.column);
  text += ",sieve_min_m,sieve_max_m\n";
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    text += csv_field(names[i]);
    for (const ShapeProperty& property : shape_properties()) text += "," + number(property.value(shapes[i]));
    const auto [lower, upper] = sieve_class(shapes[i].d_intermediate);
    text += fmt::format(",{},{}\n", number(lower), number(upper));
  }
  return text;
}

std::string statistics_csv(const std::vector<ShapeMeasure>& shapes) {
  std::string text = "property,shapes,min,average,max,paper_min,paper_average,paper_max\n";
  for (const ShapeProperty& property : shape_properties()) {
    const Spread s = spread_of(property, shapes);
    text += fmt::format("{},{},{},{},{}", property.column, s.shapes, number(s.min), number(s.average), number(s.max));
    for (const double x : property.paper) text += "," + number(x / property.per_unit);
    text += "\n";
  }
  return text;
}

std::string correlation_csv(const std::vector<ShapeMeasure>& shapes) {
  const auto properties = correlated_properties();
  const auto matrix = correlation_matrix(shapes);
  std::string text = "property";
  for (const ShapeProperty& property : properties) text += fmt::format(",{}", property.column);
  for (std::size_t i = 0; i < matrix.size(); ++i) {
    text += fmt::format("\n{}", properties[i].column);
    for (const double r : matrix[i]) text += "," + number(r);
  }
  return text + "\n";
}

std::string statistics_text(const std::vector<ShapeMeasure>& shapes) {
  std::string text = fmt::format("{:<12} {:>6} {:>9} {:>9} {:>9}   published: {:>7} {:>8} {:>8}\n", "", "shapes", "min",
                                 "average", "max", "min", "average", "max");
  for (const ShapeProperty& p : shape_properties()) {
    const Spread s = spread_of(p, shapes);
    text += fmt::format("{:<8} {:<3} {:>6}", p.name, p.unit, s.shapes);
    for (const double x : {s.min, s.average, s.max})
      text += fmt::format(" {:>9}", to_decimals(x * p.per_unit, p.decimals));
    text += "         ";
    for (const double x : p.paper) text += fmt::format(" {:>8.{}f}", x, p.decimals);
    text += "\n";
  }
  text += "SI and Fl are computed from shapes with D^I of 4 mm or more\n\nshapes by sieve (mm):";
  for (std::size_t k = 0; k < standard_sieves().size(); ++k) {
    const double lower = standard_sieves()[k];
    const auto n = std::count_if(shapes.begin(), shapes.end(),
                                 [&](const ShapeMeasure& m) { return sieve_class(m.d_intermediate)[0] == lower; });
    const bool last = k + 1 == standard_sieves().size();
    if (n > 0)
      text += fmt::format(" {}/{} {}", 1e3 * lower, last ? "" : fmt::format("{}", 1e3 * standard_sieves()[k + 1]), n);
  }
  text += "\n\nPearson correlation\n     ";
  const auto properties = correlated_properties();
  const auto matrix = correlation_matrix(shapes);
  for (const ShapeProperty& p : properties) text += fmt::format(" {:>5}", p.name);
  for (std::size_t i = 0; i < matrix.size(); ++i) {
    text += fmt::format("\n{:<5}", properties[i].name);
    for (std::size_t j = 0; j <= i; ++j) text += fmt::format(" {:>5}", to_decimals(matrix[i][j], 2));
  }
  return text + "\n";
}

void write_shape_tables(const std::filesystem::path& out, const std::vector<std::string>& names,
                        const std::vector<ShapeMeasure>& shapes) {
  const ResultFolder folder(out);
  write_whole(out / "shapes.csv", shapes_csv(names, shapes));
  write_whole(out / "statistics.csv", statistics_csv(shapes));
  write_whole(out / "correlation.csv", correlation_csv(shapes));
}

}  // namespace macadam
