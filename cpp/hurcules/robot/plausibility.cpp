#include "hurcules/robot/plausibility.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "hurcules/base/number_text.hpp"
#include "hurcules/robot/closures.hpp"
#include "hurcules/robot/coordinates.hpp"
#include "hurcules/robot/object_names.hpp"

namespace hurcules {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kRadiansAsDegrees = 2.0 * std::numbers::pi * kDegree;  // [rad]
constexpr double kDegreesAsRadians = 4.0 * std::numbers::pi;            // [rad]
constexpr double kTolerance = 1e-3;                                     // [rad] or [m]

std::string number(double value) {
  return number_text(value, 4);
}

bool turns(const Robot& robot, const Coordinate& coordinate) {
  const DrivenJoint& joint = coordinate.joints.front();
  const int type = robot.model()->jnt_type[joint.joint];
  return type == mjJNT_HINGE || (type == mjJNT_BALL && joint.part == kTurns);  // of three the first
}

std::string named(const std::string& name, const std::string& text) {
  return "'" + name + "' " + text;
}

std::string interval(const Coordinate& coordinate, double unit) {
  return number(coordinate.lower / unit) + " to " + number(coordinate.upper / unit);
}

void append(std::string& list, const std::string& item) {
  list += (list.empty() ? "" : "; ") + item;
}

}  // namespace

std::string implausible_ranges(const Robot& robot) {
  std::vector<std::string> narrow, wide;
  for (const Coordinate& coordinate : robot.coordinates()) {
    const double most = std::max(std::abs(coordinate.lower), std::abs(coordinate.upper));
    if (!turns(robot, coordinate) || !std::isfinite(most)) continue;
    if (most <= kRadiansAsDegrees && coordinate.lower < coordinate.upper)
      narrow.push_back(named(coordinate.name, interval(coordinate, kDegree) + " degrees"));
    if (most > kDegreesAsRadians)
      wide.push_back(named(coordinate.name, interval(coordinate, 1.0) + " rad"));
  }
  std::string text;
  if (!narrow.empty())
    append(text, "joint ranges of a few degrees, were radians meant? " + listed(narrow, "; ") +
                     " (MJCF takes degrees unless it says <compiler angle=\"radian\"/>)");
  if (!wide.empty())
    append(text, "joint ranges of many turns, were degrees meant? " + listed(wide, "; "));
  return text;
}

std::string open_loops(const Robot& robot) {
  constexpr double kTold = 1e-4;  // [m] or [rad]
  const Closures* const loops = robot.closures();
  if (!loops || loops->error() < kTold) return "";
  return "the loops that the model's constraints close stay open by " + number(loops->error()) +
         " m or rad: no posture of the joints that follow has this configuration";
}

std::string outside_limits(const Robot& robot) {
  std::vector<std::string> found;
  for (Index i = 0; i < robot.size(); ++i) {
    const Coordinate& coordinate = robot.coordinates()[i];
    if (coordinate.joints.front().part >= 0) continue;
    const double q = robot.configuration()[i];
    if (q >= coordinate.lower - kTolerance && q <= coordinate.upper + kTolerance) continue;
    found.push_back(
        named(coordinate.name, "at " + number(q) + ", limits " + interval(coordinate, 1.0)));
  }
  for (const RotationVector& rotation : robot.rotations()) {
    const double angle = robot.configuration().segment<3>(rotation.first).norm();
    if (angle <= rotation.range + kTolerance) continue;
    found.push_back(named(joint_name(*robot.model(), rotation.joint),
                          "turned by " + number(angle) + ", limit " + number(rotation.range)));
  }
  if (found.empty()) return "";
  return "the configuration lies outside the joint limits [rad or m]: " + listed(found, "; ");
}

}  // namespace hurcules
