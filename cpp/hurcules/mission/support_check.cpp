#include "hurcules/mission/support_check.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "hurcules/base/error.hpp"
#include "hurcules/base/pose.hpp"
#include "hurcules/control/tasks.hpp"
#include "hurcules/mission/posture_way.hpp"
#include "hurcules/sim/support_part.hpp"

namespace hurcules {

namespace {

// The robot from phase to phase on level ground, and which of its coordinates are where it is.
class FollowedPosture {
 public:
  FollowedPosture(const WholeBodyController& controller, const StandingStart& start)
      : controller_(controller),
        robot_(controller.plan().model(), controller.plan().coordinate_names()),
        known_(static_cast<std::size_t>(robot_.size()), true) {
    robot_.set_qpos(start.world.qpos());
    const Vector3 up = up_of_ground(start.plant.model(), start.plant.data(), robot_.root_body());
    const Matrix3 level =
        Eigen::Quaterniond::FromTwoVectors(up, Vector3::UnitZ()).toRotationMatrix();
    turn({Vector3::Zero(), level}, robot_.qpos());
    const std::string stands = start.first.empty() ? controller.plan().support_name() : start.first;
    if (!stands.empty()) robot_.stand_on(stands);
  }

  // From now on. Throws Error where it does not lie on the ground; false: how it lies against what
  // bore the robot until now is not known.
  bool stand_on(const std::string& body, const std::string& where) {
    Matrix turning = Matrix::Zero(3, robot_.size());
    robot_.rotation_jacobian(robot_.frame(body), turning);
    bool sure = true;
    for (Index i = 0; i < robot_.size(); ++i)
      sure = sure && (known_[static_cast<std::size_t>(i)] || turning.col(i).isZero(1e-9));
    const std::string before = robot_.support_name();
    robot_.stand_on(body);
    if (sure) check(body, before, where);
    return sure;
  }

  void check(const std::string& body, const std::string& before, const std::string& where) const {
    const SupportFit fit = support_fit(robot_, body, before, known_);
    if (fit.fits()) return;
    std::string lowest;
    for (const std::string& name : fit.lowest) lowest += (lowest.empty() ? "" : ", ") + name;
    const std::string found = std::isinf(fit.height)
                                  ? std::string("it has no shape that touches anything")
                                  : to_text(fit.height) + " m above the ground, wanted at most " +
                                        to_text(SupportFit::kMost);
    throw Error(where + ": the robot cannot stand on '" + body + "' as it begins: " + found +
                "; on the ground are: " + lowest);
  }

  // what is known when the phase has ended
  void lead(const Phase& phase) {
    const bool open = phase.stack != kJoints && !holds(phase);
    if (open) std::fill(known_.begin(), known_.end(), false);
    for (const Lead& lead : phase.leads) forget(lead);
    if (phase.keys.empty()) return;
    Vector qpos = robot_.qpos();
    for (const PostureKey& key : phase.keys)
      for (const auto& [name, angle] : key.angles)
        phase.stack == kJoints ? place_joints(phase, name, angle, qpos)
                               : place_coordinates(name, angle, open, qpos);
    const Skeleton::Pose stood = robot_.pose(robot_.support());
    robot_.set_qpos(qpos);
    const Skeleton::Pose stands = robot_.pose(robot_.support());
    const Matrix3 back = stood.R * stands.R.transpose();
    turn({stood.p - back * stands.p, back}, qpos);
  }

 private:
  // in its stack nothing moves but what is led: no force, and no task beside a posture that is led
  [[nodiscard]] bool holds(const Phase& phase) const {
    for (const NamedStack& named : controller_.stacks()) {
      if (named.name != phase.stack) continue;
      for (const Task* task : named.stack.tasks()) {
        if (dynamic_cast<const ForceTask*>(task)) return false;
        if (!phase.keys.empty() && !dynamic_cast<const PostureTask*>(task)) return false;
      }
    }
    return true;
  }

  void forget(const Lead& lead) {
    const Channel& channel = *find_channel(controller_, lead.channel, "").channel;
    if (channel.kind() == ChannelKind::Drive || channel.kind() == ChannelKind::Control) return;
    if (channel.task()) std::fill(known_.begin(), known_.end(), false);
    for (const std::string& joint : channel.joint_names()) {
      const Index number = coordinate_of(robot_, actuator(joint)).number;
      if (number >= 0) known_[static_cast<std::size_t>(number)] = false;
    }
  }

  [[nodiscard]] const JointActuator& actuator(const std::string& joint) const {
    return controller_.servo().actuator(controller_.servo().find(joint));
  }

  // one of two joints of a coordinate tells nothing of the other
  void place_joints(const Phase& phase, const std::string& name, double angle, Vector& qpos) {
    const auto& joints = find_channel(controller_, phase.posture, "").channel->joint_names();
    for (const Index at : coordinates_of(name, joints)) {
      const JointActuator& joint = actuator(joints[static_cast<std::size_t>(at)]);
      if (joint.part >= 0) continue;
      qpos[joint.qpos] = angle;
      const Index number = coordinate_of(robot_, joint).number;
      if (number < 0) continue;
      const auto i = static_cast<std::size_t>(number);
      known_[i] = known_[i] || robot_.coordinates()[i].joints.size() == 1;
    }
  }

  void place_coordinates(const std::string& name, double angle, bool open, Vector& qpos) {
    for (const Index at : coordinates_of(name, robot_.coordinate_names())) {
      const auto i = static_cast<std::size_t>(at);
      for (const DrivenJoint& joint : robot_.coordinates()[i].joints)
        if (joint.part < 0) qpos[joint.qpos] = joint.factor * angle + joint.offset;
      known_[i] = !open && robot_.coordinates()[i].joints.front().part < 0;
    }
  }

  // all of the robot by X in W, from this qpos (nq)
  void turn(const Skeleton::Pose& X, Vector qpos) {
    auto root = qpos.segment<7>(robot_.root_qpos());
    const Skeleton::Pose now = X * Skeleton::Pose{root.head<3>(), rotation_of(root.data() + 3)};
    const Eigen::Quaterniond q(now.R);
    root << now.p, q.w(), q.x(), q.y(), q.z();
    robot_.set_qpos(qpos);
  }

  const WholeBodyController& controller_;
  Robot robot_;
  std::vector<bool> known_;  // (n)
};

}  // namespace

void check_supports(const MissionTable& table, const WholeBodyController& controller,
                    const StandingStart& start) {
  const Robot& plan = controller.plan();
  if (plan.root_qpos() < 0 || plan.floating() || plan.closures()) return;
  FollowedPosture posture(controller, start);
  std::string support = start.first;
  const auto bears = [&] {
    return SupportPart(plan, support).bears(start.plant.model(), start.plant.data());
  };
  if (!support.empty() && !bears()) posture.check(support, "", "[mission]");
  const std::vector<std::string> supports = supports_of(table.phases, support);
  // what is only reached by reactions comes from anywhere
  for (std::optional<std::size_t> at = 0; at; at = phase_after(table.phases, *at)) {
    const Phase& phase = table.phases[*at];
    if (supports[*at] != support) {
      support = supports[*at];
      if (!posture.stand_on(support, "phase '" + phase.name + "'")) return;
    }
    posture.lead(phase);
  }
}

}  // namespace hurcules
