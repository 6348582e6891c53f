// Any MJCF robot as the controller sees it: coordinates, frames, Jacobians.
//
// The controller moves n coordinates. A coordinate drives one joint or several together (both knees
// of Hurcules are one); the MJCF names them by tuples `coordinate_NAME` of (joint, factor). Without
// such tuples every hinge, slide or ball joint that has an actuator is a coordinate, and without
// actuators every one; joints that an equality constraint of the model couples
// linearly (the mimic joints of a URDF) are one. Joints that other constraints tie to coordinates
// follow them (closures.hpp), those of other bodies and of the ground too. All other joints are held:
// free, belts, other bodies (left_out.hpp).
// A ball joint is three coordinates, NAME_rx, NAME_ry and NAME_rz: its rotation vector [rad], at most
// pi long. Their velocities [rad/s] and efforts [N m] are MuJoCo's, about the axes of its body, and not
// the derivative of the rotation vector: `add_step` goes from one to the other.
// With `floating` the free joint at the root is six coordinates more, in front: its position in W and
// its rotation vector in W [m], [rad]; their velocities are those of MuJoCo's free joint, [m/s] in W
// and [rad/s] in the axes of the root. Nothing drives them but contacts (contact_task.hpp).
// A Robot has its own mjData: asking it never disturbs a simulation. It keeps scratch memory
// between questions, so one thread asks one Robot.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "hurcules/base/types.hpp"
#include "hurcules/robot/screws.hpp"

struct mjModel_;
struct mjData_;

namespace hurcules {

class Closures;
class Momentum;

using ModelPtr = std::shared_ptr<const mjModel_>;

// Reads an MJCF or MJB file. Throws Error with MuJoCo's text when it cannot be read or compiled, and
// for a URDF, which Python's load_urdf converts with its limits and motors.
[[nodiscard]] ModelPtr load_model(const std::string& path);
// the same from MJCF text; `folder` is where its files are looked for
[[nodiscard]] ModelPtr load_model_text(const std::string& mjcf, const std::string& folder = "");
// a model that somebody else owns and keeps alive
[[nodiscard]] ModelPtr borrow_model(const mjModel_* model);
// throws Error unless the MuJoCo in this process is the one that we were built with
void check_mujoco_version();
[[nodiscard]] std::string mujoco_version();  // "MAJOR.MINOR.PATCH", of that one

// One joint of a coordinate: joint position = factor * coordinate + offset.
struct DrivenJoint {
  int joint = 0;      // mjModel joint id
  int qpos = 0;       // address in qpos; of all parts of a free or a ball joint its first
  int dof = 0;        // address in qvel
  int actuator = -1;  // actuator id, -1 for none
  double factor = 1.0;
  double offset = 0.0;  // [rad] or [m]; 0 for the first joint of a coordinate
  int part = -1;        // 0 to 5 of a free joint, 3 to 5 of a ball joint, else -1
};

struct Coordinate {
  std::string name;
  std::string unit = "rad";         // or "m": of the first joint, a slide
  std::vector<DrivenJoint> joints;  // at least one; the first is the one whose position is read
  double lower = 0.0;  // [rad] or [m], -inf when unlimited; of a ball joint the range of all of it
  double upper = 0.0;  // [rad] or [m]
  double max_velocity = 0.0;  // [rad/s] or [m/s], from numeric velocity_limit_JOINT, else inf
  // [N m] or [N], sum over its actuators by their ranges of force or, of plain motors, of control; inf
  // without any, 0 of a root
  double max_effort = 0.0;
};

// Three coordinates that are the rotation vector of a ball joint or a free root; their velocities are about
// the axes of the body that turns.
struct RotationVector {
  Index first = 0;     // coordinate
  int joint = 0;       // mjModel joint id
  int qpos = 0;        // address of its quaternion
  double range = 0.0;  // [rad] largest angle of a ball joint, inf when unlimited
};

// q (n) a step (n) further: of rotation vectors a turn about the axes of their bodies, q + step elsewhere
void add_step(const std::vector<RotationVector>& rotations, const ConstVectorRef& step,
              VectorRef q);
// q (n) where it turned no ball joint beyond its range, or further out than it was `before` (n)
void hold_ranges(const std::vector<RotationVector>& rotations, const ConstVectorRef& before,
                 VectorRef q);

// A site, body, camera or geom of the model, by number (mjtObj type and id).
struct Frame {
  int type = 0;
  int id = 0;
  friend bool operator==(const Frame&, const Frame&) = default;
};

// Velocity of a frame in W.
struct Twist {
  Vector3 linear = Vector3::Zero();   // [m/s] of its origin
  Vector3 angular = Vector3::Zero();  // [rad/s]
};

// The robot in three numbers: equal for all robots of these coordinates of one compiled model,
// whatever its sizes and masses are changed to.
struct ModelIdentity {
  std::uint64_t structure = 0;  // see structure_of in trees.hpp
  std::uint64_t names = 0;      // a hash, of the coordinates
  Index coordinates = 0;        // n
  friend bool operator==(const ModelIdentity&, const ModelIdentity&) = default;
};

// Dry friction of a joint as its coordinate meets it: nothing at rest, growing up to a speed.
struct DryFriction {
  double most = 0.0;    // [N m], of a slide [N]
  double slides = 1.0;  // [rad/s] from which on it is all of that; MuJoCo's friction creeps below
};

class Robot {
 public:
  // joints: the names of its coordinates (joints or tuples), none for those of the rule above; throws
  // Error for a name that does not exist, and for a robot without a free root that shall float
  explicit Robot(ModelPtr model, const std::vector<std::string>& joints = {},
                 bool floating = false);
  ~Robot();
  Robot(const Robot&) = delete;
  Robot& operator=(const Robot&) = delete;

