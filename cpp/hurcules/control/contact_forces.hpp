// The forces of a stack's contacts, as unknowns beside the accelerations.
//
//   x = [qddot + D qdot (n); lambda / (m g) (f)],  lambda >= 0         contact_task.hpp
//   torque limits     -tau <= M qddot + h - sum E_c lambda_c <= tau    tau = 0 of a free root: what
//                                                                      moves it are contacts alone
//   contacts          J qddot + Jdot qdot = -L J qdot                  they yield to torque limits
//   ... the stack's own levels ...
//   least forces      lambda = 0, as near as what is above leaves: it spreads the load
// The torque limits come before the level of the stack that has contacts; those of one's own count
// the forces wherever they are. Forces are
// counted in the robot's weight, so that regularisation weighs them beside accelerations.
#pragma once

#include <optional>
#include <vector>

#include "hurcules/control/stack_problem.hpp"
#include "hurcules/tasks/contact_task.hpp"
#include "hurcules/tasks/torque_limits.hpp"

namespace hurcules {

class ContactForces {
 public:
  explicit ContactForces(const Robot& robot);

  // The stack with torque limits and least forces where it has contacts, else as it is. Throws Error
  // for a robot that floats and a stack without contacts.
  [[nodiscard]] Stack completed(const Stack& stack);
  [[nodiscard]] Index size() const { return size_; }  // f, 0 without contacts
  // Finds its levels in a problem of the completed stack, and bounds its forces there. Throws Error
  // where no limits of the coordinates are in it.
  void place(StackProblem& problem);
  // the columns of the forces, after the rows; measured at the last update of the contacts
  void fill(Hierarchy& hierarchy) const;
  // takes the forces out of a solution x (n + f)
  void read(const Vector& x);
  // what the drives need not give, E lambda, off a torque (n)
  void relieve(VectorRef torque) const;
  // F in W [N] on the robot at a contact of the stack, zero for another task
  [[nodiscard]] Vector3 force(const Task& contact) const;

 private:
  // the unknowns are as small as can be; they have no coordinates
  class LeastForces : public Task {
   public:
    LeastForces(Index forces, Index coordinates) : Task("least forces", forces, coordinates) {}
    [[nodiscard]] std::unique_ptr<Task> clone() const override {
      return std::make_unique<LeastForces>(*this);
    }
    void update(const Robot& /*robot*/) override {}
    void hold(const Robot& /*robot*/) override {}
    void advance(const ConstVectorRef& /*velocity*/, double /*dt*/) override {}
    void save(StateWriter& /*writer*/) const override {}
    void restore(StateReader& /*reader*/) override {}
  };

  Index n_;
  bool floating_;
  double unit_;  // [N] m g
  TorqueLimits torques_;
  std::optional<LeastForces> least_;
  std::vector<const ContactTask*> contacts_;
  // rows of torque limits in the problem
  struct Place {
    std::size_t level;
    Index row;
    const TorqueLimits* limits;
  };
  std::vector<Place> places_;
  Index size_ = 0;
  Vector lambda_;  // [N] (f)
};

}  // namespace hurcules
