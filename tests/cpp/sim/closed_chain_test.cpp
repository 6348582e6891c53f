// Strategy: an arm with a four-bar linkage in the physics, by velocities, accelerations and torques. The
// loop of the plan stays closed, that of the robot as far as MuJoCo's soft constraint holds it; a
// joint that follows keeps its range; bits and memory.
#include "hurcules/robot/closures.hpp"
#include "support/linkages.hpp"
#include "support/no_allocation.hpp"
#include "support/tip_simulation.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

class ClosedChainInTheLoop : public testing::TestWithParam<ControlOrder> {
 protected:
  static Simulation simulate() {
    return tip_simulation(load_model_text(kFourBar), "", GetParam(), 0.5);
  }
};

TEST_P(ClosedChainInTheLoop, Arrives) {
  Simulation simulation = simulate();
  const Frame tip = simulation.world().frame("tip");
  const Robot& plan = simulation.controller().plan();
  const Vector3 start = simulation.world().position(tip);
  const Vector command = Vector3(0.1, 0.1, -0.1);
  double open = 0.0;
  for (int i = 0; i < 2000; ++i) {
    simulation.step(1, i < 500 ? &command : nullptr);
    // by torques the plan is the robot itself
    if (GetParam() != ControlOrder::Torque) open = std::max(open, plan.closures()->error());
  }
  const Vector3 wanted = start + 1.0 * command;
  EXPECT_LT((plan.position(tip) - wanted).norm(), 1e-4);
  EXPECT_LT((simulation.world().position(tip) - wanted).norm(), 3e-3);
  EXPECT_LT(open, 1e-11);
  EXPECT_LT(simulation.world().closures()->error(), 1e-3);
  EXPECT_LT(simulation.plant().qvel().cwiseAbs().maxCoeff(), 3e-3);
}

TEST_P(ClosedChainInTheLoop, AJointThatFollowsKeepsItsRange) {
  Simulation simulation = simulate();
  const Closures::Follower rocker = simulation.world().closures()->followers().back();
  ASSERT_EQ(rocker.joint, "rocker");
  const Vector command = Vector3(0.4, 0.0, -0.3);
  const bool torque = GetParam() == ControlOrder::Torque;
  for (int i = 0; i < 2000; ++i) {
    simulation.step(1, &command);
    EXPECT_LT(simulation.controller().plan().qpos()[rocker.qpos],
              rocker.upper + (torque ? 2e-3 : 1e-9));
  }
  EXPECT_GT(simulation.controller().plan().qpos()[rocker.qpos], rocker.upper - 0.02);
}

TEST_P(ClosedChainInTheLoop, GoesOnFromASnapshotAndInACopyByTheSameBits) {
  Simulation simulation = simulate();
  const Vector command = Vector3(0.1, 0.1, -0.1);
  const GoneOn gone = expect_same_bits(simulation, command);
  Simulation another = simulate();
  another.restore(gone.state);
  another.step(200, &command);
  EXPECT_EQ(another.state(), gone.later);
}

TEST_P(ClosedChainInTheLoop, AllocatesNothing) {
  Simulation simulation = simulate();
  const Vector command = Vector3(0.1, 0.1, -0.1);
  simulation.step(50, &command);
  const NoAllocation guard;
  simulation.step(200, &command);
  EXPECT_EQ(guard.count(), 0U);
}

INSTANTIATE_TEST_SUITE_P(Orders, ClosedChainInTheLoop,
                         testing::Values(ControlOrder::Velocity, ControlOrder::Acceleration,
                                         ControlOrder::Torque));

}  // namespace
