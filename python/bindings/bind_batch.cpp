// sim: many simulations on threads.
#include <mujoco/mujoco.h>
#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "annotated.hpp"
#include "command.hpp"
#include "hurcules/base/error.hpp"
#include "hurcules/sim/simulation_batch.hpp"
#include "in_use.hpp"
#include "mujoco_pointer.hpp"

namespace py = pybind11;
using namespace pybind11::literals;
using namespace hurcules;
using namespace hurcules_bindings;

void bind_batch(py::module_& module);

namespace {

constexpr const char* kBatch = R"(Many copies of a simulation on threads, stepped in one call.

Each has controller and data of its own; they share the model unless each gets its own. Its bits
are those that it has alone, whatever the number of threads. Copies record nothing.

Args:
  simulation: Simulation to copy, in its present state.
  n: how many.
  threads: 0 for one a processor.
  models: one mujoco.MjModel each, of the same names and shapes, or none. Their controllers go on
    reckoning with the model of `simulation`.

Raises:
  Error: n < 1, or models that do not fit.
)";

constexpr const char* kPush = R"(Forces on a body of each, from now on; zero ends them.

Args:
  body: number of the body in the model.
  forces: (n, 3) [N] in the world, at its centre of mass.

Raises:
  Error: an array of another shape, not finite, or no such body.
)";

constexpr const char* kBatchStep = R"(Control ticks of all. Releases the interpreter lock.

Args:
  ticks: how many; one that is finished stands still.
  commands: (n, k) SI, or None.
  mask: (n,) bool: which are stepped; None: all.

Raises:
  Error: arrays of another shape, or not finite.
)";

constexpr const char* kStepAndRead =
    R"(Control ticks of all, and what is read then. Releases the interpreter lock.

Faster than `step`, then `read`: each is read while the processor has it at hand.

Args:
  ticks: how many; one that is finished stands still.
  quantities: what is read.
  commands: (n, k) SI, or None.
  mask: (n,) bool: which are stepped; None: all. All are read.

Returns:
  (n, m) as `read`.

Raises:
  Error: arrays of another shape, or not finite.
)";

std::unique_ptr<SimulationBatch> make_batch(const Simulation& original, std::size_t n, int threads,
                                            const std::vector<ModelObject>& models) {
  std::vector<ModelPtr> own;
  for (const ModelObject& model : models) {
    own.push_back(held_model(model));
  }
  return std::make_unique<SimulationBatch>(original, n, threads, own);
}

std::optional<Matrix> commands_of(SimulationBatch& self, const CommandObject& given) {
  return commands_of(self[0].controller(), given, static_cast<Index>(self.size()));
}

void step_batch(SimulationBatch& self, int ticks, const CommandObject& given,
                const std::optional<std::vector<bool>>& mask) {
  const std::optional<Matrix> commands = commands_of(self, given);
  const InUse in_use("SimulationBatch", &self);
  const py::gil_scoped_release release;
  self.step(ticks, commands ? &*commands : nullptr, mask ? &*mask : nullptr);
}

Matrix step_and_read_batch(SimulationBatch& self, int ticks, const Quantities& quantities,
                           const CommandObject& given,
                           const std::optional<std::vector<bool>>& mask) {
  const std::optional<Matrix> commands = commands_of(self, given);
  Matrix values(static_cast<Index>(self.size()), quantities.size());
  const InUse in_use("SimulationBatch", &self);
  const py::gil_scoped_release release;
  self.step_and_read(ticks, commands ? &*commands : nullptr, mask ? &*mask : nullptr, quantities,
                     values);
  return values;
}

void push_batch(SimulationBatch& self, int body, const Matrix& forces) {
  require(forces.rows() == static_cast<Index>(self.size()) && forces.cols() == 3,
          "push wants forces of shape (" + std::to_string(self.size()) + ", 3), (" +
              std::to_string(forces.rows()) + ", " + std::to_string(forces.cols()) + ") came");
  require(forces.allFinite(), "push wants finite forces");
  for (std::size_t i = 0; i < self.size(); ++i) {
    self[i].plant().push(body, forces.row(static_cast<Index>(i)).transpose());
  }
}

// one row a simulation
template <class Row>
Matrix rows_of(const SimulationBatch& self, const Row& row) {
  Matrix all;
  for (std::size_t i = 0; i < self.size(); ++i) {
    const Vector one = row(self[i]);
    if (i == 0) all.resize(static_cast<Index>(self.size()), one.size());
    require(one.size() == all.cols(), "simulations of a batch differ in size");
    all.row(static_cast<Index>(i)) = one.transpose();
  }
  return all;
}

void reset_batch(SimulationBatch& self, const std::vector<std::uint64_t>& seeds,
                 const std::optional<std::vector<bool>>& mask,
                 const std::optional<Matrix>& starts) {
  require(seeds.size() == self.size() && (!mask || mask->size() == self.size()),
          "reset wants " + std::to_string(self.size()) + " seeds, and as many entries of a mask");
  require(!starts || starts->rows() == static_cast<Index>(self.size()),
          "reset wants one start for each of its " + std::to_string(self.size()) + " simulations");
  const InUse in_use("SimulationBatch", &self);
  const py::gil_scoped_release release;
  self.for_each([&](std::size_t i) {
    if (mask && !(*mask)[i]) return;
    if (!starts) return self[i].reset(seeds[i]);
    const Vector start = starts->row(static_cast<Index>(i)).transpose();
    self[i].reset(seeds[i], &start);
  });
}

