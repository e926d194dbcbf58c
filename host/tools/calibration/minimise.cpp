// SPDX-License-Identifier: GPL-3.0-or-later
// minimise.cpp  Minimises by Ceres Solver, with derivatives that the caller computes.
#include "host/tools/calibration/minimise.hpp"

#include <ceres/cost_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <Eigen/Dense>
#include <algorithm>
#include <limits>
#include <memory>

namespace macadam::calibration {
namespace {

/// The cost function for Ceres. Ceres asks for the residuals of a trial step and, if it accepts the step, for the
/// derivatives at the same θ; so the last result is kept.
class Cost : public ceres::CostFunction {
 public:
  Cost(const Residuals& residuals, std::size_t count, std::size_t unknowns)
      : residuals_(residuals), unknowns_(unknowns) {
    set_num_residuals(static_cast<int>(count));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(unknowns));
  }

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const std::vector<double> theta(parameters[0], parameters[0] + unknowns_);
    if (theta != theta_) {
      theta_ = theta;
      known_ = residuals_(theta, values_, jacobian_);
    }
    if (!known_) return false;
    std::copy(values_.begin(), values_.end(), residuals);
    if (jacobians && jacobians[0]) std::copy(jacobian_.begin(), jacobian_.end(), jacobians[0]);
    return true;
  }

 private:
  const Residuals& residuals_;
  std::size_t unknowns_;
  mutable std::vector<double> theta_, values_, jacobian_;
  mutable bool known_ = false;
};

}  // namespace

bool minimise(const Residuals& residuals, std::size_t count, const std::vector<ParameterBounds>& bounds,
              std::vector<double>& theta) {
  ceres::Problem problem;
  problem.AddResidualBlock(std::make_unique<Cost>(residuals, count, theta.size()).release(), nullptr, theta.data());
  for (std::size_t i = 0; i < theta.size(); ++i) {
    problem.SetParameterLowerBound(theta.data(), static_cast<int>(i), bounds[i].low);
    problem.SetParameterUpperBound(theta.data(), static_cast<int>(i), bounds[i].high);
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.logging_type = ceres::SILENT;
  options.max_num_iterations = 200;  // a misfit with narrow, bent valleys needs this many iterations
  options.function_tolerance = 1e-9;
  options.gradient_tolerance = 1e-13;
  options.parameter_tolerance = 1e-10;
  options.num_threads = 1;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return summary.IsSolutionUsable();
}

Directions directions(const std::vector<double>& jacobian, std::size_t columns) {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const auto n = static_cast<Eigen::Index>(columns);
  // n rows of zeros are appended so that the SVD has a direction for each unknown
  RowMajor full = RowMajor::Zero(static_cast<Eigen::Index>(jacobian.size()) / n + n, n);
  full.topRows(full.rows() - n) = Eigen::Map<const RowMajor>(jacobian.data(), full.rows() - n, n);
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(full, Eigen::ComputeThinV);
  const Eigen::VectorXd& s = svd.singularValues();
  const double smallest = 1e-10 * s[0];  // smaller values are errors of the solver, which stops at a tolerance
  Directions out;
  for (Eigen::Index i = 0; i < n; ++i) {
    out.deviation.push_back(s[i] > smallest ? 1 / s[i] : std::numeric_limits<double>::infinity());
    out.vector.emplace_back(svd.matrixV().col(i).begin(), svd.matrixV().col(i).end());
  }
  return out;
}

}  // namespace macadam::calibration
