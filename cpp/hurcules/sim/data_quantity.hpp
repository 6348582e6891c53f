// Named numbers of a scene, straight from MuJoCo's data.
//
//   position/OBJECT                    (3) [m] of a site, body, camera or geom, in W
//   distance/OBJECT/OBJECT             (1) [m] between two of these
//   joint/JOINT, joint_velocity/JOINT  (1) of any hinge or slide of the model
//   sensor/SENSOR                      (its size) a sensor of the model
//   contact_force/BODY                 (1) [N] sum of the normal forces on a body and all below it;
//                                      world: on what is fixed
#pragma once

#include <optional>
#include <string>

#include "hurcules/base/types.hpp"

struct mjModel_;
struct mjData_;

namespace hurcules {

class DataQuantity {
 public:
  // none for a name of another kind; throws Error for an object that the model has not
  [[nodiscard]] static std::optional<DataQuantity> find(const mjModel_& model,
                                                        const std::string& name);
  [[nodiscard]] Index size() const { return size_; }
  // out (size): as the last step or mj_forward left it
  void read(const mjModel_& model, const mjData_& data, VectorRef out) const;

 private:
  using Array = double* mjData_::*;
  DataQuantity(Array array, int place, Index size) : array_(array), place_(place), size_(size) {}

  Array array_;            // null: the contact force
  Array other_ = nullptr;  // of a distance, to that
  int other_place_ = 0;
  int place_;  // address in the array, or the id of a body
  Index size_;
};

}  // namespace hurcules
