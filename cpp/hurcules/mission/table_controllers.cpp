#include "hurcules/mission/table_controllers.hpp"

#include <limits>

#include "hurcules/base/error.hpp"
#include "hurcules/control/tasks.hpp"
#include "hurcules/mission/posture_way.hpp"
#include "hurcules/mission/robot_tables.hpp"
#include "hurcules/robot/joint_actuators.hpp"

namespace hurcules {

namespace {

constexpr double kSpring = 1100.0;  // [N/m] of the elbows' springs at the tips
constexpr const char* kSupport = "lower_leg_L";

// the tasks of a controller on their way to it, in the order of their channels
class Tasks {
 public:
  template <class T, class... Arguments>
  T& add(Arguments&&... arguments) {
    auto task = std::make_unique<T>(std::forward<Arguments>(arguments)...);
    T& made = *task;
    tasks_.push_back(std::move(task));
    return made;
  }

  // a channel each
  [[nodiscard]] std::vector<Channel> channels() const {
    const Vector no_scale = Vector::Constant(1, std::numeric_limits<double>::infinity());
    std::vector<Channel> all;
    for (const auto& task : tasks_) {
      all.emplace_back(task->name(), ChannelKind::Twist, *task, no_scale);
    }
    return all;
  }

  void give_to(WholeBodyController& controller) {
    for (auto& task : tasks_) controller.keep(std::move(task));
  }

