#include "hurcules/control/motion_law.hpp"

namespace hurcules {

namespace {

// what both controllers answer alike
template <class Controller>
class LawOf : public MotionLaw {
 public:
  template <class Options>
  LawOf(const Robot& robot, const Stack& stack, const Options& options)
      : controller_(robot, options) {
    controller_.set_stack(stack);
  }
  void solve() override { controller_.solve(); }
  void reset() override { controller_.reset(); }
  void save(StateWriter& writer) const override { controller_.save(writer); }
  void restore(StateReader& reader) override { controller_.restore(reader); }
  const Stack& stack() const override { return controller_.stack(); }
  const Hierarchy& hierarchy() const override { return controller_.hierarchy(); }
  const Solution& solution() const override { return controller_.solution(); }
  const Eigen::VectorXi& active_limits() const override { return controller_.active_limits(); }
  const JointLimits* limits() const override { return controller_.limits(); }
  double max_acceleration() const override { return controller_.options().max_acceleration; }
  std::vector<LevelDiagnostics> diagnostics(const Robot& plan) const override {
    return controller_.diagnostics(plan);
  }

 protected:
  Controller controller_;
};

class VelocityLaw final : public LawOf<VelocityController> {
 public:
  using LawOf::LawOf;
  ControlOrder order() const override { return ControlOrder::Velocity; }
  void measure(Robot& plan, const Vector& velocity) override {
    plan.set_velocity(velocity);
    controller_.measure(plan);
  }
  bool scale(const VelocityBounds& bounds, const Vector&) override {
    return controller_.scale_velocity(bounds);
  }
  const Vector& next_velocity(const Vector&) override { return controller_.velocity(); }
  void integrate(Vector& q, Vector& velocity) const override {
    velocity = controller_.velocity();
    controller_.integrate(q);
  }
  void take_over(const Vector& velocity) override { controller_.take_over(velocity); }
  double rate() const override { return controller_.options().gain; }
};

class AccelerationLaw : public LawOf<AccelerationController> {
 public:
  AccelerationLaw(const Robot& robot, const Stack& stack,
                  const AccelerationControllerOptions& options)
      : LawOf(robot, stack, options), next_(Vector::Zero(robot.size())) {}
  ControlOrder order() const override { return ControlOrder::Acceleration; }
  void measure(Robot& plan, const Vector& velocity) override {
    plan.set_velocity(velocity);
    controller_.measure(plan);
  }
  bool scale(const VelocityBounds& bounds, const Vector& velocity) override {
    return controller_.scale_velocity(bounds, velocity);
  }
  const Vector& next_velocity(const Vector& velocity) override {
    next_ = velocity + controller_.options().dt * controller_.acceleration();
    return next_;
  }
  void integrate(Vector& q, Vector& velocity) const override { controller_.integrate(q, velocity); }
  // an acceleration goes on from any velocity
  void take_over(const Vector&) override { controller_.reset(); }
  double rate() const override {
    return controller_.options().stiffness / controller_.options().damping;
  }

 private:
  Vector next_;
};

// what it leads is the robot itself: nothing is integrated
class TorqueLaw final : public AccelerationLaw {
 public:
  using AccelerationLaw::AccelerationLaw;
  ControlOrder order() const override { return ControlOrder::Torque; }
  void torque(const Robot& plan, VectorRef torque) const override {
    controller_.torque(plan, torque);
  }
  Vector3 contact_force(const Task& contact) const override {
    return controller_.contact_force(contact);
  }
  bool scale(const VelocityBounds&, const Vector&) override { return false; }
  const Vector& next_velocity(const Vector& velocity) override { return velocity; }
  void integrate(Vector&, Vector&) const override {}
};

}  // namespace

std::unique_ptr<MotionLaw> make_law(const Robot& robot, const Stack& stack,
                                    const VelocityControllerOptions& options) {
  return std::make_unique<VelocityLaw>(robot, stack, options);
}

std::unique_ptr<MotionLaw> make_law(const Robot& robot, const Stack& stack,
                                    const AccelerationControllerOptions& options) {
  return std::make_unique<AccelerationLaw>(robot, stack, options);
}

std::unique_ptr<MotionLaw> make_torque_law(const Robot& robot, const Stack& stack,
                                           const AccelerationControllerOptions& options) {
  return std::make_unique<TorqueLaw>(robot, stack, options);
}

}  // namespace hurcules
