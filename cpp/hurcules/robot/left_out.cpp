#include "hurcules/robot/left_out.hpp"

#include <mujoco/mujoco.h>

#include <vector>

#include "hurcules/robot/closures.hpp"
#include "hurcules/robot/coordinates.hpp"
#include "hurcules/robot/object_names.hpp"
#include "hurcules/robot/trees.hpp"

namespace hurcules {

namespace {

constexpr double kTight = 1e-6;  // of a loop that stays closed

// one without a name by what it ties
std::string constraint_name(const mjModel& m, int equality) {
  std::string name = name_of(m, mjOBJ_EQUALITY, equality);
  if (!name.empty()) return name;
  const bool joints = m.eq_type[equality] == mjEQ_JOINT;
  const bool tendons = m.eq_type[equality] == mjEQ_TENDON;
  const int type = joints ? mjOBJ_JOINT : tendons ? mjOBJ_TENDON : m.eq_objtype[equality];
  const int first = m.eq_obj1id[equality], second = m.eq_obj2id[equality];
  name.append("that of ").append(name_or_number(m, type, first));
  return second < 0 ? name : name.append(" and ").append(name_or_number(m, type, second));
}

class Kept {
 public:
  explicit Kept(const Robot& robot)
      : m_(*robot.model()),
        closures_(robot.closures()),
        robot_(robot),
        joints_(joints_of_coordinates(robot)) {
    for (Index f = 0; closures_ && f < closures_->size(); ++f)
      joints_[static_cast<std::size_t>(m_.dof_jntid[closures_->dof(f)])] = true;
  }

  [[nodiscard]] std::vector<std::string> joints(bool all = true) const {
    std::vector<std::string> names;
    for (int j = 0; j < m_.njnt; ++j) {
      if (m_.jnt_type[j] == mjJNT_FREE || has(j)) continue;
      if (!all && ((m_.jnt_stiffness[j] != 0.0 && !pulled(j)) || carries(j))) continue;
      if (moves(m_.jnt_bodyid[j])) names.push_back(name_or_number(m_, mjOBJ_JOINT, j));
    }
    return names;
  }

  [[nodiscard]] std::vector<std::string> constraints() const {
    std::vector<std::string> names;
    for (int i = 0; i < m_.neq; ++i)
      if (m_.eq_active0[i] && !keeps(i)) names.push_back(constraint_name(m_, i));
    return names;
  }

  // whose limits of length the coordinates do not keep
  [[nodiscard]] std::vector<std::string> tendons() const {
    std::vector<std::string> names;
    for (int t = 0; t < m_.ntendon; ++t)
      if (m_.tendon_limited[t] && turns(t)) names.push_back(name_or_number(m_, mjOBJ_TENDON, t));
    return names;
  }

  // of another robot
  [[nodiscard]] std::vector<std::string> others() const {
    std::vector<std::string> names;
    for (int a = 0; a < m_.nu; ++a) {
      const int joint = m_.actuator_trnid[2 * a];
      if (m_.actuator_trntype[a] != mjTRN_JOINT || has(joint)) continue;
      if (!moves(m_.jnt_bodyid[joint])) names.push_back(name_or_number(m_, mjOBJ_JOINT, joint));
    }
    return names;
  }

