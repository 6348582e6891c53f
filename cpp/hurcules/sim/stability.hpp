// How far a body that stands on points is from tipping over.
//
//   support polygon   convex hull of the points, seen along gravity
//   margin            [m] from the centre of mass to the nearest edge, across gravity; < 0: outside
//   pressure margin   [m] the same for the centre of pressure of the normal forces: it counts loads
//                     that the robot carries, and accelerations
//   tip angle         [rad] by which the body must turn about an edge until its centre of mass is
//                     above that edge, the least of all edges; an edge may be inclined
//   energy margin     [J] work that it takes, the least of all edges (Messuri and Klein 1985)
//
// Fewer than three points, or points in a line, have no inside: margins are then never above zero.
#pragma once

#include <vector>

#include "hurcules/base/types.hpp"

namespace hurcules {

struct Stability {
  double margin = 0.0;           // [m]
  double pressure_margin = 0.0;  // [m]
  double tip_angle = 0.0;        // [rad]
  double energy = 0.0;           // [J]
};

class SupportPolygon {
 public:
  // room for so many points; further ones are left out
  explicit SupportPolygon(std::size_t room = 512);
  void clear() { points_.clear(); }
  // p_W [m], and the normal force there [N]
  void add(const Vector3& point, double force);
  [[nodiscard]] bool empty() const { return points_.empty(); }
  [[nodiscard]] std::size_t size() const { return points_.size(); }

  struct Body {
    Vector3 com = Vector3::Zero();               // p_W [m]
    double mass = 0.0;                           // [kg]
    Vector3 gravity = Vector3(0.0, 0.0, -9.81);  // [m/s^2], not zero
  };
  // of the points so far, of which there is at least one
  [[nodiscard]] Stability judge(const Body& body);

 private:
  struct Point {
    Vector3 position;         // p_W [m]
    double x = 0.0, y = 0.0;  // [m] across gravity
    double force = 0.0;       // [N]
  };
  void find_hull();
  [[nodiscard]] Vector3 pressure_centre() const;

  std::vector<Point> points_, hull_;  // the hull counterclockwise, seen from above
};

}  // namespace hurcules
