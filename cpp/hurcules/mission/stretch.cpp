#include "hurcules/mission/stretch.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace hurcules {

namespace {

constexpr double kSettleSeconds = 2.0;    // [s] the brakes open, the robot finds its rest
constexpr double kHoldSeconds = 2.0;      // [s]
constexpr double kStretchSpeed = 0.0215;  // [m/s] the operator's button; sets the thesis' times
// of the joints' speed limits that is commanded: a servo overshoots a speed by up to 7 %
constexpr double kSpeedShare = 0.9;
constexpr double kStretchLength = 0.875;  // [m] where the pelvis has given way by 0.40 m

// the phases
enum : std::size_t { kSettle, kStretch, kHold };
// first command of each, in the order of the channels
enum : Index { kLeft = 0, kRight = 3 };
// the tasks, in the order of the stack
enum : std::size_t { kLeftHand, kRightHand, kLeftPitch, kRightPitch, kPelvis, kGaze };

PositionTaskOptions along_x() {
  PositionTaskOptions options;
  options.axes = Matrix3::Identity().topRows(1);
  return options;
}

StretchErrors errors_of(const TickReport& report) {
  const auto error = [&](std::size_t task) -> const Vector& { return report.tasks[task]->error(); };
  StretchErrors errors;
  errors.hand = std::max(error(kLeftHand).norm(), error(kRightHand).norm());
  errors.pitch = std::max(std::abs(error(kLeftPitch)[0]), std::abs(error(kRightPitch)[0]));
  errors.pelvis = std::abs(error(kPelvis)[0]);
  errors.gaze = error(kGaze).norm();
  return errors;
}

}  // namespace

MissionSetup Stretch::setup_of() {
  MissionSetup setup;
  setup.name = "stretch";
  setup.scene = "scenes/stretch.xml";
  setup.keyframe = "stretch";
  setup.support = "lower_leg_L";
  setup.max_seconds = 90.0;  // twice what the operator takes: a policy may be slower
  setup.min_height = 0.15;   // the stretch ends with the pelvis 0.35 above the knees
  setup.fall_frame = "pelvis";
  setup.max_tilt = 0.35;  // the rear edge is the first to tip over, at 0.38 (22 degrees)
  return setup;
}

std::shared_ptr<WholeBodyController> Stretch::make_controller(const Robot& robot,
                                                              const MissionOptions& options) {
  auto joint = std::make_unique<JointLimits>("joint", robot);
  set_ranges(*joint, rescue_ready_ranges());
  for (const Coordinate& coordinate : robot.coordinates()) {
    joint->set_max_velocity(coordinate.name, kSpeedShare * coordinate.max_velocity);
  }
  auto left_hand = std::make_unique<PositionTask>("lhpos", robot, "L_tcp");
  auto right_hand = std::make_unique<PositionTask>("rhpos", robot, "R_tcp");
  auto left_pitch = std::make_unique<AngleTask>("lhpitch", robot, "L_tcp");
  auto right_pitch = std::make_unique<AngleTask>("rhpitch", robot, "R_tcp");
  auto pelvis = std::make_unique<PositionTask>("pel", robot, "pelvis", along_x());
  auto gaze = std::make_unique<GazeTask>("gaze", robot, "gaze");
  const StackLevel hpos("hpos", {left_hand.get(), right_hand.get()});
  const StackLevel hpitch("hpitch", {left_pitch.get(), right_pitch.get()});
  const Stack stack = *joint < hpos < hpitch < *pelvis < *gaze;  // [T §4.4]

  const Vector hand = Vector::Constant(1, 2.0 * kStretchSpeed);  // the operator's is half of it
  const Vector angle = Vector::Constant(1, 0.1);                 // [rad/s]
  constexpr auto kTwist = ChannelKind::Twist;
  std::vector<Channel> channels = {
      {"left_hand", kTwist, *left_hand, hand},    {"right_hand", kTwist, *right_hand, hand},
      {"left_pitch", kTwist, *left_pitch, angle}, {"right_pitch", kTwist, *right_pitch, angle},
      {"pelvis_x", kTwist, *pelvis, hand},        {"gaze", kTwist, *gaze, angle, {"yaw", "pitch"}}};
  WholeBodyControllerOptions whole;
  whole.velocity.law = Law::Thesis;  // the mission shows the thesis' figures
  whole.velocity.solver.method = options.method;
  whole.velocity.solver.handover = Handover::Smooth;
  whole.support = setup_of().support;
  whole.base = options.base;
  whole.feed_forward = false;  // the thesis' servos know no model
  auto controller = std::make_shared<WholeBodyController>(
      robot, std::vector<NamedStack>{{"stretch", stack}}, std::move(channels), std::move(whole));
  controller->keep(std::move(joint));
  controller->keep(std::move(left_hand));
  controller->keep(std::move(right_hand));
  controller->keep(std::move(left_pitch));
  controller->keep(std::move(right_pitch));
  controller->keep(std::move(pelvis));
  controller->keep(std::move(gaze));
  return controller;
}

MissionTable Stretch::table_of() {
  const Lead left{"left_hand", Vector3(kStretchSpeed, 0.0, 0.0), kStretchLength};
  const Lead right{"right_hand", Vector3(kStretchSpeed, 0.0, 0.0), kStretchLength};
  MissionTable table;
  table.phases.resize(3);
  table.phases[kSettle] = {.name = "settle",
                           .stack = "stretch",
                           .seconds = kSettleSeconds,
                           .note = "the brakes open, the robot finds its rest"};
  table.phases[kStretch] = {
      .name = "stretch",
      .stack = "stretch",
      .leads = {left, right},
      .note = "both hands go forward along a line; what comes after them gives way"};
  table.phases[kHold] = {.name = "hold",
                         .stack = "stretch",
                         .seconds = kHoldSeconds,
                         .note = "the hands stay where they are"};
  return table;
}

Stretch::Stretch(WholeBodyController& controller, double variation)
    : Mission(setup_of(), table_of(), controller, variation), story_(controller.plan(), figures_) {}

std::unique_ptr<Supervisor> Stretch::clone(WholeBodyController& controller) const {
  return std::make_unique<Stretch>(controller, variation());
}

void Stretch::begin(WholeBodyController& controller, const Robot& world) {
  // where the arms will go under; the chest lies so far away that the neck would meet its stop
  auto& gaze = static_cast<GazeTask&>(controller.task("gaze"));
  gaze.set_target(world.position(world.frame("casualty_near_side")));
  stretched_ = 0.0;
  story_.reset();
}

void Stretch::entered(double time) {
  if (phase() == kStretch) story_.start(time);
}

void Stretch::commanded(const WholeBodyController& controller, const TickReport& report) {
  const Vector& command = controller.command();
  stretched_ += 0.5 * (command[kLeft] + command[kRight]) * controller.dt();
  story_.note_stretched(stretched_);
  if (phase() > kSettle) story_.note_commanded(report, errors_of(report));
}

void Stretch::measured(const TickReport& report) {
  if (phase() > kSettle) story_.note_measured(report, errors_of(report));
}

void Stretch::save_memory(StateWriter& writer) const {
  writer.put(stretched_);
  story_.save(writer);
}

void Stretch::restore_memory(StateReader& reader) {
  stretched_ = reader.get();
  story_.restore(reader);
}

}  // namespace hurcules
