// Strategy: what every task promises, checked on every task (support/task_cases.hpp) at seeded
// random configurations away from its target. Derivatives are compared with central differences;
// errors of angles are compared on the circle. Not tested: the derivatives inside a task's narrow
// cone about its singularity, where they fade.
#include <cmath>

#include "hurcules/base/pose.hpp"
#include "support/expect.hpp"
#include "support/no_allocation.hpp"
#include "support/random_motion.hpp"
#include "support/task_cases.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

constexpr double kStep = 1e-5;  // [rad] or [s]
constexpr unsigned kSeeds = 25;

class EveryTask : public testing::TestWithParam<TaskCase> {
 protected:
  Robot robot_{load_model_text(GetParam().model)};
  TaskPtr task_ = GetParam().make(robot_);

  // holds somewhere, then stands somewhere else, moving
  void scatter(RandomMotion& random) {
    random.move(robot_);
    task_->hold(robot_);
    robot_.set_configuration(random.configuration(robot_));
    robot_.set_velocity(random.vector(robot_.size(), 1.0));
    task_->update(robot_);
  }
  Vector further(const Vector& q, const Vector& step) const {
    Vector next = q;
    add_step(robot_.rotations(), step, next);
    return next;
  }
  Vector error_at(const Vector& q) {
    robot_.set_configuration(q);
    task_->update(robot_);
    return task_->error();
  }
  // a - b, the short way round where the task measures angles
  Vector difference(const Vector& a, const Vector& b) const {
    Vector d = a - b;
    const std::string& name = task_->name();
    for (const char* angle : {"heading", "swivel", "gaze"})
      if (contains(name, angle)) d = d.unaryExpr(&wrap_angle);
    return d;
  }
  // an orientation error jumps at half a turn: no difference across it
  bool near_jump() const {
    return (contains(task_->name(), "orientation") || contains(task_->name(), "hand_in_hand")) &&
           task_->error().norm() > 3.1;
  }
};

TEST_P(EveryTask, JacobianEqualsDifferenceOfError) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    RandomMotion random(seed);
    scatter(random);
    if (near_jump()) continue;
    const Matrix J = task_->jacobian();
    const Vector q = robot_.configuration();
    Matrix wanted(J.rows(), J.cols());
    for (Index i = 0; i < q.size(); ++i) {
      const Vector ahead = error_at(further(q, kStep * Vector::Unit(q.size(), i)));
      const Vector behind = error_at(further(q, -kStep * Vector::Unit(q.size(), i)));
      wanted.col(i) = difference(ahead, behind) / (2 * kStep);
    }
    const double scale = std::max(1.0, std::pow(J.cwiseAbs().maxCoeff(), 3));
    EXPECT_TRUE(near(J, wanted, 1e-8 * scale)) << "seed " << seed;
  }
}

TEST_P(EveryTask, DriftEqualsDifferenceOfJacobianTimesVelocity) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    RandomMotion random(seed);
    scatter(random);
    if (near_jump()) continue;
    const Vector drift = task_->drift(), q = robot_.configuration(), v = robot_.velocity();
    const double scale = std::max(1.0, std::pow(task_->jacobian().cwiseAbs().maxCoeff(), 4));
    error_at(further(q, kStep * v));
    const Vector ahead = task_->jacobian() * v;
    error_at(further(q, -kStep * v));
    const Vector wanted = (ahead - task_->jacobian() * v) / (2 * kStep);
    EXPECT_TRUE(near(drift, wanted, 1e-6 * scale)) << "seed " << seed;
  }
}

