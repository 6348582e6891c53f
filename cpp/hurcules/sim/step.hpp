// One step of the physics: mj_step, and between its halves the traction of the tracks, the brakes
// and the limits of the drives. Where one of these acts, a model of integrator RK4 is stepped by Euler:
// mj_step2 knows no other.
#pragma once

#include "hurcules/sim/brakes.hpp"
#include "hurcules/sim/drive_train.hpp"
#include "hurcules/sim/tracks.hpp"

namespace hurcules {

// null: without
struct Drives {
  Brakes* brakes = nullptr;
  DriveTrain* train = nullptr;
};

void step(const mjModel_* model, mjData_* data, const Tracks& tracks, const Drives& drives = {});

// The same motion without MuJoCo's sensors, a tenth of the work: for steps after which nobody looks
// at them. They keep their readings; where something else hangs on them, they are read all the
// same.
void step_unseen(const mjModel_* model, mjData_* data, const Tracks& tracks,
                 const Drives& drives = {});

}  // namespace hurcules