  [[nodiscard]] const ModelPtr& model() const { return model_; }
  [[nodiscard]] double timestep() const;  // [s] of the model's physics
  // the free joint at the root of the coordinates' tree: its addresses in qpos and qvel, -1 without
  [[nodiscard]] int root_qpos() const { return root_qpos_; }
  [[nodiscard]] int root_dof() const { return root_dof_; }
  [[nodiscard]] int root_body() const { return trees_.front(); }  // of the first coordinate's tree
  // of all trees in which coordinates lie, that one first
  [[nodiscard]] const std::vector<int>& root_bodies() const { return trees_; }
  // the body that stands where it is: that of stand_on, else the root
  [[nodiscard]] Frame support() const;
  [[nodiscard]] std::string support_name() const;  // that of stand_on, "" for the root
  [[nodiscard]] Index size() const { return static_cast<Index>(coordinates_.size()); }  // n
  [[nodiscard]] Index nv() const;           // velocities of the whole model
  [[nodiscard]] Index nu() const;           // its actuators
  [[nodiscard]] Index sensor_rows() const;  // nsensordata
  [[nodiscard]] const std::vector<Coordinate>& coordinates() const { return coordinates_; }
  [[nodiscard]] std::vector<std::string> coordinate_names() const;
  // index of a coordinate; throws Error with the names that exist
  [[nodiscard]] Index coordinate(const std::string& name) const;
  // looks among sites, then bodies, cameras, geoms; throws Error with the names that exist
  [[nodiscard]] Frame frame(const std::string& name) const;
  [[nodiscard]] bool is_body(Frame frame) const;
  // whether some coordinate moves the frame in W
  [[nodiscard]] bool moves(Frame frame) const;
  // whether some coordinate moves the one against the other
  [[nodiscard]] bool moves(Frame first, Frame second) const;
  // what a task remembers to notice that it is asked about another robot
  [[nodiscard]] const ModelIdentity& identity() const { return identity_; }
  // why this robot is not the one that is wanted
  [[nodiscard]] std::string differs(const ModelIdentity& wanted) const;

