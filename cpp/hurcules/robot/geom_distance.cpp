#include "hurcules/robot/geom_distance.hpp"

#include <mujoco/mujoco.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "hurcules/base/error.hpp"

namespace hurcules {

namespace {

std::vector<int> geoms_of(const Robot& robot, const std::string& name) {
  const mjModel& m = *robot.model();
  const int geom = mj_name2id(&m, mjOBJ_GEOM, name.c_str());
  if (geom >= 0) return {geom};
  const Frame body = robot.frame(name);
  require(body.type == mjOBJ_BODY, "a distance wants bodies or geoms; '" + name + "' is neither");
  std::vector<int> found;
  for (int i = 0; i < m.ngeom; ++i) {
    const bool touches = m.geom_contype[i] != 0 || m.geom_conaffinity[i] != 0;
    if (m.geom_bodyid[i] == body.id && touches) found.push_back(i);
  }
  require(!found.empty(), "body '" + name + "' has no geom that can touch anything");
  return found;
}

}  // namespace

GeomDistance::GeomDistance(const GeomDistance& other)
    : model_(other.model_),
      data_(mj_makeData(model_.get()), mj_deleteData),
      pairs_(other.pairs_),
      most_(other.most_),
      linear_(other.linear_),
      angular_(other.angular_) {
  require(data_ != nullptr, "MuJoCo has no memory for this model");
}

GeomDistance::GeomDistance(const Robot& robot,
                           const std::vector<std::pair<std::string, std::string>>& pairs,
                           double most)
    : model_(robot.model()),
      data_(mj_makeData(model_.get()), mj_deleteData),
      most_(most),
      linear_(Matrix::Zero(3, robot.size())),
      angular_(Matrix::Zero(3, robot.size())) {
  require(data_ != nullptr, "MuJoCo has no memory for this model");
  require(std::isfinite(most) && most > 0.0, "the largest distance wants a positive number [m]");
  for (const auto& [first, second] : pairs)
    pairs_.push_back({geoms_of(robot, first), geoms_of(robot, second)});
}

GeomDistance::Nearest GeomDistance::nearest(const Pair& pair) const {
  Nearest found;
  found.distance = most_;
  for (const int first : pair.first) {
    for (const int second : pair.second) {
      Points points{};
      const double distance =
          mj_geomDistance(model_.get(), data_.get(), first, second, found.distance, points.data());
      if (distance < found.distance) found = {distance, first, second, points};
    }
  }
  return found;
}

void GeomDistance::measure(const Robot& robot, VectorRef distance, MatrixRef gradient) {
  std::copy(robot.qpos().begin(), robot.qpos().end(), data_->qpos);
  mj_kinematics(model_.get(), data_.get());
  gradient.setZero();
  for (Index i = 0; i < size(); ++i) {
    const Nearest found = nearest(pairs_[static_cast<std::size_t>(i)]);
    distance[i] = found.distance;
    const double* const p = found.points.data();
    const Vector3 apart(p[3] - p[0], p[4] - p[1], p[5] - p[2]);
    // touching, the direction is lost: the row fades for the one configuration
    if (found.distance >= most_ || apart.norm() < 1e-9) continue;
    const Vector3 direction = apart / found.distance;  // also from inside: turned round
    add(robot, found.second, p + 3, direction, gradient.row(i));
    add(robot, found.first, p, -direction, gradient.row(i));
  }
}

void GeomDistance::add(const Robot& robot, int geom, const double* point, const Vector3& direction,
                       Eigen::Ref<Eigen::RowVectorXd> gradient) {
  const Frame body{mjOBJ_BODY, model_->geom_bodyid[geom]};
  if (body.id == 0) return;
  robot.position_jacobian(body, linear_);
  robot.rotation_jacobian(body, angular_);
  const Vector3 arm = Vector3(point[0], point[1], point[2]) - robot.position(body);
  const Vector3 turn = arm.cross(direction);
  for (Index k = 0; k < gradient.size(); ++k)
    gradient[k] += direction.dot(linear_.col(k)) + turn.dot(angular_.col(k));
}

}  // namespace hurcules
