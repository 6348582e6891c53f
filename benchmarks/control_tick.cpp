// The control tick of the manipulation robot, 19 coordinates, stage by stage, by velocity and by
// acceleration: seven strict levels, joint limits first.
//
//   joint < hpos < horient < swivel < pel < gaze < posture         6 + 6 + 2 + 1 + 2 + 19 rows
//   kinematics   the robot at q*: positions, Jacobians and inertia by MuJoCo
//   hierarchy    the tasks measure and fill the levels
//   solve        one solve, warm
//   servo        q* further by a period, and the torques: of the joint servos (velocity), by
//                inverse dynamics (acceleration)
// Both hands swing on circles: within reach, and 1 m beyond it. The same motion runs several times;
// a stage of a tick is the least of its rounds, so that what other programs add is gone.
//
// control_tick [--seconds S] [--rounds R]   exit status 1 when a tick allocates
#include "allocations.hpp"
// first: it stands in front of the C library
#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "hurcules/control/acceleration_controller.hpp"
#include "hurcules/control/joint_servo.hpp"
#include "hurcules/control/tasks.hpp"
#include "hurcules/control/velocity_controller.hpp"
#include "measure.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_benchmark;

constexpr double kDt = 1e-3;
constexpr double kTurn = 0.6;  // [rad/s] of the hands on their circles
constexpr std::size_t kStages = 4;
const std::array<const char*, kStages> kStageNames = {"kinematics", "hierarchy", "solve", "servo"};

// the robot that plans, and its tasks
struct Body {
  explicit Body(double radius_) : radius(radius_) {
    robot.set_keyframe("ready");
    robot.stand_on("lower_leg_L");
    for (Task* task : tasks) task->hold(robot);
  }
  static SwivelTaskOptions arm(const std::string& side) {
    SwivelTaskOptions options;
    options.shoulder = side + "_shoulder";
    options.elbow = side + "_elbow";
    options.wrist = side + "_wrist";
    options.torso = "torso";
    return options;
  }
  static PositionTaskOptions along_x() {
    PositionTaskOptions options;
    options.axes = Vector3::UnitX().transpose();
    return options;
  }
  [[nodiscard]] Stack stack() {
    return joint < StackLevel("hpos", {&left, &right}) <
           StackLevel("horient", {&left_turn, &right_turn}) <
           StackLevel("swivel", {&left_swivel, &right_swivel}) < pelvis < gaze < posture;
  }
  // a circle in x and z each
  void swing(double time) {
    const double v = radius * kTurn;
    const Vector3 velocity(v * std::cos(kTurn * time), 0.0, v * std::sin(kTurn * time));
    left.advance(velocity, kDt);
    right.advance(velocity, kDt);
  }

  double radius;
  Robot robot{load_model(HURCULES_MODELS "/robots/manipulation.xml")};
  JointLimits joint{"joint", robot};
  PositionTask left{"lhpos", robot, "L_tcp"}, right{"rhpos", robot, "R_tcp"};
  OrientationTask left_turn{"lhorient", robot, "L_tcp"}, right_turn{"rhorient", robot, "R_tcp"};
  SwivelTask left_swivel{"lswivel", robot, arm("L")}, right_swivel{"rswivel", robot, arm("R")};
  PositionTask pelvis{"pel", robot, "pelvis", along_x()};
  GazeTask gaze{"gaze", robot, "gaze"};
  PostureTask posture{"posture", robot};
  std::vector<Task*> tasks{&left,         &right,  &left_turn, &right_turn, &left_swivel,
                           &right_swivel, &pelvis, &gaze,      &posture};
};

struct Run {
  std::vector<std::array<double, kStages>> ticks;  // [s]
  std::size_t allocations = 0;
  long changes = 0;  // of the working sets, all ticks
};

// Calls the stages one after the other and keeps the time of each.
class Tick {
 public:
  explicit Tick(Run& run) : run_(run) { run_.ticks.push_back({}); }
  template <typename Stage>
  void time(std::size_t i, Stage&& stage) {
    const std::size_t before = allocations();
    run_.ticks.back()[i] = seconds_of(stage);
    run_.allocations += allocations() - before;
  }

 private:
  Run& run_;
};

