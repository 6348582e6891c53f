// Whether the robot still stands.
#pragma once

#include <string>

#include "hurcules/base/state.hpp"
#include "hurcules/base/types.hpp"

namespace hurcules {

// The robot fell when its pelvis is too low above the support, or the support tilted too far.
class FallMonitor {
 public:
  struct Limits {
    double min_height = 0.0;  // [m] of what falls above its support, along what was up at the start
    double max_tilt = 0.0;    // [rad] of the support against its start
  };
  explicit FallMonitor(Limits limits) : limits_(limits) {}
  void reset(const Matrix3& R_support);  // R_WS at the start
  [[nodiscard]] bool fell(const Matrix3& R_support, double height) const;
  [[nodiscard]] double tilt(const Matrix3& R_support) const;  // [rad]
  // [m] of a place (3) seen from the support, in the world: a ramp tilts it without a collapse
  [[nodiscard]] double height(const Matrix3& R_support, const Vector3& place) const;
  // which of both it passed, and by how much
  [[nodiscard]] std::string text(const Matrix3& R_support, double height) const;
  void save(StateWriter& writer) const;
  void restore(StateReader& reader);

 private:
  Limits limits_;
  Vector3 up_ = Vector3::UnitZ();  // the world's z in the support, at the start
};

}  // namespace hurcules
