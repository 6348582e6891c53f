// Joints that follow the coordinates because constraints of the model close loops with them.
//
//   c(qpos) = 0           connect, weld, tendon and joint equalities that tie them to coordinates
//   v_f = G v             G = -C_f^+ C_S,  C = dc/dqpos,  C_S: its columns by coordinate
//   a_f = G a + g         g = -C_f^+ (dC/dt qvel)
// They are degrees of freedom without an actuator and without a spring: a crank of a four-bar linkage,
// a rod between two balls, a door in a hand, a body that is welded to it. Where the coordinates were
// chosen by name, joints with an actuator may follow too. The roots of robots never do. The inverse is
// damped, so that G stays bounded where a linkage is stretched. What the constraints are comes from
// MuJoCo.
#pragma once

#include <Eigen/Cholesky>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "hurcules/base/types.hpp"

struct mjModel_;
struct mjData_;

namespace hurcules {

struct Coordinate;

class Closures {
 public:
  static constexpr double kOpen = 1e-6;  // [m] or [rad] a loop that does not hold
  // One degree of freedom that follows.
  struct Follower {
    std::string joint;
    int dof = 0;                      // address in qvel
    int qpos = 0;                     // address in qpos; of a ball or a free joint its first
    double lower = 0.0, upper = 0.0;  // [rad] or [m], -inf and inf without; of those two without
  };

  // chosen: somebody named the coordinates, so that joints with an actuator may follow
  Closures(const mjModel_& model, const std::vector<Coordinate>& coordinates, bool chosen);
  ~Closures();

  [[nodiscard]] Index size() const { return static_cast<Index>(followers_.size()); }  // f
  [[nodiscard]] const std::vector<Follower>& followers() const { return followers_; }
  [[nodiscard]] int dof(Index f) const { return followers_[static_cast<std::size_t>(f)].dof; }
  // the equality is one of these loops
  [[nodiscard]] bool keeps(int equality) const;
  // a loop moves with this degree of freedom, at the model's first posture or beside it
  [[nodiscard]] bool feels(int dof) const { return felt_[static_cast<std::size_t>(dof)]; }

  // G at a configuration (nq), as it is
  void measure(const double* qpos);
  // Moves the joints that follow, in qpos, until the constraints hold to 1e-12 or as near as they
  // come; then measures. `change` (n): what the coordinates moved by since the last measure.
  void close(double* qpos, const Vector& change);
  // g for the velocity of the coordinates (n), qvel (nv) that of all joints; where measure was
  void set_velocity(const double* qpos, const double* qvel);

  [[nodiscard]] const Matrix& share() const { return share_; }  // G (f, n)
  [[nodiscard]] const Vector& drift() const { return drift_; }  // g (f)
  // largest velocity with which a loop opens at a coordinate's velocity 1, of the last measure: more
  // than rounding where the coordinates are more than the loops leave free, or a linkage is stretched
  [[nodiscard]] double slack() const { return slack_; }
  [[nodiscard]] double error() const { return error_; }  // largest |c| [m] or [rad]

 private:
  void find(bool chosen);
  [[nodiscard]] std::vector<bool> joints_that_may(bool chosen) const;
  void take(int joint, std::vector<bool>& moves, std::vector<bool>& may);
  [[nodiscard]] Follower follower(int dof) const;
  // C and c of the loops, at a configuration
  void linearize(const double* qpos);
  // G and slack, of the last linearize
  void find_share();
  // the joints that follow, in qpos, (f)
  void move(double* qpos, const Vector& step);

  std::unique_ptr<mjModel_, void (*)(mjModel_*)> model_;  // constraints alone
  std::unique_ptr<mjData_, void (*)(mjData_*)> data_;
  std::vector<std::vector<std::pair<int, double>>> coordinates_;  // (n) dofs and factors
  std::vector<Follower> followers_;                               // in the order of their dofs
  std::vector<bool> loops_;                                       // (neq)
  std::vector<bool> felt_;                                        // (nv)
  Index rows_ = 0;                                                // of the last linearize
  Matrix C_, C_f_;                                                // (most rows, nv), (most rows, f)
  Vector c_, rate_;                                               // (most rows)
  Matrix normal_;                                                 // C_f' C_f, damped (f, f)
  Eigen::LDLT<Matrix> factor_;
  Matrix share_;
  Vector drift_, step_, right_;
  Vector full_, ahead_;  // (nv), (nq)
  double error_ = 0.0, slack_ = 0.0;
};

}  // namespace hurcules