void restore_batch(SimulationBatch& self, const Matrix& states,
                   const std::optional<std::vector<bool>>& mask) {
  require(
      states.rows() == static_cast<Index>(self.size()) && (!mask || mask->size() == self.size()),
      "restore wants " + std::to_string(self.size()) + " states, " + std::to_string(states.rows()) +
          " came");
  const InUse in_use("SimulationBatch", &self);
  const py::gil_scoped_release release;
  self.for_each([&](std::size_t i) {
    if (mask && !(*mask)[i]) return;
    const auto row = states.row(static_cast<Index>(i));
    self[i].restore(std::vector<double>(row.begin(), row.end()));
  });
}

}  // namespace

void bind_batch(py::module_& module) {
  using Batch = SimulationBatch;
  const auto item = [](Batch& self, std::size_t i) -> Simulation& {
    if (i >= self.size()) throw py::index_error("a batch of " + std::to_string(self.size()));
    return self[i];
  };
  py::class_<Batch>(module, "SimulationBatch", kBatch)
      .def(py::init(&make_batch), "simulation"_a, "n"_a, "threads"_a = 0,
           "models"_a = std::vector<ModelObject>{}, py::keep_alive<1, 2>(), py::keep_alive<1, 5>())
      .def("step", &step_batch, "ticks"_a, "commands"_a = py::none(), "mask"_a = py::none(),
           kBatchStep)
      .def("step_and_read", &step_and_read_batch, "ticks"_a, "quantities"_a,
           "commands"_a = py::none(), "mask"_a = py::none(), kStepAndRead)
      .def("push", &push_batch, "body"_a, "forces"_a, kPush)
      .def("reset", &reset_batch, "seeds"_a, "mask"_a = py::none(), "starts"_a = py::none(),
           "Back to the start; seeds (n,), mask (n,) bool: which, starts (n, nq): where that is.")
      .def(
          "read",
          [](Batch& self, const Quantities& quantities) {
            Matrix values(static_cast<Index>(self.size()), quantities.size());
            {
              const InUse in_use("SimulationBatch", &self);
              const py::gil_scoped_release release;
              self.read(quantities, values);
            }
            return values;
          },
          "quantities"_a, "(n, m) their present values.")
      .def(
          "state",
          [](const Batch& self) {
            return rows_of(self, [](const Simulation& one) -> Vector {
              const std::vector<double> values = one.state();
              return Eigen::Map<const Vector>(values.data(), static_cast<Index>(values.size()));
            });
          },
          "(n, s) all that decides how each goes on, see Simulation.state.")
      .def("restore", &restore_batch, "states"_a, "mask"_a = py::none(), "Goes on from state().")
      .def(
          "observation",
          [](const Batch& self) {
            return rows_of(self,
                           [](const Simulation& one) { return one.observation().snapshot(); });
          },
          "(n, m) what a policy sees now, see Simulation.observation_names.")
      .def("__getitem__", item, py::return_value_policy::reference_internal)
      .def("__len__", &Batch::size)
      .def_property_readonly("threads", &Batch::threads)
      .def_property_readonly(
          "physics",
          [](const Batch& self) {
            return rows_of(self, [](const Simulation& one) {
              const mjModel* const m = one.plant().model();
              Vector state(mj_stateSize(m, mjSTATE_INTEGRATION));
              mj_getState(m, one.plant().data(), state.data(), mjSTATE_INTEGRATION);
              return state;
            });
          },
          "(n, s) for mujoco.mj_setState with mjSTATE_INTEGRATION: time, qpos, qvel, ctrl, ...")
      .def_property_readonly(
          "qpos",
          [](const Batch& self) {
            return rows_of(self,
                           [](const Simulation& one) -> Vector { return one.plant().qpos(); });
          },
          "(n, nq) of the physics")
      .def_property_readonly(
          "qvel",
          [](const Batch& self) {
            return rows_of(self,
                           [](const Simulation& one) -> Vector { return one.plant().qvel(); });
          },
          "(n, nv) of the physics")
      .def_property_readonly(
          "time",
          [](const Batch& self) {
            return Vector(rows_of(self, [](const Simulation& one) {
                            return Vector(Vector::Constant(1, one.time()));
                          }).col(0));
          },
          "(n,) [s]")
      .def_property_readonly(
          "endings",
          [](const Batch& self) {
            std::vector<Ending> all;
            for (std::size_t i = 0; i < self.size(); ++i) all.push_back(self[i].ending());
            return all;
          },
          "(n,) list of Ending")
      .def_property_readonly(
          "finished",
          [](const Batch& self) {
            py::array_t<bool> all(static_cast<py::ssize_t>(self.size()));
            for (std::size_t i = 0; i < self.size(); ++i) {
              all.mutable_at(static_cast<py::ssize_t>(i)) = self[i].finished();
            }
            return all;
          },
          "(n,) bool");
}
