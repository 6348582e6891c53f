#include "hurcules/tasks/contact_task.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "hurcules/base/error.hpp"
#include "hurcules/base/number_text.hpp"
#include "hurcules/robot/sole_points.hpp"

namespace hurcules {

namespace {

constexpr std::size_t kHoldsBody = 3;  // points from which on the whole body is held

constexpr double kInside = 0.9;  // of the way from the middle: a foot tips over its edge

Vector3 middle_of(const std::vector<Vector3>& points) {
  Vector3 middle = Vector3::Zero();
  for (const Vector3& point : points) middle += point / static_cast<double>(points.size());
  return middle;
}

std::vector<Vector3> drawn_in(std::vector<Vector3> points) {
  const Vector3 middle = middle_of(points);
  for (Vector3& point : points) point = middle + kInside * (point - middle);
  return points;
}

ContactTaskOptions completed(const Robot& robot, const std::string& body,
                             ContactTaskOptions options) {
  if (options.points.empty()) options.points = drawn_in(sole_points(robot, body));
  for (const Vector3& point : options.points)
    require(point.allFinite(), "a contact wants points of finite numbers [m]");
  require(std::isfinite(options.friction) && options.friction > 0.0,
          "a contact wants a friction > 0, " + number_text(options.friction) + " came");
  require(options.normal.allFinite() && options.normal.norm() > 1e-9,
          "a contact wants a normal that is not zero");
  options.normal.normalize();
  return options;
}

Index rows_of(const ContactTaskOptions& options) {
  const std::size_t points = options.points.size();
  return points < kHoldsBody ? 3 * static_cast<Index>(points) : 6;
}

}  // namespace

ContactTask::ContactTask(std::string name, const Robot& robot, const std::string& body,
                         ContactTaskOptions options)
    : ContactTask(std::move(name), robot, robot.frame(body),
                  completed(robot, body, std::move(options))) {
  require(robot.is_body(body_), "a contact wants a body; '" + body + "' is none");
  require(robot.moves(body_), "no coordinate moves body '" + body + "'");
}

ContactTask::ContactTask(std::string name, const Robot& robot, Frame body,
                         ContactTaskOptions options)
    : Task(std::move(name), rows_of(options), robot), options_(std::move(options)), body_(body) {
  const Vector3 n = options_.normal, t = n.unitOrthogonal(), b = n.cross(t);
  const double mu = options_.friction;
  along_ << n + mu * t, n + mu * b, n - mu * t, n - mu * b;
  centre_ = middle_of(options_.points);
  efforts_ = Matrix::Zero(robot.size(), edges());
  point_ = Matrix::Zero(3, robot.size());
  ContactTask::update(robot);
}

void ContactTask::update(const Robot& robot) {
  require_robot(robot);
  const Skeleton::Pose pose = robot.pose(body_);
  const auto in_world = [&](const Vector3& point) -> Vector3 { return pose.p + pose.R * point; };
  const bool whole = options_.points.size() >= kHoldsBody;
  Index column = 0, row = 0;
  for (const Vector3& local : options_.points) {
    const Vector3 point = in_world(local);
    robot.point_jacobian(point, body_.id, point_);
    efforts_.middleCols<kEdges>(column).noalias() = point_.transpose() * along_;
    column += kEdges;
    if (whole) continue;
    jacobian_.middleRows<3>(row) = point_;
    drift_.segment<3>(row) = robot.point_drift(point, body_.id);
    row += 3;
  }
  if (!whole) return;
  const Vector3 centre = in_world(centre_);
  robot.point_jacobian(centre, body_.id, jacobian_.topRows<3>());
  robot.rotation_jacobian(body_, jacobian_.bottomRows<3>());
  drift_.head<3>() = robot.point_drift(centre, body_.id);
  drift_.tail<3>() = robot.rotation_drift(body_);
}

void ContactTask::advance(const ConstVectorRef& velocity, double /*dt*/) {
  require_rows(velocity, "velocity");
}

Vector3 ContactTask::force(const ConstVectorRef& lambda) const {
  Vector3 sum = Vector3::Zero();
  for (Index i = 0; i < lambda.size(); ++i) sum += lambda[i] * along_.col(i % kEdges);
  return sum;
}

}  // namespace hurcules
