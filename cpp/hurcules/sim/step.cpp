#include "hurcules/sim/step.hpp"

#include <mujoco/mujoco.h>

namespace hurcules {

namespace {

bool steps_in_halves(const mjModel* m) {
  return m->opt.integrator != mjINT_RK4 && m->opt.integrator != mjINT_DISCRETE;
}

// histories, callbacks and plugins see every reading; energy is reckoned beside the sensors
bool can_skip_sensors(const mjModel* m) {
  return steps_in_halves(m) && m->nhistory == 0 && m->nplugin == 0 && !mjcb_sensor &&
         !(m->opt.enableflags & (mjENBL_ENERGY | mjENBL_FWDINV));
}

// mj_step1 without sensors
void begin_unseen(const mjModel* m, mjData* d) {
  mj_checkPos(m, d);
  mj_checkVel(m, d);
  mj_fwdPosition(m, d);
  mj_fwdVelocity(m, d);
  if (mjcb_control) mjcb_control(m, d);
}

// mj_step2 without sensors
void end_unseen(const mjModel* m, mjData* d) {
  mj_fwdActuation(m, d);
  mj_fwdAcceleration(m, d);
  mj_fwdConstraint(m, d);
  d->flg_rnepost = 0;
  mj_checkAcc(m, d);
  if (m->opt.integrator == mjINT_IMPLICIT || m->opt.integrator == mjINT_IMPLICITFAST) {
    mj_implicit(m, d);
  } else {
    mj_Euler(m, d);
  }
}

// what we add to the forces, and what moves with time
void push(const mjModel* m, mjData* d, const Tracks& tracks, const Drives& drives) {
  tracks.add_belts(m, d);
  if (drives.brakes) drives.brakes->tighten(d);
  if (drives.train) drives.train->limit(d);
}
bool pushes(const Tracks& tracks, const Drives& drives) {
  return !tracks.empty() || (drives.brakes && drives.brakes->any_shut()) ||
         (drives.train && !drives.train->empty());
}
void advance(mjData* d, const Drives& drives) {
  if (drives.brakes) drives.brakes->advance(d);
  if (drives.train) drives.train->advance(d);
}

}  // namespace

void step(const mjModel* m, mjData* d, const Tracks& tracks, const Drives& drives) {
  if (!steps_in_halves(m) && !pushes(tracks, drives)) {
    mj_step(m, d);
  } else {
    mj_step1(m, d);
    push(m, d, tracks, drives);
    mj_step2(m, d);
  }
  advance(d, drives);
}

void step_unseen(const mjModel* m, mjData* d, const Tracks& tracks, const Drives& drives) {
  if (!can_skip_sensors(m)) return step(m, d, tracks, drives);
  begin_unseen(m, d);
  push(m, d, tracks, drives);
  end_unseen(m, d);
  advance(d, drives);
}

}  // namespace hurcules
