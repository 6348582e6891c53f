// A robot that stands on one of its bodies: its free root moves so that this body does not.
//
// Where the root goes: X_WR = X_WS (where the support stood) X_SR (as the joints are now), X_SR by
// the joints between them alone. How it moves: screws.cpp.
#include <mujoco/mujoco.h>

#include <Eigen/Geometry>

#include "hurcules/base/error.hpp"
#include "hurcules/robot/robot.hpp"

namespace hurcules {

void Robot::stand_on(const std::string& body) {
  const Frame frame = this->frame(body);
  require(frame.type == mjOBJ_BODY, "a robot stands on a body; '" + body + "' is none");
  stand_on(frame);
}

void Robot::stand_on(Frame frame) {
  const mjModel& m = *model_;
  require(is_body(frame) && frame.id < m.nbody, "a robot stands on a body of its model");
  const char* const text = mj_id2name(&m, mjOBJ_BODY, frame.id);
  const std::string body = text ? text : "";
  const int root = m.body_rootid[frame.id];
  require(size() > 0 && root == tree_,
          "'" + body + "' belongs to another tree than the coordinates");
  require(!floating_, "a robot whose root is a coordinate stands by its contacts (ContactTask); '" +
                          body + "' cannot hold it");
  require(root_qpos_ >= 0, "a robot stands on a body of a tree with a free joint; '" + body +
                               "' is bolted to the world");
  const bool stood = support_ >= 0;
  support_ = frame.id;
  if (stood) {
    screws_->stand_on(support_);
  } else {
    find_screws();
  }
  read_qpos();
}

void Robot::note_support() {
  if (support_ < 0) return;
  const Skeleton::Pose stands = screws_->pose(support_);
  p_WS_ = stands.p;
  R_WS_ = stands.R;
}

void Robot::keep_support() {
  if (support_ < 0) return;
  const Skeleton::Pose RS = Skeleton::between(*model_, tree_, support_, qpos_.data());
  const Matrix3 R = R_WS_ * RS.R.transpose();
  const Eigen::Quaterniond turn(R);
  qpos_.segment<3>(root_qpos_) = p_WS_ - R * RS.p;
  qpos_.segment<4>(root_qpos_ + 3) << turn.w(), turn.x(), turn.y(), turn.z();
}

}  // namespace hurcules
