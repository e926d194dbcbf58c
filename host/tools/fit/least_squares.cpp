// SPDX-License-Identifier: GPL-3.0-or-later
// least_squares.cpp  Uses Ceres Solver: Levenberg–Marquardt within bounds, with derivatives by automatic
// differentiation.
#include "host/tools/fit/least_squares.hpp"

#include <ceres/dynamic_autodiff_cost_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace macadam::fitting {
namespace {

bool finite(double value) { return std::isfinite(value); }
template <int N>
bool finite(const ceres::Jet<double, N>& value) {
  return std::isfinite(value.a) && value.v.allFinite();
}

/// (value − target)/deviation of ln |E*| and of φ, in this order for each target.
struct Residuals {
  const Unknowns& unknowns;
  const std::vector<Target>& targets;

  template <class T>
  bool operator()(T const* const* parameters, T* residuals) const {
    for (const Target& t : targets) {
      const Polar<T> value = modulus_at(unknowns, parameters[0], t.place);
      // Ceres then tries a shorter step, without a message
      if (!finite(value.log_modulus) || !finite(value.phase)) return false;
      *residuals++ = (value.log_modulus - t.log_modulus) / t.modulus_deviation;
      *residuals++ = (value.phase - t.phase) / t.phase_deviation;
    }
    return true;
  }
};

std::unique_ptr<ceres::CostFunction> cost_of(const Unknowns& unknowns, const std::vector<Target>& targets) {
  auto cost = std::make_unique<ceres::DynamicAutoDiffCostFunction<Residuals, 8>>(new Residuals{unknowns, targets});
  cost->AddParameterBlock(static_cast<int>(unknowns.count()));
  cost->SetNumResiduals(2 * static_cast<int>(targets.size()));
  return cost;
}

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Computes residuals and, if `jacobian` is given, their derivatives by θ. Residuals are infinite if they cannot be
/// evaluated.
void evaluate(const Unknowns& unknowns, const std::vector<Target>& targets, const std::vector<double>& theta,
              std::vector<double>& residuals, RowMajor* jacobian) {
  residuals.resize(2 * targets.size());
  const double* parameters[] = {theta.data()};
  double* blocks[] = {nullptr};
  if (jacobian) {
    jacobian->resize(std::ssize(residuals), std::ssize(theta));
    blocks[0] = jacobian->data();
  }
  if (!cost_of(unknowns, targets)->Evaluate(parameters, residuals.data(), jacobian ? blocks : nullptr))
    residuals.assign(residuals.size(), std::numeric_limits<double>::infinity());
}

}  // namespace

Minimum refine(const Unknowns& unknowns, const std::vector<Target>& targets, const std::vector<Limits>& limits,
               std::vector<double> theta, double tolerance) {
  ceres::Problem problem;
  for (std::size_t i = 0; i < theta.size(); ++i) theta[i] = std::clamp(theta[i], limits[i].low, limits[i].high);
  problem.AddResidualBlock(cost_of(unknowns, targets).release(), nullptr, theta.data());
  for (std::size_t i = 0; i < theta.size(); ++i) {
    problem.SetParameterLowerBound(theta.data(), static_cast<int>(i), limits[i].low);
    problem.SetParameterUpperBound(theta.data(), static_cast<int>(i), limits[i].high);
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.logging_type = ceres::SILENT;
  options.max_num_iterations = 300;
  options.function_tolerance = tolerance;
  options.gradient_tolerance = 1e-13;
  options.parameter_tolerance = 1e-12;
  options.num_threads = 1;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (!summary.IsSolutionUsable()) return {std::move(theta), std::numeric_limits<double>::infinity(), false};
  Minimum out{theta, 2 * summary.final_cost, true};
  for (std::size_t i = 0; i < theta.size(); ++i) {
    const double near = 1e-6 * (limits[i].high - limits[i].low);
    if (theta[i] < limits[i].low + near || theta[i] > limits[i].high - near) out.determined = false;
  }
  return out;
}

double misfit_at(const Unknowns& unknowns, const std::vector<Target>& targets, const std::vector<double>& theta) {
  std::vector<double> residuals;
  evaluate(unknowns, targets, theta, residuals, nullptr);
  double sum = 0;
  for (const double r : residuals) sum += r * r;
  return sum;
}

std::vector<Prediction> predict(const Unknowns& unknowns, const std::vector<Place>& places,
                                const std::vector<double>& theta) {
  std::vector<Target> targets(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) targets[i].place = places[i];
  std::vector<double> values;
  RowMajor jacobian;
  evaluate(unknowns, targets, theta, values, &jacobian);
  std::vector<Prediction> out(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(2 * i);
    out[i].value = {values[2 * i], values[2 * i + 1]};
    out[i].log_modulus_by.assign(jacobian.row(row).begin(), jacobian.row(row).end());
    out[i].phase_by.assign(jacobian.row(row + 1).begin(), jacobian.row(row + 1).end());
  }
  return out;
}

Covariance covariance_at(const Unknowns& unknowns, const std::vector<Target>& targets,
                         const std::vector<double>& theta) {
  std::vector<double> residuals;
  RowMajor jacobian;
  evaluate(unknowns, targets, theta, residuals, &jacobian);
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(jacobian, Eigen::ComputeThinV);
  const Eigen::VectorXd& s = svd.singularValues();
  // A direction with a smaller singular value has no effect in double precision, since θ consists of logarithms of
  // order one.
  const double smallest = 1e-10 * (s.size() > 0 ? s[0] : 0);
  Covariance out;
  out.undetermined.assign(theta.size(), false);
  Eigen::VectorXd inverse = Eigen::VectorXd::Zero(s.size());
  for (Eigen::Index i = 0; i < s.size(); ++i) {
    if (s[i] > smallest) {
      inverse[i] = 1 / (s[i] * s[i]);
      continue;
    }
    for (Eigen::Index p = 0; p < svd.matrixV().rows(); ++p)
      if (std::abs(svd.matrixV()(p, i)) > 1e-3) out.undetermined[static_cast<std::size_t>(p)] = true;
  }
  const RowMajor matrix = svd.matrixV() * inverse.asDiagonal() * svd.matrixV().transpose();
  out.matrix.assign(matrix.data(), matrix.data() + matrix.size());
  return out;
}

}  // namespace macadam::fitting
