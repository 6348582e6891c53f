// Many simulations on a pool of threads: one call steps them all.
//
// Each has a controller and data of its own and shares nothing but the model, which nobody writes;
// with models of their own (randomised masses, say) not even that. The bits of each are those that
// it has alone, whatever the number of threads.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "hurcules/sim/quantities.hpp"
#include "hurcules/sim/simulation.hpp"
#include "hurcules/sim/thread_pool.hpp"

namespace hurcules {

class SimulationBatch {
 public:
  // Copies of a simulation in its present state. models: none to share its model, else one each,
  // of the same names and shapes, whose physics the controllers do not know. threads: 0 for one a
  // processor. Throws Error for n < 1 and models that do not fit.
  SimulationBatch(const Simulation& original, std::size_t n, int threads = 0,
                  const std::vector<ModelPtr>& models = {});

  [[nodiscard]] std::size_t size() const { return simulations_.size(); }
  [[nodiscard]] std::size_t threads() const { return pool_.threads(); }
  [[nodiscard]] Simulation& operator[](std::size_t i) { return *simulations_[i]; }
  [[nodiscard]] const Simulation& operator[](std::size_t i) const { return *simulations_[i]; }

  // each up to this many ticks with its row of commands (n, k), null for none; those that are
  // finished stand still. mask (n): which are stepped, null for all
  void step(int ticks, const Matrix* commands = nullptr, const std::vector<bool>* mask = nullptr);
  // the same, then `read`: of each while the processor's cache has it
  void step_and_read(int ticks, const Matrix* commands, const std::vector<bool>* mask,
                     const Quantities& quantities, MatrixRef out);
  // (n, m) the quantities of each now
  void read(const Quantities& quantities, MatrixRef out);
  // runs work(i) for each i on the pool; throws what the first failing one threw
  void for_each(const std::function<void(std::size_t)>& work) { pool_.run(size(), work); }

 private:
  // throws Error unless these are arguments of step; takes the commands
  void take(int ticks, const Matrix* commands, const std::vector<bool>* mask);
  void require_room(const Quantities& quantities, const MatrixRef& out) const;

  std::vector<std::unique_ptr<Simulation>> simulations_;
  std::vector<Vector> commands_;  // (n) of (k)
  ThreadPool pool_;
};

}  // namespace hurcules
