// Lower bounds of the distance of two geoms, much cheaper than the distance itself.
#pragma once

#include <utility>

struct mjModel_;
struct mjData_;

namespace hurcules {

// [m] by their bounding spheres; a plane has none and counts as what it is
[[nodiscard]] double sphere_gap(const mjModel_* model, const mjData_* data, int first, int second);
// [m] by their oriented bounding boxes; -inf where one is a plane; looks no further when that is `enough`
[[nodiscard]] double box_gap(const mjModel_* model, const mjData_* data, std::pair<int, int> geoms,
                             double enough);

}  // namespace hurcules