TEST_P(EveryTask, ErrorChangesByJacobianTimesVelocityLessFeedForward) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    RandomMotion random(seed);
    scatter(random);
    if (near_jump()) continue;
    const Vector q = robot_.configuration(), v = robot_.velocity();
    const Vector command = random.vector(task_->rows(), 0.5);
    task_->advance(command, 0.0);
    const Vector feed_forward = task_->velocity_des();
    task_->update(robot_);
    EXPECT_TRUE(near(task_->velocity_des(), feed_forward, 1e-13));
    const Vector rate = task_->jacobian() * v - task_->velocity_des();
    std::vector<double> state;
    StateWriter writer(state);
    task_->save(writer);

    task_->advance(command, kStep);
    const Vector ahead = error_at(further(q, kStep * v));
    StateReader reader(state);
    task_->restore(reader);
    task_->advance(command, -kStep);
    const Vector behind = error_at(further(q, -kStep * v));
    const Vector wanted = difference(ahead, behind) / (2 * kStep);
    const double scale = std::max(1.0, std::pow(task_->jacobian().cwiseAbs().maxCoeff(), 3));
    EXPECT_TRUE(near(rate, wanted, 1e-8 * scale)) << "seed " << seed;
  }
}

TEST_P(EveryTask, HoldMakesTheErrorZero) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    RandomMotion random(seed);
    scatter(random);
    task_->hold(robot_);
    EXPECT_TRUE(near(task_->error(), Vector::Zero(task_->rows()), 1e-14)) << "seed " << seed;
    task_->update(robot_);
    EXPECT_TRUE(near(task_->error(), Vector::Zero(task_->rows()), 1e-14)) << "seed " << seed;
    EXPECT_EQ(task_->velocity_des().norm(), 0.0);
  }
}

TEST_P(EveryTask, ANewTaskHolds) {
  EXPECT_TRUE(near(task_->error(), Vector::Zero(task_->rows()), 1e-14));
}

TEST_P(EveryTask, AdvanceMovesTheErrorBackByVelocityTimesTime) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    RandomMotion random(seed);
    random.move(robot_);
    task_->hold(robot_);
    const Vector velocity = random.vector(task_->rows(), 1.0);
    task_->advance(velocity, 0.01);
    EXPECT_TRUE(near(task_->velocity_des(), velocity, 1e-12));
    task_->update(robot_);
    EXPECT_TRUE(near(task_->error(), -velocity * 0.01, 1e-13)) << "seed " << seed;
  }
}

TEST_P(EveryTask, SnapshotContinuesBitForBit) {
  RandomMotion random(7);
  scatter(random);
  const Vector command = random.vector(task_->rows(), 0.5), q = random.configuration(robot_);
  task_->advance(command, 0.01);
  task_->update(robot_);
  std::vector<double> state;
  StateWriter writer(state);
  task_->save(writer);

  const auto go_on = [&] {
    task_->advance(command, 0.02);
    return error_at(q);
  };
  const Vector error = go_on();
  const Vector feed_forward = task_->velocity_des();
  task_->hold(robot_);
  StateReader reader(state);
  task_->restore(reader);
  EXPECT_TRUE(reader.at_end());
  EXPECT_EQ(go_on(), error);
  EXPECT_EQ(task_->velocity_des(), feed_forward);
}

TEST_P(EveryTask, SnapshotKeepsTheFeedForward) {
  RandomMotion random(8);
  scatter(random);
  task_->advance(random.vector(task_->rows(), 0.5), 0.01);
  task_->update(robot_);
  const Vector feed_forward = task_->velocity_des(), error = task_->error();
  std::vector<double> state;
  StateWriter writer(state);
  task_->save(writer);
  task_->hold(robot_);
  StateReader reader(state);
  task_->restore(reader);
  task_->update(robot_);
  EXPECT_EQ(task_->velocity_des(), feed_forward);
  EXPECT_EQ(task_->error(), error);
}