Run by_velocity(double radius, int ticks) {
  Body body(radius);
  const ModelPtr model = body.robot.model();
  const Vector qpos = Vector::Zero(model->nq), qvel = Vector::Zero(model->nv);
  const std::vector<ActuatorStatus> drives(static_cast<std::size_t>(model->nu));
  Vector ctrl = Vector::Zero(model->nu);
  VelocityController controller(body.robot, {.dt = kDt});
  controller.set_stack(body.stack());
  JointServo servo(body.robot, model_servo_gains(joint_actuators(body.robot)), kDt);
  servo.reset(qpos);
  Vector q = body.robot.configuration();
  Run run;
  run.ticks.reserve(static_cast<std::size_t>(ticks));
  for (int i = 0; i < ticks; ++i) {
    body.swing(i * kDt);
    Tick tick(run);
    tick.time(0, [&] { body.robot.set_configuration(q); });
    tick.time(1, [&] { controller.measure(body.robot); });
    tick.time(2, [&] { controller.solve(); });
    tick.time(3, [&] {
      controller.integrate(q);
      servo.follow(q, controller.velocity());
      servo.compute({qpos, qvel, drives}, ctrl);
    });
    run.changes += controller.solution().changes;
  }
  return run;
}

Run by_acceleration(double radius, int ticks) {
  Body body(radius);
  AccelerationController controller(body.robot, {.dt = kDt});
  controller.set_stack(body.stack());
  Vector q = body.robot.configuration(), velocity = body.robot.velocity();
  Vector torque(q.size());
  Run run;
  run.ticks.reserve(static_cast<std::size_t>(ticks));
  for (int i = 0; i < ticks; ++i) {
    body.swing(i * kDt);
    Tick tick(run);
    tick.time(0, [&] {
      body.robot.set_configuration(q);
      body.robot.set_velocity(velocity);
    });
    tick.time(1, [&] { controller.measure(body.robot); });
    tick.time(2, [&] { controller.solve(); });
    tick.time(3, [&] {
      controller.torque(body.robot, torque);
      controller.integrate(q, velocity);
    });
    run.changes += controller.solution().changes;
  }
  return run;
}

// the least of each stage of each tick over the rounds
template <typename Make>
Run least(int rounds, Make&& make) {
  Run best = make();
  for (int r = 1; r < rounds; ++r) {
    const Run run = make();
    best.allocations += run.allocations;
    for (std::size_t i = 0; i < best.ticks.size(); ++i)
      for (std::size_t s = 0; s < kStages; ++s)
        best.ticks[i][s] = std::min(best.ticks[i][s], run.ticks[i][s]);
  }
  return best;
}

void print_row(const char* name, std::vector<double> seconds) {
  const Quantiles q = quantiles(std::move(seconds));
  std::printf("  %-12s %9.2f %9.2f %9.2f %9.2f\n", name, q.median, q.p99, q.p999, q.max);
}

std::size_t print(const char* what, const Run& run) {
  const auto count = static_cast<double>(run.ticks.size());
  std::printf("%-14s %9s %9s %9s %9s   [us], %zu ticks, %.3f changes of a working set a tick\n",
              what, "median", "p99", "p99.9", "max", run.ticks.size(),
              static_cast<double>(run.changes) / count);
  std::vector<double> whole(run.ticks.size(), 0.0);
  for (std::size_t s = 0; s < kStages; ++s) {
    std::vector<double> seconds;
    for (std::size_t i = 0; i < run.ticks.size(); ++i) {
      seconds.push_back(run.ticks[i][s]);
      whole[i] += run.ticks[i][s];
    }
    print_row(kStageNames[s], std::move(seconds));
  }
  print_row("tick", std::move(whole));
  std::printf("  allocations %zu\n", run.allocations);
  return run.allocations;
}

}  // namespace

int main(int argc, char** argv) {
  double seconds = 20.0;
  int rounds = 5;
  for (int i = 1; i + 1 < argc; ++i) {
    if (!std::strcmp(argv[i], "--seconds")) seconds = std::atof(argv[i + 1]);
    if (!std::strcmp(argv[i], "--rounds")) rounds = std::atoi(argv[i + 1]);
  }
  const int ticks = static_cast<int>(seconds / kDt);
  std::size_t allocated = 0;
  const std::array<std::pair<const char*, double>, 2> reaches = {
      {{"within reach", 0.15}, {"out of reach", 1.0}}};
  for (const auto& [name, radius] : reaches) {
    const double r = radius;
    std::printf("by velocity, hands %s\n", name);
    allocated += print("", least(rounds, [&] { return by_velocity(r, ticks); }));
    std::printf("by acceleration, hands %s\n", name);
    allocated += print("", least(rounds, [&] { return by_acceleration(r, ticks); }));
  }
  return allocated == 0 ? 0 : 1;
}
