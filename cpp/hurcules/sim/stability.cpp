#include "hurcules/sim/stability.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace hurcules {

namespace {

constexpr double kSame = 1e-9;  // [m] points nearer than this are one

// twice the area of a triangle, > 0 counterclockwise
template <typename Point>
double turn(const Point& a, const Point& b, const Point& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// two axes across `up`, which make a right-handed frame with it
struct Across {
  explicit Across(const Vector3& up) {
    const Vector3 other = std::abs(up.x()) < 0.9 ? Vector3::UnitX() : Vector3::UnitY();
    y = up.cross(other).normalized();
    x = y.cross(up);
  }
  Vector3 x, y;
};

// of a body that turns about the edge from a to b, with its support on the left
struct Edge {
  Edge(const Vector3& a, const Vector3& b, const Vector3& com, const Vector3& up) {
    const Vector3 along = (b - a).normalized();
    const Vector3 arm = (com - a) - along.dot(com - a) * along;
    const Vector3 rise = up - along.dot(up) * along;
    steepness = rise.norm();
    if (steepness < 1e-9) return;  // an upright edge: nothing tips about it
    const Vector3 v = rise / steepness;
    const Vector3 inward = v.cross(along);
    angle = std::atan2(arm.dot(inward), arm.dot(v));
    lift = arm.norm() * (1.0 - std::cos(angle)) * steepness;
  }
  double steepness = 0.0;
  double angle = std::numeric_limits<double>::infinity();  // [rad]
  double lift = std::numeric_limits<double>::infinity();   // [m] of the centre of mass
};

}  // namespace

SupportPolygon::SupportPolygon(std::size_t room) {
  points_.reserve(room);
  hull_.reserve(2 * room);
}

void SupportPolygon::add(const Vector3& point, double force) {
  if (points_.size() < points_.capacity()) points_.push_back({point, 0.0, 0.0, force});
}

// Andrew's monotone chain
void SupportPolygon::find_hull() {
  std::sort(points_.begin(), points_.end(),
            [](const Point& a, const Point& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  hull_.clear();
  const auto add_chain = [this](auto begin, auto end) {
    const std::size_t start = hull_.size();
    for (auto point = begin; point != end; ++point) {
      while (hull_.size() >= start + 2 &&
             turn(hull_[hull_.size() - 2], hull_.back(), *point) <= kSame * kSame) {
        hull_.pop_back();
      }
      hull_.push_back(*point);
    }
    hull_.pop_back();  // it begins the other chain
  };
  add_chain(points_.begin(), points_.end());
  add_chain(points_.rbegin(), points_.rend());
  if (hull_.empty()) hull_.push_back(points_.front());
}

// p_W [m]; the mean of the points where no force is
Vector3 SupportPolygon::pressure_centre() const {
  Vector3 sum = Vector3::Zero(), mean = Vector3::Zero();
  double force = 0.0;
  for (const Point& point : points_) {
    sum += point.force * point.position;
    mean += point.position;
    force += point.force;
  }
  return force > 0.0 ? Vector3(sum / force) : Vector3(mean / static_cast<double>(points_.size()));
}

Stability SupportPolygon::judge(const Body& body) {
  const Vector3 up = -body.gravity.normalized();
  const Across across(up);
  const auto flat = [&](const Vector3& p) {
    return Point{p, across.x.dot(p), across.y.dot(p), 0.0};
  };
  for (Point& point : points_) {
    point.x = across.x.dot(point.position);
    point.y = across.y.dot(point.position);
  }
  find_hull();
  const Point com = flat(body.com), pressure = flat(pressure_centre());
  const double most = std::numeric_limits<double>::infinity();
  Stability result{most, most, most, most};
  const double weight = body.mass * body.gravity.norm();
  for (std::size_t i = 0; i < hull_.size(); ++i) {
    const Point &a = hull_[i], &b = hull_[(i + 1) % hull_.size()];
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    if (length < kSame) continue;
    const double margin = turn(a, b, com) / length;
    result.margin = std::min(result.margin, margin);
    result.pressure_margin = std::min(result.pressure_margin, turn(a, b, pressure) / length);
    const Edge edge(a.position, b.position, body.com, up);
    result.tip_angle = std::min(result.tip_angle, edge.angle);
    const double energy = weight * edge.lift;
    result.energy = std::min(result.energy, edge.angle >= 0.0 ? energy : -energy);
  }
  if (result.margin < most) return result;
  // a single point: a pencil on its tip
  const Vector3 arm = body.com - hull_.front().position;
  const double off = std::hypot(com.x - hull_.front().x, com.y - hull_.front().y);
  const double angle = std::atan2(off, up.dot(arm));
  return {-off, 0.0, -angle, -weight * arm.norm() * (1.0 - std::cos(angle))};
}

}  // namespace hurcules
