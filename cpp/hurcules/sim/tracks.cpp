#include "hurcules/sim/tracks.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <string_view>

#include "hurcules/base/error.hpp"
#include "hurcules/robot/object_names.hpp"
#include "hurcules/sim/sparse_columns.hpp"

namespace hurcules {

namespace {

// [m/s^2] cap on the tangential reference: above mu g, else braking is too weak; without it sinkage
// grows with slip
constexpr mjtNum kMaxReference = 15.0;
// a run is smooth with the cylinders at its ends, so that no normal on it leans further along it
constexpr mjtNum kMaxLean = 0.2;
// [m/s^2] a normal reference that asks for no force
constexpr mjtNum kNoContact = -1e9;

bool is_track(std::string_view tuple) {
  const std::size_t at = tuple.find("track_");
  return at == 0 || (at != std::string_view::npos && tuple[at - 1] == '_') ||
         (at != std::string_view::npos && tuple[at - 1] == '/');
}

// a box that is touched on its front or rear face, which the cylinder there covers: a step's edge
// that passes from the cylinder to the box would hook there
bool on_covered_face(const mjModel* m, const mjData* d, const mjContact& contact, int geom) {
  if (m->geom_type[geom] != mjGEOM_BOX) return false;
  const mjtNum* const axes = d->geom_xmat + 9 * geom;
  const mjtNum along[3] = {axes[0], axes[3], axes[6]};
  return std::abs(mju_dot3(contact.frame, along)) > kMaxLean;
}

// velocity of the belt's surface at unit belt speed, along the two tangents of a contact, as the
// rows count it: + for the second geom, - for the first
std::array<mjtNum, 2> belt_rows(const mjData* d, const mjContact& contact, int geom, int belt) {
  const double side = contact.geom[1] == geom ? 1.0 : -1.0;
  mjtNum arm[3], velocity[3];
  mju_sub3(arm, contact.pos, d->geom_xpos + 3 * geom);
  mju_cross(velocity, d->xaxis + 3 * belt, arm);
  return {side * mju_dot3(velocity, contact.frame + 3),
          side * mju_dot3(velocity, contact.frame + 6)};
}

// adds the belt's motion to the two tangential rows of a contact
void add_belt(const mjModel* m, mjData* d, const mjContact& contact, int geom, int dof) {
  const int row = contact.efc_address;
  const std::array<mjtNum, 2> rows = belt_rows(d, contact, geom, m->dof_jntid[dof]);
  const bool sparse = mj_isSparse(m);
  for (int t = 1; t < 3; ++t) {
    const mjtNum j = rows[static_cast<std::size_t>(t - 1)];
    mjtNum* const entry =
        sparse ? sparse_entry(d, row + t, dof) : d->efc_J + (row + t) * m->nv + dof;
    if (!entry) continue;
    *entry += j;
    d->efc_vel[row + t] += j * d->qvel[dof];
    d->efc_aref[row + t] -= d->efc_KBIP[4 * (row + t) + 1] * j * d->qvel[dof];
  }
}

// caps the tangential reference and takes the lift that it causes off the normal one
void keep_down(mjData* d, const mjContact& contact) {
  mjtNum* const reference = d->efc_aref + contact.efc_address;
  const mjtNum size = std::hypot(reference[1], reference[2]);
  const mjtNum scale = size > kMaxReference ? kMaxReference / size : 1.0;
  reference[1] *= scale;
  reference[2] *= scale;
  reference[0] -= contact.friction[0] * size * scale;
}

}  // namespace

Tracks::Tracks(const mjModel* m) : track_of_geom_(static_cast<std::size_t>(m->ngeom), -1) {
  for (int tuple = 0; tuple < m->ntuple; ++tuple) {
    const std::string name = name_of(*m, mjOBJ_TUPLE, tuple);
    if (!is_track(name)) continue;
    const int first = m->tuple_adr[tuple], size = m->tuple_size[tuple];
    require(size >= 2 && m->tuple_objtype[first] == mjOBJ_JOINT &&
                m->jnt_type[m->tuple_objid[first]] == mjJNT_HINGE,
            "tuple '" + name + "' wants a belt hinge and then at least one geom");
    names_.push_back(name.substr(name.find("track_") + 6));
    belts_.push_back(m->tuple_objid[first]);
    dof_.push_back(m->jnt_dofadr[belts_.back()]);
    for (int i = first + 1; i < first + size; ++i) {
      require(m->tuple_objtype[i] == mjOBJ_GEOM,
              "tuple '" + name + "' wants only geoms after its belt");
      track_of_geom_[static_cast<std::size_t>(m->tuple_objid[i])] =
          static_cast<int>(belts_.size()) - 1;
    }
  }
  if (belts_.empty()) return;
  require(m->opt.cone == mjCONE_ELLIPTIC, "tracks want <option cone=\"elliptic\"/>");
}

void Tracks::make_room(mjData* d) const {
  const auto rows = static_cast<std::size_t>(d->nefc);
  const ArenaScratch scratch(d, rows * sizeof(AddedColumns));
  auto* const added = static_cast<AddedColumns*>(scratch.memory());
  if (added) {
    std::uninitialized_fill_n(added, rows, AddedColumns{});
    for (int i = 0; i < d->ncon; ++i) {
      const mjContact& contact = d->contact[i];
      if (contact.efc_address < 0 || contact.dim < 3) continue;
      const AddedColumns columns{dof_of(contact.geom[0]), dof_of(contact.geom[1])};
      std::fill_n(added + contact.efc_address, contact.dim, columns);
    }
  }
  if (!added || !add_sparse_columns(d, added))
    mj_warning(d, mjWARN_CNSTRFULL, static_cast<int>(d->narena));
}

void Tracks::add_belts(const mjModel* m, mjData* d) const {
  if (belts_.empty() || d->nefc == 0) return;
  if (mj_isSparse(m)) make_room(d);
  for (int i = 0; i < d->ncon; ++i) {
    const mjContact& contact = d->contact[i];
    if (contact.efc_address < 0 || contact.dim < 3) continue;
    bool on_track = false;
    for (const int geom : contact.geom) {
      const int track = track_of(geom);
      if (track < 0) continue;
      if (on_covered_face(m, d, contact, geom)) d->efc_aref[contact.efc_address] = kNoContact;
      add_belt(m, d, contact, geom, dof_[static_cast<std::size_t>(track)]);
      on_track = true;
    }
    if (on_track) keep_down(d, contact);
  }
}

std::size_t Tracks::find(const std::string& name) const {
  const auto found = std::find(names_.begin(), names_.end(), name);
  if (found == names_.end()) throw Error(unknown_name("track", name, names_));
  return static_cast<std::size_t>(found - names_.begin());
}

TrackReading Tracks::read(const mjModel* m, const mjData* d, std::size_t track) const {
  TrackReading reading;
  for (int i = 0; i < d->ncon; ++i) {
    const mjContact& contact = d->contact[i];
    if (contact.efc_address < 0 || contact.dim < 3) continue;
    const bool second = track_of(contact.geom[1]) == static_cast<int>(track);
    if (!second && track_of(contact.geom[0]) != static_cast<int>(track)) continue;
    const std::array<mjtNum, 2> rows =
        belt_rows(d, contact, contact.geom[second ? 1 : 0], belts_[track]);
    const mjtNum* const force = d->efc_force + contact.efc_address;
    const mjtNum* const velocity = d->efc_vel + contact.efc_address;
    const double unit = std::hypot(rows[0], rows[1]);  // [m] belt speed to surface speed
    if (force[0] <= 0.0 || unit < mjMINVAL) continue;
    // the lower run moves backward as the robot goes forward
    reading.load += force[0];
    reading.traction -= (force[1] * rows[0] + force[2] * rows[1]) / unit;
    reading.slip += force[0] * (velocity[1] * rows[0] + velocity[2] * rows[1]) / unit;
    reading.speed += force[0] * unit * d->qvel[m->jnt_dofadr[belts_[track]]];
  }
  if (reading.load > 0.0) {
    reading.slip /= reading.load;
    reading.speed /= reading.load;
  }
  return reading;
}

}  // namespace hurcules
