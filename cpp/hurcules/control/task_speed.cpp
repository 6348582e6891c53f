#include "hurcules/control/task_speed.hpp"

#include <algorithm>
#include <cmath>

#include "hurcules/base/error.hpp"
#include "hurcules/solver/hierarchy.hpp"

namespace hurcules {

namespace {

constexpr double kBraking = 0.9;    // of max_acceleration: what a period is late needs the rest
constexpr double kLeastRho = 1e-4;  // keeps the answer unique and continuous at the target

// from the error to its interval, 0 inside
double way(const Task& task, Index row) {
  const double e = task.error()[row];
  return std::clamp(e, task.lower()[row], task.upper()[row]) - e;
}

double gain_of(const Task& task, Index row, double usual, double dt) {
  return std::min(task.gain(row, usual), 1.0 / dt);
}

// K |g| and |g| of a task in its unit, of its fastest row where they stand apart
struct Asked {
  double speed = 0.0, distance = 0.0;
};

Asked asked(const Task& task, double gain, double dt) {
  Asked together, largest;
  for (Index row = 0; row < task.rows(); ++row) {
    if (task.weights()[row] == 0.0) continue;
    const double K = gain_of(task, row, gain, dt), g = std::abs(way(task, row));
    const double speed = K * g / task.speed_share(row), distance = g / task.speed_share(row);
    together.speed += speed * speed;
    together.distance += distance * distance;
    if (speed > largest.speed) largest = {speed, distance};
  }
  if (task.rows_apart()) return largest;
  return {std::sqrt(together.speed), std::sqrt(together.distance)};
}

// speed / v_b, v_b^2 = 2 a |g| - (a / K)^2 with speed = K |g|; 0 below a / K
double over_brake(const Task& task, const Asked& asked) {
  if (std::isinf(task.max_acceleration()) || asked.speed == 0.0) return 0.0;
  const double late = kBraking * task.max_acceleration() * asked.distance / asked.speed;  // a / K
  return asked.speed > late ? asked.speed / std::sqrt(late * (2.0 * asked.speed - late)) : 0.0;
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
  return asked(task, gain, dt).speed / task.max_speed();
}

double braking(const Task& task, double gain, double dt) {
  if (std::isinf(task.max_acceleration())) return 0.0;
  return over_brake(task, asked(task, gain, dt));
}

void wanted_rates(const Task& task, double gain, double dt, double most, VectorRef lower,
                  VectorRef upper) {
  for (Index row = 0; row < task.rows(); ++row) {
    const double g = way(task, row);
    const bool own = most > 1.0 && task.rows_apart();
    const double K = gain_of(task, row, gain, dt);
    const double speed = K * std::abs(g);
    const double f =
        own ? std::max(speed / task.max_speed(), over_brake(task, {speed, std::abs(g)})) : most;
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
