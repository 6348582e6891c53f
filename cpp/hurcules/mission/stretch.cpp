#include "hurcules/mission/stretch.hpp"

#include <algorithm>
#include <cmath>

namespace hurcules {

namespace {

constexpr double kSettleSeconds = 2.0;    // [s] the brakes open, the robot finds its rest
constexpr double kHoldSeconds = 2.0;      // [s]
constexpr double kStretchSpeed = 0.0215;  // [m/s] the operator's button; sets the thesis' times
// of the joints' speed limits that is commanded: a servo overshoots a speed by up to 7 %
constexpr double kSpeedShare = 0.9;
constexpr double kStretchLength = 0.875;  // [m] where the pelvis has given way by 0.40 m

// first command of each, in the order of make_channels
enum : Index { kLeft = 0, kRight = 3, kLeftPitch = 6, kRightPitch = 7, kPelvis = 8, kGaze = 9 };

std::vector<Channel> make_channels() {
  const double hand = 2.0 * kStretchSpeed;  // [m/s] the operator's speed is half of full scale
  const double angle = 0.1;                 // [rad/s]
  return {{"left_hand_x", hand},  {"left_hand_y", hand},  {"left_hand_z", hand},
          {"right_hand_x", hand}, {"right_hand_y", hand}, {"right_hand_z", hand},
          {"left_pitch", angle},  {"right_pitch", angle}, {"pelvis_x", hand},
          {"gaze_yaw", angle},    {"gaze_pitch", angle}};
}

PositionTaskOptions along_x() {
  PositionTaskOptions options;
  options.axes = Matrix3::Identity().topRows(1);
  return options;
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
  setup.max_tilt = 0.35;     // the rear edge is the first to tip over, at 0.38 (22 degrees)
  setup.servo = rescue_servo();
  return setup;
}

Stretch::Stretch(const Robot& plan)
    : Mission(setup_of()),
      joint_("joint", plan),
      left_hand_("lhpos", plan, "L_tcp"),
      right_hand_("rhpos", plan, "R_tcp"),
      left_pitch_("lhpitch", plan, "L_tcp"),
      right_pitch_("rhpitch", plan, "R_tcp"),
      pelvis_("pel", plan, "pelvis", along_x()),
      gaze_("gaze", plan, "gaze"),
      story_(plan, figures_) {
  set_ranges(joint_, rescue_ready_ranges());
  for (const Coordinate& coordinate : plan.coordinates()) {
    joint_.set_max_velocity(coordinate.name, kSpeedShare * coordinate.max_velocity);
  }
  const StackLevel hpos("hpos", {&left_hand_, &right_hand_});
  const StackLevel hpitch("hpitch", {&left_pitch_, &right_pitch_});
  const Stack stack = joint_ < hpos < hpitch < pelvis_ < gaze_;  // [T §4.4]

  const auto after = [](double seconds) {
    return [seconds](double elapsed) { return elapsed >= seconds; };
  };
  const auto begin = [this](const Robot&, double time) { story_.start(time); };
  const auto stretch = [this](VectorRef command, double dt) { operate(command, dt); };
  const auto stretched = [this](double) { return stretched_ >= kStretchLength; };
  phases_ = {{"settle", stack, {}, {}, after(kSettleSeconds)},
             {"stretch", stack, begin, stretch, stretched},
             {"hold", stack, {}, {}, after(kHoldSeconds)}};
  channels_ = make_channels();
  tasks_ = {&joint_, &left_hand_, &right_hand_, &left_pitch_, &right_pitch_, &pelvis_, &gaze_};
}

void Stretch::start(const Robot& plan, const Robot& world) {
  for (Task* task : tasks_) task->hold(plan);
  // where the arms will go under; the chest lies so far away that the neck would meet its stop
  gaze_.set_target(world.position(world.frame("casualty_near_side")));
  stretched_ = 0.0;
  story_.reset();
}

void Stretch::operate(VectorRef command, double dt) const {
  // the last tick gives what is left
  const double left = kStretchLength - stretched_;
  command[kLeft] = command[kRight] = std::min(kStretchSpeed, left / dt);
}

void Stretch::move_targets(const Robot& plan, const ConstVectorRef& command, double dt) {
  left_hand_.advance(command.segment(kLeft, 3), dt);
  right_hand_.advance(command.segment(kRight, 3), dt);
  left_pitch_.advance(command.segment(kLeftPitch, 1), dt);
  right_pitch_.advance(command.segment(kRightPitch, 1), dt);
  pelvis_.advance(command.segment(kPelvis, 1), dt);
  // its target turns about the camera as commanded, whatever was measured last
  gaze_.update(plan);
  gaze_.advance(command.segment(kGaze, 2), dt);
  stretched_ += 0.5 * (command[kLeft] + command[kRight]) * dt;
}

StretchErrors Stretch::errors() const {
  StretchErrors errors;
  errors.hand = std::max(left_hand_.error().norm(), right_hand_.error().norm());
  errors.pitch = std::max(std::abs(left_pitch_.error()[0]), std::abs(right_pitch_.error()[0]));
  errors.pelvis = std::abs(pelvis_.error()[0]);
  errors.gaze = gaze_.error().norm();
  return errors;
}

void Stretch::note_commanded(const TickReport& report) {
  story_.note_stretched(stretched_);
  if (phase() > 0) story_.note_commanded(report, errors());
}

void Stretch::note_measured(const TickReport& report) {
  if (phase() > 0) story_.note_measured(report, errors());
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