TEST_P(EveryTask, SingularConfigurationsGiveBoundedNumbers) {
  Vector q = Vector::Zero(robot_.size());
  robot_.set_velocity(Vector::Ones(robot_.size()));
  const double quarter = std::acos(-1.0) / 2;
  // straight arms and quarter turns of each coordinate, near and exactly
  for (Index i = 0; i < robot_.size(); ++i) {
    for (const double turn : {0.0, 1e-9, 1e-4, quarter, -quarter, quarter + 1e-6}) {
      q[i] = turn;
      error_at(q);
      EXPECT_TRUE(task_->error().allFinite());
      EXPECT_TRUE(task_->drift().allFinite());
      EXPECT_TRUE(task_->jacobian().allFinite());
      EXPECT_LE(task_->jacobian().cwiseAbs().maxCoeff(), 400.0);
      task_->hold(robot_);
      EXPECT_TRUE(task_->error().allFinite());
    }
  }
}

TEST_P(EveryTask, ATickAllocatesNothing) {
  robot_.set_velocity(Vector::Ones(robot_.size()));
  const Vector command = Vector::Constant(task_->rows(), 0.1);
  const NoAllocation guard;
  task_->update(robot_);
  task_->advance(command, 0.001);
  task_->update(robot_);
  task_->hold(robot_);
  task_->set_interval(task_->lower(), task_->upper());
  EXPECT_EQ(guard.count(), 0U);
}

TEST_P(EveryTask, AnotherRobotIsAnError) {
  Robot other(load_model_text(kPendulum));
  EXPECT_TRUE(contains(error_text([&] { task_->update(other); }), "made for another robot"));
  EXPECT_TRUE(contains(error_text([&] { task_->hold(other); }), "made for another robot"));
}

TEST_P(EveryTask, WrongCommandsAndIntervalsAreErrors) {
  const Vector few = Vector::Zero(task_->rows() - 1);
  const Vector fine = Vector::Zero(task_->rows()), high = Vector::Ones(task_->rows());
  const Vector none = Vector::Constant(task_->rows(), std::nan(""));
  const std::string name = "task '" + task_->name() + "'";
  EXPECT_TRUE(contains(error_text([&] { task_->advance(few, 0.1); }), name));
  EXPECT_TRUE(contains(error_text([&] { task_->advance(none, 0.1); }), "finite"));
  EXPECT_TRUE(contains(error_text([&] { task_->set_interval(few, high); }), name));
  const Vector more = Vector::Zero(task_->target_size() + 1);
  EXPECT_TRUE(contains(error_text([&] { task_->assign_target(more); }), name));
  EXPECT_TRUE(contains(error_text([&] { task_->set_interval(high, fine); }), "lower <= upper"));
  EXPECT_TRUE(contains(error_text([&] { task_->set_interval(none, fine); }), "lower <= upper"));
}

TEST_P(EveryTask, IntervalIsKeptInTheSnapshot) {
  const Index m = task_->rows();
  std::vector<double> state;
  StateWriter writer(state);
  task_->set_interval(Vector::Constant(m, -0.1), Vector::Constant(m, 0.2));
  task_->save(writer);
  task_->set_interval(Vector::Zero(m), Vector::Zero(m));
  StateReader reader(state);
  task_->restore(reader);
  EXPECT_EQ(task_->lower(), Vector::Constant(m, -0.1));
  EXPECT_EQ(task_->upper(), Vector::Constant(m, 0.2));
}

TEST_P(EveryTask, ACopyGetsTheMemory) {
  const auto copy = task_->clone();
  task_->advance(Vector::Constant(task_->rows(), 0.1), 0.5);
  task_->set_interval(Vector::Constant(task_->rows(), -0.1), task_->upper());
  std::vector<double> scratch;
  copy_memory(*task_, *copy, scratch);
  task_->update(robot_);
  copy->update(robot_);
  EXPECT_EQ(copy->error(), task_->error());
  EXPECT_EQ(copy->velocity_des(), task_->velocity_des());
  EXPECT_EQ(copy->lower(), task_->lower());
  const NoAllocation guard;
  copy_memory(*task_, *copy, scratch);
  EXPECT_EQ(guard.count(), 0U);
}

INSTANTIATE_TEST_SUITE_P(Of, EveryTask, testing::ValuesIn(all_cases()),
                         [](const auto& test) { return test.param.name; });

}  // namespace