 private:
  std::vector<std::unique_ptr<Task>> tasks_;
};

PositionTaskOptions along(Index axes) {
  PositionTaskOptions options;
  options.axes = Matrix3::Identity().topRows(axes);
  return options;
}

ForceTaskOptions press_options(double dt) {
  ForceTaskOptions options;
  options.gains.compliance = 0.05;
  options.gains.dt = dt;
  options.contact.f_max = 1e4;
  options.environment = kSpring;
  return options;
}

// all that have a motor but those whose names end like this
Channel joints_but(const Robot& robot, const std::vector<std::string>& endings) {
  std::vector<std::string> names;
  for (const JointActuator& row : joint_actuators(robot)) {
    bool left_out = false;
    for (const std::string& ending : endings) left_out = left_out || row.joint.ends_with(ending);
    if (!left_out) names.push_back(row.joint);
  }
  return Channel::joints("joints", names, std::numeric_limits<double>::infinity());
}

Channel tracks() {
  return Channel::drive("drive", 1.0, 0.5);
}

WholeBodyControllerOptions options_of(const Robot& robot, const std::string& method) {
  WholeBodyControllerOptions options;
  options.velocity.solver.method = method;
  options.dt = robot.timestep();
  options.drive = TrackDriveOptions{};
  return options;
}

std::shared_ptr<WholeBodyController> make(const Robot& robot, std::vector<NamedStack> stacks,
                                          std::vector<Channel> channels,
                                          std::unique_ptr<JointLimits> limits, Tasks& tasks,
                                          const std::string& method) {
  auto controller = std::make_shared<WholeBodyController>(
      robot, std::move(stacks), std::move(channels), options_of(robot, method));
  controller->keep(std::move(limits));
  tasks.give_to(*controller);
  return controller;
}

std::shared_ptr<WholeBodyController> lift_controller(const ModelPtr& model,
                                                     const std::string& method) {
  Robot robot(model);
  robot.set_keyframe("stretch");
  robot.stand_on(kSupport);
  Vector q = robot.configuration();
  for (const auto& [name, angle] : lift_start()) {
    for (const Index at : coordinates_of(name, robot.coordinate_names())) q[at] = angle;
  }
  robot.set_configuration(q);

  auto limits = std::make_unique<JointLimits>("joint", robot);
  set_ranges(*limits, rescue_ready_ranges());
  Tasks tasks;
  auto& left = tasks.add<PositionTask>("L_hand", robot, "L_tcp");
  auto& right = tasks.add<PositionTask>("R_hand", robot, "R_tcp");
  auto& left_across = tasks.add<PositionTask>("L_across", robot, "L_tcp", along(2));
  auto& right_across = tasks.add<PositionTask>("R_across", robot, "R_tcp", along(2));
  const ForceTaskOptions pressing = press_options(robot.timestep());
  auto& left_press = tasks.add<ForceTask>("L_press", robot, "L_tcp", pressing);
  auto& right_press = tasks.add<ForceTask>("R_press", robot, "R_tcp", pressing);
  auto& left_pitch = tasks.add<AngleTask>("L_pitch", robot, "L_tcp");
  auto& right_pitch = tasks.add<AngleTask>("R_pitch", robot, "R_tcp");
  auto& pelvis = tasks.add<PositionTask>("pelvis", robot, "pelvis", along(1));
  auto& neck = tasks.add<PostureTask>("neck", robot, std::vector<std::string>{"NKY", "NKP"});
  auto& posture = tasks.add<PostureTask>("posture", robot);

  const StackLevel pitch = StackLevel(left_pitch) + right_pitch;
  const StackLevel press = StackLevel(left_across) + right_across + left_press + right_press;
  std::vector<NamedStack> stacks = {
      {"arms", *limits < StackLevel(left) + right < pitch < pelvis < neck},
      {"press", *limits < press < pitch < pelvis < neck},
      {"posture", *limits < posture},
  };
  std::vector<Channel> channels = tasks.channels();
  channels.push_back(tracks());
  channels.push_back(joints_but(robot, {"_belt"}));
  auto controller =
      make(robot, std::move(stacks), std::move(channels), std::move(limits), tasks, method);
  controller->sense(left_press, std::make_unique<SpringForce>(model, "LEBS", "L_tcp"));
  controller->sense(right_press, std::make_unique<SpringForce>(model, "REBS", "R_tcp"));
  return controller;
}

std::shared_ptr<WholeBodyController> disposal_controller(const ModelPtr& model,
                                                         const std::string& method) {
  Robot robot(model);
  robot.set_keyframe("drive");
  auto limits = std::make_unique<JointLimits>("joint", robot);
  Tasks tasks;
  auto& left = tasks.add<PositionTask>("left_hand", robot, "L_tcp");
  auto& right = tasks.add<PositionTask>("right_hand", robot, "R_tcp");
  auto& left_turn = tasks.add<OrientationTask>("left_turn", robot, "L_tcp");
  auto& right_turn = tasks.add<OrientationTask>("right_turn", robot, "R_tcp");
  auto& pelvis = tasks.add<PositionTask>("pelvis", robot, "pelvis", along(1));
  auto& posture = tasks.add<PostureTask>("posture", robot);

  std::vector<NamedStack> stacks = {
      {"hands",
       *limits < StackLevel(left) + right < StackLevel(left_turn) + right_turn < pelvis < posture},
      {"posture", *limits < posture},
  };
  std::vector<Channel> channels = tasks.channels();
  channels.push_back(tracks());
  channels.push_back(joints_but(robot, {"_belt", "_grip_1"}));
  channels.push_back(Channel::joint("left_grip", "L_grip_1", 0.05));
  channels.push_back(Channel::joint("right_grip", "R_grip_1", 0.05));
  return make(robot, std::move(stacks), std::move(channels), std::move(limits), tasks, method);
}

}  // namespace

// tips 5 cm above the ground, 1.80 m ahead of the knee axis, lower arms 0.12 rad below the level;
// the head looks up, or it would meet the person where the trunk leans by more than 1.2 rad
const std::vector<std::pair<std::string, double>>& lift_start() {
  static const std::vector<std::pair<std::string, double>> angles = {
      {"KN", 1.763}, {"HIP", 0.36}, {"NKP", -1.19}, {"SP", 1.9645}, {"EB", 1.2251}};
  return angles;
}

std::shared_ptr<WholeBodyController> table_controller(const std::string& name,
                                                      const ModelPtr& model,
                                                      const std::string& method) {
  if (name == "lift") return lift_controller(model, method);
  if (name == "disposal") return disposal_controller(model, method);
  throw Error(unknown_name("controller of a table", name, {"disposal", "lift"}));
}

}  // namespace hurcules