  // The body that stays where it is when the coordinates move; by default that is the root of its
  // tree. A robot with folding legs stands on those that lie on the ground: then its root, and all
  // above, moves with the knees, and Jacobians, drifts and inertia count that. From one body to
  // another it allocates nothing. Throws Error for a body of another tree, or one without free root.
  void stand_on(const std::string& body);
  void stand_on(Frame body);

  // Configuration: the whole qpos (nq) as sensed, or the coordinates alone (n), all else kept as it
  // is but a root that stands on another body. Each updates every pose and Jacobian.
  void set_qpos(const ConstVectorRef& qpos);
  void set_configuration(const ConstVectorRef& q);
  // [rad/s], (n); used by the drift terms only
  void set_velocity(const ConstVectorRef& velocity);
  // the keyframe of this name, or the model's initial posture for ""
  void set_keyframe(const std::string& name);
  [[nodiscard]] const Vector& configuration() const { return q_; }  // (n)
  [[nodiscard]] const Vector& velocity() const { return v_; }       // (n)
  [[nodiscard]] const Vector& qpos() const { return qpos_; }        // (nq)
  // coordinates (n) out of a whole qpos (nq)
  void coordinates_of(const ConstVectorRef& qpos, VectorRef q) const;
  // their velocities (n) out of a whole qvel (nv)
  void velocities_of(const ConstVectorRef& qvel, VectorRef velocity) const;

  // velocity of a frame for a whole qvel (nv) as sensed, whatever the coordinates do
  [[nodiscard]] Twist twist(Frame frame, const ConstVectorRef& qvel) const;
  [[nodiscard]] Vector3 position(Frame frame) const;     // p_WF [m]
  [[nodiscard]] Matrix3 orientation(Frame frame) const;  // R_WF; a camera looks along its -z
  [[nodiscard]] Skeleton::Pose pose(Frame frame) const;  // both
  // orientation, but a camera looks along its x and z is up in its image
  [[nodiscard]] Matrix3 view_orientation(Frame frame) const;
  // velocity of the frame's origin and angular velocity in W, by the coordinates alone: (3, n) each
  void position_jacobian(Frame frame, MatrixRef J) const;
  void rotation_jacobian(Frame frame, MatrixRef J) const;
  // velocity of a point (W) that is fixed in a body: (3, n)
  void point_jacobian(const Vector3& point, int body, MatrixRef J) const;
  // Jdot v of both, (3): what the frame accelerates with when the coordinates do not
  [[nodiscard]] Vector3 position_drift(Frame frame) const;
  [[nodiscard]] Vector3 rotation_drift(Frame frame) const;
  [[nodiscard]] Vector3 point_drift(const Vector3& point, int body) const;  // of point_jacobian
  // (n) how fast the second point leaves the first along a direction (W), by coordinate
  void separation(const BodyPoint& first, const BodyPoint& second, const Vector3& direction,
                  Eigen::Ref<Eigen::RowVectorXd> row) const;
  // centre of mass of the tree that holds the first coordinate: [m] in W, (3, n), [m/s^2]
  [[nodiscard]] Vector3 com() const;
  void com_jacobian(MatrixRef J) const;
  [[nodiscard]] Vector3 com_drift() const;
  [[nodiscard]] double mass() const;      // [kg] of the same tree
  [[nodiscard]] double weight() const;    // [N], the same
  [[nodiscard]] Vector3 gravity() const;  // [m/s^2] in W
  // angular momentum of the same tree about its centre of mass, in W: L = A v, (3, n) [kg m^2] (hinges),
  // without armature; and dA/dt v [N m]
  void angular_momentum_jacobian(MatrixRef A) const;
  [[nodiscard]] Vector3 angular_momentum_drift() const;
  // inertia of the coordinates with armature, standing as stand_on says: (n, n) [kg m^2] (hinges)
  void mass_matrix(MatrixRef M) const;
  // torque that the coordinates take at this acceleration and the velocity of set_velocity,
  // standing as stand_on says: inertia with armature, gravity, centrifugal and Coriolis terms,
  // springs and dampers of the model; without dry friction and contacts. [rad/s^2] (n) -> [N m] (n)
  void inverse_dynamics(const ConstVectorRef& acceleration, VectorRef torque) const;
  // what the joints of a coordinate have, in the order of their `slides`
  [[nodiscard]] const std::vector<DryFriction>& dry_friction(Index coordinate) const {
    return dry_friction_[static_cast<std::size_t>(coordinate)];
  }
  // the joints that follow the coordinates because loops close, null without
  [[nodiscard]] const Closures* closures() const { return closures_.get(); }
  // its first coordinates are those of the root
  [[nodiscard]] bool floating() const { return floating_; }
  // which coordinates are rotation vectors, in their order
  [[nodiscard]] const std::vector<RotationVector>& rotations() const { return rotations_; }
  [[nodiscard]] Index root_size() const { return floating_ ? 6 : 0; }  // so many
  // its root is free, no coordinate, and stands on nothing: what holds it in the plan, no ground does
  [[nodiscard]] bool floats() const { return root_dof_ >= 0 && support_ < 0 && !floating_; }
  // torque that this acceleration takes by inertia alone when the root gives way to it:
  //   (M_cc - M_cb M_bb^-1 M_bc) a,   b: the root.   [rad/s^2] (n) -> [N m] (n); for one that floats
  void floating_inertia(const ConstVectorRef& acceleration, VectorRef torque) const;

