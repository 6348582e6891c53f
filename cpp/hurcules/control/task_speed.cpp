#include "hurcules/control/task_speed.hpp"

#include <algorithm>
#include <cmath>

#include "hurcules/base/error.hpp"
#include "hurcules/solver/hierarchy.hpp"

namespace hurcules {

namespace {

constexpr double kLeastRho = 1e-4;  // keeps the answer unique and continuous at the target

// from the error to its interval, 0 inside
double way(const Task& task, Index row) {
  const double e = task.error()[row];
  return std::clamp(e, task.lower()[row], task.upper()[row]) - e;
}

double gain_of(const Task& task, Index row, double usual, double dt) {
  return std::min(task.gain(row, usual), 1.0 / dt);
}

}  // namespace

std::string to_string(Law law) {
  return law == Law::Arrive ? "arrive" : "thesis";
}

Law law_named(const std::string& name) {
  if (name == "arrive") return Law::Arrive;
  if (name == "thesis") return Law::Thesis;
  throw Error("law wants 'arrive' or 'thesis', got '" + name + "'");
}

double haste(const Task& task, double gain, double dt) {
  double together = 0.0, largest = 0.0;
  for (Index row = 0; row < task.rows(); ++row) {
    if (task.weights()[row] == 0.0) continue;
    const double f =
        gain_of(task, row, gain, dt) * std::abs(way(task, row)) / task.speed_share(row);
    together += f * f;
    largest = std::max(largest, f);
  }
  return (task.rows_apart() ? largest : std::sqrt(together)) / task.max_speed();
}

void wanted_rates(const Task& task, double gain, double dt, double most, VectorRef lower,
                  VectorRef upper) {
  for (Index row = 0; row < task.rows(); ++row) {
    const double g = way(task, row);
    const bool own = most > 1.0 && task.rows_apart();
    const double K = gain_of(task, row, gain, dt);
    const double f = own ? K * std::abs(g) / task.max_speed() : most;
    const double share = f > 1.0 ? 1.0 / f : 1.0;
    // the side that pushes is bounded, the other one holds back as it is
    const auto rate = [&](double side) {
      if (std::abs(side) >= kInfinity) return side;
      const double way = side - task.error()[row];
      return task.velocity_des()[row] + K * (way == g ? share * way : way);
    };
    lower[row] = rate(task.lower()[row]);
    upper[row] = rate(task.upper()[row]);
  }
}

void weigh_row(const Task& task, Index row, Level& level, Index level_row) {
  const double w = task.weights()[row];
  if (w == 1.0) return;
  level.A.row(level_row) *= w;
  weigh_sides(w, level.lower[level_row], level.upper[level_row]);
}

void weigh_sides(double weight, double& lower, double& upper) {
  for (double* const side : {&lower, &upper}) {
    if (weight == 0.0) {
      *side = 0.0;
    } else if (std::abs(*side) < kInfinity) {
      *side *= weight;
    }
  }
}

double regularization_at(double rho, double weight) {
  return std::max(rho * std::sqrt(weight), std::min(rho, kLeastRho));
}

}  // namespace hurcules
