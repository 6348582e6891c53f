// robot: the contact force on a link that hangs on a spring.
#include <pybind11/eigen.h>
#include <pybind11/pybind11.h>

#include <string>

#include "hurcules/base/error.hpp"
#include "hurcules/robot/spring_force.hpp"

namespace py = pybind11;
using namespace pybind11::literals;
using namespace hurcules;

void bind_spring_force(py::module_& module);

namespace {

constexpr const char* kSpringForce =
    R"(The contact force on a link that hangs on a spring, from the deflection of the spring.

The hinge has no motor; contact = damping - spring - weight of what hangs on it. True at rest and in
slow motion, between the stops of the spring.

Args:
  robot: Robot whose model it is.
  joint: hinge with stiffness, LEBS say.
  frame: site or body behind it, where the contact is supposed.

Raises:
  Error: a name that does not exist, a joint that is no spring hinge, a frame before it.
)";
constexpr const char* kUpdate = "Takes what is sensed: qpos (nq,), qvel (nv,).";

}  // namespace

void bind_spring_force(py::module_& module) {
  py::class_<SpringForce>(module, "SpringForce", kSpringForce)
      .def(py::init([](const Robot& robot, const std::string& joint, const std::string& frame) {
             return SpringForce(robot.model(), joint, frame);
           }),
           "robot"_a, "joint"_a, "frame"_a, py::keep_alive<1, 2>())
      .def(
          "update",
          [](SpringForce& self, const Vector& qpos, const Vector& qvel) {
            require(qpos.size() == self.positions() && qvel.size() == self.velocities(),
                    "update wants qpos (" + std::to_string(self.positions()) + ",) and qvel (" +
                        std::to_string(self.velocities()) + ",), got " +
                        std::to_string(qpos.size()) + " and " + std::to_string(qvel.size()));
            self.update(qpos, qvel);
          },
          "qpos"_a, "qvel"_a, kUpdate)
      .def_property_readonly("deflection", &SpringForce::deflection, "[rad]")
      .def_property_readonly("moment", &SpringForce::moment, "[N m] of the contact, at the joint")
      .def_property_readonly("force", &SpringForce::force, "[N] at the frame, across its lever")
      .def_property_readonly("lever", &SpringForce::lever, "[m]")
      .def_property_readonly("direction", &SpringForce::direction, "(3,) of the force, in W")
      .def_property_readonly("at_stop", &SpringForce::at_stop,
                             "whether a stop bears a share that the spring does not tell");
}
