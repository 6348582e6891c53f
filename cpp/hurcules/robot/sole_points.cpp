#include "hurcules/robot/sole_points.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>

#include "hurcules/base/error.hpp"
#include "hurcules/robot/object_names.hpp"
#include "hurcules/robot/trees.hpp"

namespace hurcules {

namespace {

constexpr double kLevel = 0.003;  // [m] above the lowest point that still counts
constexpr double kSole = 0.05;    // [m] a round foot is shorter, and stands on a point
constexpr double kApart = 0.005;  // [m] nearer points are one
constexpr int kRim = 8;           // points round a cylinder

using Points = std::vector<Vector3>;

// of a geom in its own frame that may be its lowest; `down` in that frame
Points extremes(const mjModel& m, int geom, const Vector3& down) {
  const double* const size = m.geom_size + 3 * geom;
  const Vector3 half(size[0], size[1], size[2]);
  Points points;
  switch (m.geom_type[geom]) {
    case mjGEOM_SPHERE:
      return {size[0] * down};
    case mjGEOM_CAPSULE:
      for (const double end : {-size[1], size[1]})
        points.push_back(end * Vector3::UnitZ() + size[0] * down);
      return points;
    case mjGEOM_ELLIPSOID: {
      const Vector3 squares = half.cwiseAbs2();
      return {squares.cwiseProduct(down) / half.cwiseProduct(down).norm()};
    }
    case mjGEOM_CYLINDER:
      for (const double end : {-size[1], size[1]})
        for (int i = 0; i < kRim; ++i) {
          const double angle = 2.0 * M_PI * i / kRim;
          points.emplace_back(size[0] * std::cos(angle), size[0] * std::sin(angle), end);
        }
      return points;
    case mjGEOM_BOX:
      for (int corner = 0; corner < 8; ++corner)
        points.emplace_back((corner & 1) != 0 ? half[0] : -half[0],
                            (corner & 2) != 0 ? half[1] : -half[1],
                            (corner & 4) != 0 ? half[2] : -half[2]);
      return points;
    case mjGEOM_MESH: {
      const int mesh = m.geom_dataid[geom];
      const float* const vertices = m.mesh_vert + 3 * m.mesh_vertadr[mesh];
      for (int i = 0; i < m.mesh_vertnum[mesh]; ++i)
        points.emplace_back(vertices[3 * i], vertices[3 * i + 1], vertices[3 * i + 2]);
      return points;
    }
    default:
      return {};
  }
}

// in W
Points candidates(const Robot& robot, int body) {
  const mjModel& m = *robot.model();
  Points points;
  for (int geom = 0; geom < m.ngeom; ++geom) {
    if (m.body_weldid[m.geom_bodyid[geom]] != m.body_weldid[body]) continue;
    if (m.geom_contype[geom] == 0 && m.geom_conaffinity[geom] == 0) continue;
    const Skeleton::Pose pose = robot.pose({mjOBJ_GEOM, geom});
    for (const Vector3& point : extremes(m, geom, -pose.R.row(2).transpose()))
      points.push_back(pose.p + pose.R * point);
  }
  return points;
}

const Vector3& furthest(const Points& points, const Vector3& direction) {
  return *std::max_element(points.begin(), points.end(), [&](const Vector3& a, const Vector3& b) {
    return a.dot(direction) < b.dot(direction);
  });
}

Vector3 level(const Vector3& way) {
  return {way.x(), way.y(), 0.0};
}

// the horizontal way between the two that are furthest apart, from one of the outermost
Vector3 longest(const Points& points) {
  Vector3 best = Vector3::Zero();
  for (const Vector3& from :
       {furthest(points, Vector3(1, 0, 0)), furthest(points, Vector3(0, 1, 0)),
        furthest(points, Vector3(1, 1, 0)), furthest(points, Vector3(1, -1, 0))})
    for (const Vector3& to : points)
      if (level(to - from).norm() > best.norm()) best = level(to - from);
  return best;
}

}  // namespace

std::vector<Vector3> sole_points(const Robot& robot, const std::string& body) {
  const Frame frame = robot.frame(body);
  const mjModel& m = *robot.model();
  require(robot.is_body(frame), "a foot wants a body, '" + body + "' is on '" +
                                    name_or_number(m, mjOBJ_BODY, body_of(m, frame)) + "'");
  Points points = candidates(robot, frame.id);
  require(!points.empty(), "body '" + body +
                               "' has no collision geoms that could stand on "
                               "something; say its points");
  const Skeleton::Pose pose = robot.pose(frame);
  const Vector3 lowest = furthest(points, -Vector3::UnitZ());
  std::erase_if(points, [&](const Vector3& point) { return point.z() > lowest.z() + kLevel; });
  const Vector3 along = longest(points), across(-along.y(), along.x(), 0.0);
  if (along.norm() < kSole) return {pose.R.transpose() * (lowest - pose.p)};
  Points outermost;
  for (const Vector3& direction : {along, across, Vector3(-along), Vector3(-across)}) {
    const Vector3 point = pose.R.transpose() * (furthest(points, direction) - pose.p);
    const auto near = [&](const Vector3& other) { return (other - point).norm() < kApart; };
    if (std::none_of(outermost.begin(), outermost.end(), near)) outermost.push_back(point);
  }
  return outermost;
}

}  // namespace hurcules