  // memory for the poses of geoms, which no answer here needs: for who looks at geoms (geom_distance.hpp)
  [[nodiscard]] mjData_& geom_poses() const { return *data_; }

 private:
  void find_trees();
  void find_dry_friction(const mjModel_& model);
  void find_rotations();
  void find_screws();   // where another body comes to stand
  void read_qpos();     // all of it, after a change
  void keep_support();  // moves the root so that the support stands where it stood
  void note_support();  // where the support stands
  void note_motion();   // of configuration and velocity
  void note_velocity();
  // what is reckoned when somebody asks: poses and screws of the coordinates; masses; what MuJoCo keeps
  // about the configuration
  [[nodiscard]] const Screws& screws() const;
  [[nodiscard]] const Momentum& momentum() const;
  void need_mujoco() const;
  // each joint that coordinate i moves, by its address in qvel and its velocity at that of 1
  template <class Act>
  void each_dof(Index i, Act&& act) const;

  ModelPtr model_;
  std::unique_ptr<const mjModel_, void (*)(const mjModel_*)> lean_;  // the same without geoms
  std::unique_ptr<mjData_, void (*)(mjData_*)> data_;
  std::unique_ptr<Closures> closures_;
  // what has changed since somebody asked, each with what comes before it
  enum class Stale { Nothing, Velocity, Places, All };
  std::unique_ptr<Screws> screws_;      // of the coordinates
  std::unique_ptr<Momentum> momentum_;  // of their tree
  mutable Stale screws_stale_ = Stale::All, momentum_stale_ = Stale::All;
  std::vector<Coordinate> coordinates_;
  std::vector<RotationVector> rotations_;
  Vector q_, v_, qpos_;
  ModelIdentity identity_;
  std::vector<std::vector<DryFriction>> dry_friction_;  // (n)
  Vector change_;                                       // (n) scratch
  std::vector<int> trees_ = {0};        // bodies at the roots of the coordinates' trees
  int support_ = -1;                    // body that stands, -1 for the root
  int root_qpos_ = -1, root_dof_ = -1;  // of its tree's free joint
  bool floating_ = false;
  Vector3 p_WS_ = Vector3::Zero();  // [m] where the support stands
  Matrix3 R_WS_ = Matrix3::Identity();
  mutable bool fresh_ = false;  // need_mujoco was there
  mutable Matrix inertia_;      // scratch for the mass matrix, (nv, nv)
  mutable Vector column_;       // (nv)
  mutable Vector efforts_;      // scratch for inverse dynamics, (nv)
};

}  // namespace hurcules
