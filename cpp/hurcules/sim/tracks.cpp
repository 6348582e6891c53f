#include "hurcules/sim/tracks.hpp"

#include <mujoco/mujoco.h>

#include <cmath>
#include <string>
#include <string_view>

#include "hurcules/base/error.hpp"

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

// adds the belt's motion to the two tangential rows of a contact; side: +1 for its second geom, -1
// for its first
void add_belt(const mjModel* m, mjData* d, const mjContact& contact, int geom, int dof) {
  const int row = contact.efc_address;
  const double side = contact.geom[1] == geom ? 1.0 : -1.0;
  mjtNum arm[3], velocity[3];  // of the belt's surface at unit belt speed
  mju_sub3(arm, contact.pos, d->geom_xpos + 3 * geom);
  mju_cross(velocity, d->xaxis + 3 * m->dof_jntid[dof], arm);
  for (int t = 1; t < 3; ++t) {
    const mjtNum j = side * mju_dot3(velocity, contact.frame + 3 * t);
    d->efc_J[(row + t) * m->nv + dof] += j;
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

Tracks::Tracks(const mjModel* m) : belt_dof_(static_cast<std::size_t>(m->ngeom), -1) {
  for (int tuple = 0; tuple < m->ntuple; ++tuple) {
    const char* const found = mj_id2name(m, mjOBJ_TUPLE, tuple);
    const std::string name = found ? found : "";
    if (!is_track(name)) continue;
    const int first = m->tuple_adr[tuple], size = m->tuple_size[tuple];
    require(size >= 2 && m->tuple_objtype[first] == mjOBJ_JOINT &&
                m->jnt_type[m->tuple_objid[first]] == mjJNT_HINGE,
            "tuple '" + name + "' wants a belt hinge and then at least one geom");
    belts_.push_back(m->tuple_objid[first]);
    for (int i = first + 1; i < first + size; ++i) {
      require(m->tuple_objtype[i] == mjOBJ_GEOM,
              "tuple '" + name + "' wants only geoms after its belt");
      belt_dof_[static_cast<std::size_t>(m->tuple_objid[i])] = m->jnt_dofadr[belts_.back()];
    }
  }
  if (belts_.empty()) return;
  require(!mj_isSparse(m),
          "tracks want <option jacobian=\"dense\"/>: a sparse one has no room for the belts");
  require(m->opt.cone == mjCONE_ELLIPTIC, "tracks want <option cone=\"elliptic\"/>");
}

void Tracks::add_belts(const mjModel* m, mjData* d) const {
  if (belts_.empty()) return;
  for (int i = 0; i < d->ncon; ++i) {
    const mjContact& contact = d->contact[i];
    if (contact.efc_address < 0 || contact.dim < 3) continue;
    bool on_track = false;
    for (const int geom : contact.geom) {
      const int dof = geom < 0 ? -1 : belt_dof_[static_cast<std::size_t>(geom)];
      if (dof < 0) continue;
      if (on_covered_face(m, d, contact, geom)) d->efc_aref[contact.efc_address] = kNoContact;
      add_belt(m, d, contact, geom, dof);
      on_track = true;
    }
    if (on_track) keep_down(d, contact);
  }
}

void step(const mjModel* m, mjData* d, const Tracks& tracks) {
  mj_step1(m, d);
  tracks.add_belts(m, d);
  mj_step2(m, d);
}

}  // namespace hurcules
