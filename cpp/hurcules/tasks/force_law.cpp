#include "hurcules/tasks/force_law.hpp"

#include <cmath>
#include <limits>

#include "hurcules/base/error.hpp"
#include "hurcules/base/number_text.hpp"
#include "hurcules/base/values.hpp"

namespace hurcules {

namespace {

bool positive(double value) {
  return std::isfinite(value) && value > 0.0;
}

std::string number(double value) {
  return number_text(value, 3);
}

// a step of the closed loop; state (s, s one step ago), or (s, v, s one step ago, int (f_d - f))
Eigen::MatrixXd closed_loop(const ForceGains& g, double G) {
  const double dt = g.dt;
  if (g.loop == ForceLoop::FirstOrder) {
    return Eigen::MatrixXd{{1.0, -g.compliance * G * dt}, {1.0, 0.0}};
  }
  const bool position = g.loop != ForceLoop::Velocity;
  const double N = g.loop == ForceLoop::PositionIntegral ? g.integral : 0.0;
  Eigen::RowVector4d u(position ? -g.stiffness : 0.0, -g.damping,
                       -g.stiffness * (g.compliance * G + N * G * dt), g.stiffness * N);
  u /= g.mass;
  Eigen::MatrixXd step = Eigen::MatrixXd::Zero(4, 4);
  step.row(0) = 0.5 * dt * dt * u + Eigen::RowVector4d(1.0, dt, 0.0, 0.0);
  step.row(1) = dt * u + Eigen::RowVector4d(0.0, 1.0, 0.0, 0.0);
  step(2, 0) = 1.0;
  if (N > 0.0) step.row(3) << 0.0, 0.0, -G * dt, 1.0;
  return step;
}

// log of the largest |eigenvalue|: |A^k|^(1/k) for k = 2^60 (Gelfand's formula)
double log_spectral_radius(Eigen::MatrixXd A) {
  constexpr int kSquarings = 60;
  double log_radius = 0.0, share = 1.0;  // of A as it is now
  for (int i = 0; i < kSquarings; ++i) {
    const double size = A.norm();
    if (size == 0.0) return -std::numeric_limits<double>::infinity();
    log_radius += share * std::log(size);
    A /= size;
    A = (A * A).eval();
    share *= 0.5;
  }
  return log_radius;
}

bool is_stable(const ForceGains& gains, double G) {
  return log_spectral_radius(closed_loop(gains, G)) <= 1e-12;
}

}  // namespace

double largest_stiffness(const ForceGains& gains) {
  double stable = 1e-3, unstable = 1e12;  // [N/m] softer than air, harder than anything
  if (!is_stable(gains, stable)) return 0.0;
  if (is_stable(gains, unstable)) return unstable;
  while (unstable > 1.0001 * stable) {
    const double middle = std::sqrt(stable * unstable);
    (is_stable(gains, middle) ? stable : unstable) = middle;
  }
  return stable;
}

void check_force_gains(const ForceGains& gains, double environment, const std::string& task) {
  const std::string of = " of force task '" + task + "' ";
  require_number(positive(gains.dt), "dt" + of + "wants a positive time [s]", gains.dt);
  require_number(positive(gains.compliance), "compliance" + of + "wants a positive number",
                 gains.compliance);
  require_number(std::isfinite(environment) && environment >= 0.0,
                 "environment stiffness" + of + "wants a number >= 0 [N/m]", environment);
  if (gains.loop != ForceLoop::FirstOrder) {
    require(positive(gains.mass) && positive(gains.damping) && positive(gains.stiffness),
            "mass, damping and stiffness" + of + "want positive numbers");
  }
  const bool integral = gains.loop == ForceLoop::PositionIntegral;
  require_number(!integral || positive(gains.integral),
                 "integral gain" + of + "wants a positive number", gains.integral);
  const double G = environment, M = gains.mass, L = gains.damping, C = gains.compliance;
  if (integral && G > 0.0) {
    const double most = L * (1.0 + C * G) / (M * G);  // Routh
    require(gains.integral < most,
            "integral gain" + of + "wants to be below L (1 + C G) / (M G) = " + number(most) +
                " at G = " + number(G) + " N/m, " + number(gains.integral) + " came: unstable");
  }
  const double largest = largest_stiffness(gains);
  require(largest > 0.0,
          "the gains" + of + "are unstable on any ground in steps of " + number(gains.dt) + " s");
  require(G < largest, "the gains" + of + "are stable up to an environment of " + number(largest) +
                           " N/m in steps of " + number(gains.dt) + " s, " + number(G) +
                           " N/m came: a smaller compliance is wanted");
}

double ForceLaw::step(const Motion& motion, double force_error, double share) {
  const ForceGains& g = gains_;
  double delta = share * g.compliance * force_error;
  if (g.loop == ForceLoop::FirstOrder) return delta;  // [T 5.7.62]
  if (g.loop == ForceLoop::PositionIntegral) {
    integral_ += force_error * g.dt;
    delta += g.integral * integral_;  // [T 5.4.34]
  }
  if (has_reference()) delta -= motion.position;
  return (-g.damping * motion.velocity + g.stiffness * delta) / g.mass;  // [T 5.4.28, 5.4.35]
}

double ForceLaw::free(const Motion& motion) const {
  if (!commands_acceleration()) return 0.0;
  return (-gains_.damping * motion.velocity - gains_.stiffness * motion.position) / gains_.mass;
}

double ForceLaw::rate(double environment) const {
  const double rate = gains_.compliance * environment;
  return commands_acceleration() ? rate * gains_.stiffness / gains_.damping : rate;
}

}  // namespace hurcules
