// Strategy: every allocation is counted while the closed loop runs on the real scene.
#include "support/no_allocation.hpp"

#include "hurcules/sim/simulation.hpp"
#include "support/expect.hpp"
#include "support/scene.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

TEST(Tick, AllocatesNothing) {
  SimulationOptions options;
  options.clock = [] { return 0.0; };
  Simulation simulation(stretch_scene(), "stretch", options);
  const Vector command = Vector::Constant(11, 0.01);
  simulation.step(2600);  // warm, and room for the log
  simulation.reset(2);
  simulation.step(1900);
  const NoAllocation guard;
  simulation.step(200);  // the stretch begins
  simulation.step(200, &command);
  EXPECT_EQ(guard.count(), 0U);
}

}  // namespace
