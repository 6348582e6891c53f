// Strategy: the excess of made-up states, by hand.
#include "hurcules/sim/limit_monitor.hpp"

#include <limits>

#include "support/expect.hpp"
#include "support/tiny_models.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

TEST(LimitMonitor, KeepsTheWorstExcessOfEachKind) {
  const Robot robot(load_model_text(kPendulum));  // no velocity limits
  TelemetryNames names;
  names.coordinates = robot.coordinate_names();
  names.joints = {"slide"};
  Telemetry t(names);
  LimitMonitor monitor(robot, Vector::Constant(1, 5.0));
  t.limit_lower << -1.0, -std::numeric_limits<double>::infinity();
  t.limit_upper << 2.0, std::numeric_limits<double>::infinity();
  t.q << 2.0, 100.0;
  t.torque << -5.0;
  monitor.look(t);
  EXPECT_EQ(monitor.measured().position, 0.0);
  EXPECT_EQ(monitor.measured().torque, 0.0);
  t.q << -1.25, 0.0;
  t.q_des << 2.5, 0.0;
  t.demand << 7.0;
  monitor.look(t);
  EXPECT_DOUBLE_EQ(monitor.now().position, 0.25);
  t.q << 0.0, 0.0;
  monitor.look(t);
  EXPECT_EQ(monitor.now().position, 0.0);
  EXPECT_DOUBLE_EQ(monitor.measured().position, 0.25);
  EXPECT_DOUBLE_EQ(monitor.commanded().position, 0.5);
  EXPECT_DOUBLE_EQ(monitor.commanded().torque, 2.0);
  EXPECT_EQ(monitor.measured().velocity, 0.0);
  monitor.reset();
  EXPECT_EQ(monitor.commanded().torque, 0.0);
}

}  // namespace
