// The simulated world: MuJoCo's model and data, the tracks, the brakes, the drive trains, the limits
// of its motors, and a look at whether it still makes sense.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "hurcules/base/state.hpp"
#include "hurcules/control/joint_servo.hpp"
#include "hurcules/robot/robot.hpp"
#include "hurcules/sim/step.hpp"

namespace hurcules {

class Plant {
 public:
  // with data of its own, or with somebody else's, who keeps it alive
  explicit Plant(ModelPtr model, mjData_* borrowed = nullptr);

  // index of the first keyframe whose name contains this text; throws Error with the names that
  // exist
  [[nodiscard]] int find_keyframe(const std::string& text) const;
  [[nodiscard]] Vector keyframe_qpos(int keyframe) const;  // (nq)
  // address in qpos of the first free joint outside the tree of this root body, -1 for none
  [[nodiscard]] int other_free_joint(int root) const;
  // everything at rest in a keyframe (-1: the model's initial posture), brakes open, time zero
  void reset(int keyframe);
  // everything at this configuration (nq); poses of bodies and sites follow
  void place(const Vector& qpos);
  // turns sprung hinges without a motor to where they bear what hangs on them
  void load_springs();
  // contacts and sensors as they are now, all motors off; the next step has the same bits
  void feel();
  // everything moves to this configuration (nq) within dt [s], whatever the physics would say
  void move(const Vector& qpos, double dt);
  // poses, and sensors that tell of poses, as they are now; contacts and forces stay as they were
  void see();
  // what the drives can do at the present speeds; valid until the next call, (nu)
  const std::vector<ActuatorStatus>& actuators();
  // n steps, fewer when it ceases to be sound; MuJoCo's sensors are read in the last alone. Returns
  // how many it took.
  int step(int n = 1);
  // a force [N] in the world at the centre of mass of a body, from now on; zero ends it
  void push(int body, const Vector3& force);
  // false once a position, a velocity or an acceleration was not finite or huge; such a state is
  // never stepped again
  [[nodiscard]] bool is_sound() const { return sound_; }
  // looks again, after somebody else wrote to the data
  bool check();

  [[nodiscard]] const mjModel_* model() const { return model_.get(); }
  [[nodiscard]] const ModelPtr& model_ptr() const { return model_; }
  [[nodiscard]] mjData_* data() { return data_.get(); }
  [[nodiscard]] const mjData_* data() const { return data_.get(); }
  [[nodiscard]] const Tracks& tracks() const { return tracks_; }
  [[nodiscard]] Brakes& brakes() { return brakes_; }
  [[nodiscard]] const Brakes& brakes() const { return brakes_; }
  [[nodiscard]] const DriveTrain& drive_train() const { return drive_train_; }
  [[nodiscard]] double dt() const;                      // [s]
  [[nodiscard]] Eigen::Map<Vector> qpos();              // (nq)
  [[nodiscard]] Eigen::Map<const Vector> qpos() const;  // (nq)
  [[nodiscard]] Eigen::Map<const Vector> qvel() const;  // (nv)

  // MuJoCo's whole integration state, brakes and gears
  void save(StateWriter& writer) const;
  void restore(StateReader& reader);

 private:
  [[nodiscard]] bool looks_sound() const;

  ModelPtr model_;
  std::unique_ptr<mjData_, void (*)(mjData_*)> data_;
  Tracks tracks_;
  Brakes brakes_;
  DriveTrain drive_train_;
  struct Motor {
    int actuator = 0, dof = 0;
    MotorLimits limits;
  };
  std::vector<Motor> motors_;
  std::vector<ActuatorStatus> actuators_;  // (nu)
  bool sound_ = true;
  mutable Vector state_;  // scratch, mjSTATE_INTEGRATION
  Vector scratch_;        // (nv)
};

}  // namespace hurcules
