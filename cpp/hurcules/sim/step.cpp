#include "hurcules/sim/step.hpp"

#include <mujoco/mujoco.h>

namespace hurcules {

void step(const mjModel* m, mjData* d, const Tracks& tracks, const Drives& drives) {
  mj_step1(m, d);
  tracks.add_belts(m, d);
  if (drives.brakes) drives.brakes->tighten(d);
  if (drives.train) drives.train->limit(d);
  mj_step2(m, d);
  if (drives.brakes) drives.brakes->advance(d);
  if (drives.train) drives.train->advance(d);
}

}  // namespace hurcules
