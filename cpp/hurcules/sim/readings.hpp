// What the watches of persons and things read out of a model and its state.
#pragma once

#include <string>

#include "hurcules/base/types.hpp"
#include "hurcules/control/parking.hpp"

struct mjModel_;
struct mjData_;

namespace hurcules {

// number of a body, site or joint (mjtObj); throws Error where the model has none: "WHO wants a ..."
[[nodiscard]] int require_id(const mjModel_* model, int kind, const std::string& name,
                             const std::string& who);
// number of a body; throws Error with the bodies that exist, `where` for the text
[[nodiscard]] int find_body(const mjModel_* model, const std::string& name,
                            const std::string& where);
// where a body is on the ground; its heading is a quarter turn to the right of its y axis, which is
// level for a robot that bows
[[nodiscard]] PlanarPose pose_on_ground(const mjData_* data, int body);
// the same of the centre of mass of a body and all that hangs on it
[[nodiscard]] PlanarPose centre_on_ground(const mjData_* data, int body);
// the i-th of vectors that stand one after the other
[[nodiscard]] Vector3 vector_at(const double* values, int i);
// the i-th of rotations, likewise
[[nodiscard]] Matrix3 matrix_at(const double* values, int i);
// [N] of a body and all that hangs on it; asked anew each time, since models of a batch differ, and
// change between episodes
[[nodiscard]] double weight_of(const mjModel_* model, int body);

// What a contact does.
struct ContactForce {
  Vector3 force = Vector3::Zero();  // [N] in W, on its second body
  double normal = 0.0;              // [N] that its bodies press each other with
};
// of contact i of the state, which is one that acts
[[nodiscard]] ContactForce contact_force(const mjModel_* model, const mjData_* data, int i);

}  // namespace hurcules