 private:
  [[nodiscard]] bool carries(int joint) const {
    for (const CarryingJoint& one : carrying_joints(robot_))
      if (one.dof == m_.jnt_dofadr[joint]) return true;
    return false;
  }
  // an actuator drives it by a fixed tendon
  [[nodiscard]] bool pulled(int joint) const {
    for (int a = 0; a < m_.nu; ++a) {
      if (m_.actuator_trntype[a] != mjTRN_TENDON) continue;
      const int tendon = m_.actuator_trnid[2 * a], first = m_.tendon_adr[tendon];
      for (int w = first; w < first + m_.tendon_num[tendon]; ++w)
        if (m_.wrap_type[w] == mjWRAP_JOINT && m_.wrap_objid[w] == joint) return true;
    }
    return false;
  }
  // a fixed tendon by its joints, a spatial one by the trees that its sites and geoms are on
  [[nodiscard]] bool turns(int tendon) const {
    const int first = m_.tendon_adr[tendon];
    for (int w = first; w < first + m_.tendon_num[tendon]; ++w) {
      const int id = m_.wrap_objid[w];
      switch (m_.wrap_type[w]) {
        case mjWRAP_JOINT:
          if (has(id)) return true;
          break;
        case mjWRAP_SITE:
          if (moves(m_.site_bodyid[id])) return true;
          break;
        case mjWRAP_SPHERE:
        case mjWRAP_CYLINDER:
          if (moves(m_.geom_bodyid[id])) return true;
          break;
        default:
          break;
      }
    }
    return false;
  }
  [[nodiscard]] bool has(int joint) const { return joints_[static_cast<std::size_t>(joint)]; }
  [[nodiscard]] bool moves(int body) const { return in_own_tree(robot_, body); }
  // or it has nothing to do with the coordinates
  [[nodiscard]] bool keeps(int equality) const {
    if (closures_ && closures_->keeps(equality)) return closures_->slack() < kTight;
    const int first = m_.eq_obj1id[equality], second = m_.eq_obj2id[equality];
    switch (m_.eq_type[equality]) {
      case mjEQ_JOINT: {
        if (!has(first) && (second < 0 || !has(second))) return true;  // both are held
        const mjtNum* const c = m_.eq_data + mjNEQDATA * equality;
        return second >= 0 && has(first) && has(second) && c[2] == 0.0 && c[3] == 0.0 &&
               c[4] == 0.0;
      }
      case mjEQ_CONNECT:
      case mjEQ_WELD: {
        const bool sites = m_.eq_objtype[equality] == mjOBJ_SITE;
        const int a = sites ? m_.site_bodyid[first] : first;
        const int b = sites ? m_.site_bodyid[second] : second;
        return !moves(a) && !moves(b);
      }
      default:
        return m_.eq_type[equality] != mjEQ_TENDON;
    }
  }

  const mjModel& m_;
  const Closures* closures_;
  const Robot& robot_;
  std::vector<bool> joints_;
};

}  // namespace

std::vector<std::string> unkept_constraints(const Robot& robot) {
  if (names_coordinates(*robot.model())) return {};
  return Kept(robot).constraints();
}

std::vector<std::string> unkept_tendon_limits(const Robot& robot) {
  return Kept(robot).tendons();
}

std::string held_joints(const Robot& robot) {
  if (names_coordinates(*robot.model())) return "";
  const std::vector<std::string> joints = Kept(robot).joints(false);
  if (joints.empty()) return "";
  return "joints that no actuator of their own drives are held: " + listed(joints) +
         "; Robot(model, joints=[...]) says which move, and silences this";
}

std::string left_out(const Robot& robot) {
  const Kept kept(robot);
  if (names_coordinates(*robot.model())) {
    const std::vector<std::string> others = kept.others();
    if (others.empty()) return "";
    return std::to_string(others.size()) +
           " joints with actuators stand beside the robot that the " +
           "model's coordinates are of: " + listed(others) +
           "; Robot(model, joints=[...]) is a robot of these";
  }
  const std::vector<std::string> joints = kept.joints(), constraints = unkept_constraints(robot);
  std::string text;
  if (!joints.empty()) {
    text = std::to_string(joints.size()) + " joints of the robot are held, they belong to no " +
           "coordinate: " + listed(joints) + "; Robot(model, joints=[...]) says which move";
  }
  if (!constraints.empty()) {
    text += std::string(text.empty() ? "" : ". ") +
            "Constraints of the model that the coordinates do not keep: " + listed(constraints) +
            "; where joints=[...] names as many as they leave free, the others follow";
  }
  if (const std::vector<std::string> tendons = unkept_tendon_limits(robot); !tendons.empty()) {
    text += std::string(text.empty() ? "" : ". ") +
            "Tendons whose limits of length are not kept: " + listed(tendons);
  }
  return text;
}

}  // namespace hurcules
