#include "hurcules/sim/support_part.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "hurcules/robot/object_names.hpp"
#include "hurcules/robot/trees.hpp"
#include "hurcules/sim/readings.hpp"

namespace hurcules {

namespace {

bool can_touch(const mjModel& m, int geom) {
  return m.geom_contype[geom] != 0 || m.geom_conaffinity[geom] != 0;
}

// [m] how far a geom reaches below its centre; down in its own axes, (3) of length 1
double reach_of(const mjModel& m, int geom, const Vector3& down) {
  const Vector3 size = vector_at(m.geom_size, geom), along = down.cwiseAbs();
  switch (m.geom_type[geom]) {
    case mjGEOM_SPHERE:
      return size[0];
    case mjGEOM_CAPSULE:
      return size[0] + size[1] * along.z();
    case mjGEOM_CYLINDER:
      return size[0] * along.head<2>().norm() + size[1] * along.z();
    case mjGEOM_ELLIPSOID:
      return size.cwiseProduct(down).norm();
    case mjGEOM_BOX:
      return size.dot(along);
    case mjGEOM_MESH: {
      const int mesh = m.geom_dataid[geom];
      const Eigen::Map<const Eigen::Matrix3Xf> vertices(m.mesh_vert + 3 * m.mesh_vertadr[mesh], 3,
                                                        m.mesh_vertnum[mesh]);
      return (down.cast<float>().transpose() * vertices).maxCoeff();
    }
    default:
      return -std::numeric_limits<double>::infinity();
  }
}

// [m] of the lowest point of a body's own shapes, in W; inf: it has none
double lowest_of(const Robot& robot, int body) {
  const mjModel& m = *robot.model();
  double lowest = std::numeric_limits<double>::infinity();
  for (int i = m.body_geomadr[body]; i < m.body_geomadr[body] + m.body_geomnum[body]; ++i) {
    if (!can_touch(m, i)) continue;
    const Skeleton::Pose pose = robot.pose({mjOBJ_GEOM, i});
    lowest = std::min(lowest, pose.p.z() - reach_of(m, i, -pose.R.row(2).transpose()));
  }
  return lowest;
}

// some coordinate whose place is not known moves the body against what the robot stands on
bool is_unknown(const Robot& robot, int body, const std::vector<bool>& known) {
  Matrix linear = Matrix::Zero(3, robot.size()), angular = linear;
  robot.position_jacobian({mjOBJ_BODY, body}, linear);
  robot.rotation_jacobian({mjOBJ_BODY, body}, angular);
  for (Index i = 0; i < robot.size(); ++i)
    if (!known[static_cast<std::size_t>(i)] &&
        !(linear.col(i).isZero(1e-9) && angular.col(i).isZero(1e-9)))
      return true;
  return false;
}

}  // namespace

SupportPart::SupportPart(const Robot& robot, const std::string& body)
    : root_(robot.root_body()), own_(static_cast<std::size_t>(robot.model()->nbody), false) {
  const mjModel& m = *robot.model();
  const Frame support{mjOBJ_BODY, find_body(&m, body, "support")};
  for (int i = 1; i < m.nbody; ++i)
    own_[static_cast<std::size_t>(i)] =
        in_own_tree(robot, i) && !robot.moves(support, {mjOBJ_BODY, i});
}

bool SupportPart::bears(const mjModel* m, const mjData* d) const {
  for (int i = 0; i < d->ncon; ++i) {
    const mjContact& contact = d->contact[i];
    if (contact.efc_address < 0 || contact.geom[0] < 0 || contact.geom[1] < 0) continue;
    const int body[2] = {m->geom_bodyid[contact.geom[0]], m->geom_bodyid[contact.geom[1]]};
    const bool first = m->body_rootid[body[0]] == root_;
    if (first == (m->body_rootid[body[1]] == root_) || !has(body[first ? 0 : 1])) continue;
    if (contact_force(m, d, i).normal > 0.0) return true;
  }
  return false;
}

SupportFit support_fit(const Robot& robot, const std::string& body, const std::string& before,
                       const std::vector<bool>& known) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const mjModel& m = *robot.model();
  const SupportPart part(robot, body);
  const std::optional<SupportPart> bore =
      before.empty() ? std::nullopt : std::optional<SupportPart>(std::in_place, robot, before);
  std::vector<std::pair<double, std::string>> heights;
  double own = kNone, ground = kNone;
  for (int i = 1; i < m.nbody; ++i) {
    if (!in_own_tree(robot, i) || m.body_geomnum[i] == 0) continue;
    if (!part.has(i) && is_unknown(robot, i, known)) continue;
    const double height = lowest_of(robot, i);
    if (std::isinf(height)) continue;
    if (part.has(i)) own = std::min(own, height);
    if (!bore || bore->has(i)) ground = std::min(ground, height);
    heights.emplace_back(height, name_of(m, mjOBJ_BODY, i));
  }
  SupportFit fit;
  if (std::isinf(ground)) return fit;
  fit.height = own - ground;
  for (const auto& [height, name] : heights)
    if (!name.empty() && std::abs(height - ground) <= SupportFit::kMost) fit.lowest.push_back(name);
  return fit;
}

Vector3 up_of_ground(const mjModel* m, const mjData* d, int root) {
  constexpr double kSteepest = 0.5;  // cosine from against gravity; what is steeper is a wall
  const Vector3 against = -vector_at(m->opt.gravity, 0);
  Vector3 sum = Vector3::Zero();
  for (int i = 0; i < d->ncon; ++i) {
    const mjContact& contact = d->contact[i];
    if (contact.geom[0] < 0 || contact.geom[1] < 0) continue;
    const int body[2] = {m->geom_bodyid[contact.geom[0]], m->geom_bodyid[contact.geom[1]]};
    for (const int side : {0, 1}) {
      if (m->body_rootid[body[side]] != root || m->body_weldid[body[1 - side]] != 0) continue;
      const Vector3 normal = (side == 1 ? 1.0 : -1.0) * vector_at(contact.frame, 0);
      if (normal.dot(against) >= kSteepest * against.norm()) sum += normal;
    }
  }
  if (sum.norm() < 1e-9) sum = against;
  return sum.norm() < 1e-9 ? Vector3(Vector3::UnitZ()) : Vector3(sum.normalized());
}

}  // namespace hurcules
