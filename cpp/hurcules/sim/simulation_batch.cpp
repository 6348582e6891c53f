#include "hurcules/sim/simulation_batch.hpp"

#include <algorithm>
#include <string>

#include "hurcules/base/error.hpp"
#include "hurcules/base/thread_count.hpp"

namespace hurcules {

SimulationBatch::SimulationBatch(const Simulation& original, std::size_t n, int threads,
                                 const std::vector<ModelPtr>& models)
    : pool_(thread_count(threads, std::max<std::size_t>(n, 1))) {
  require(n >= 1, "a batch wants at least one simulation");
  require(models.empty() || models.size() == n, "a batch wants one model for each of its " +
                                                    std::to_string(n) + " simulations, " +
                                                    std::to_string(models.size()) + " came");
  for (std::size_t i = 0; i < n; ++i) {
    simulations_.push_back(original.clone(models.empty() ? nullptr : models[i]));
    commands_.push_back(Vector::Zero(original.controller().scale().size()));
  }
}

void SimulationBatch::step(int ticks, const Matrix* commands, const std::vector<bool>* mask) {
  take(ticks, commands, mask);
  for_each([&](std::size_t i) {
    if (mask && !(*mask)[i]) return;
    simulations_[i]->step(ticks, commands ? &commands_[i] : nullptr);
  });
}

void SimulationBatch::read(const Quantities& quantities, MatrixRef out) {
  require_room(quantities, out);
  for_each([&](std::size_t i) {
    const auto row = static_cast<Index>(i);
    quantities.read(*simulations_[i], Eigen::Map<Vector>(&out(row, 0), out.cols()));
  });
}

void SimulationBatch::step_and_read(int ticks, const Matrix* commands,
                                    const std::vector<bool>* mask, const Quantities& quantities,
                                    MatrixRef out) {
  take(ticks, commands, mask);
  require_room(quantities, out);
  for_each([&](std::size_t i) {
    if (!mask || (*mask)[i]) simulations_[i]->step(ticks, commands ? &commands_[i] : nullptr);
    const auto row = static_cast<Index>(i);
    quantities.read(*simulations_[i], Eigen::Map<Vector>(&out(row, 0), out.cols()));
  });
}

void SimulationBatch::take(int ticks, const Matrix* commands, const std::vector<bool>* mask) {
  const auto n = static_cast<Index>(size());
  const Index channels = commands_.front().size();
  require(ticks >= 0, "step wants a number of ticks >= 0, got " + std::to_string(ticks));
  require(!commands || (commands->rows() == n && commands->cols() == channels),
          "commands want shape (" + std::to_string(n) + ", " + std::to_string(channels) + ")" +
              (commands ? ", (" + std::to_string(commands->rows()) + ", " +
                              std::to_string(commands->cols()) + ") came"
                        : ""));
  if (mask && mask->size() != size())
    throw Error("a mask wants one entry for each of its " + std::to_string(n) + " simulations, " +
                std::to_string(mask->size()) + " came");
  for (Index i = 0; commands && i < n; ++i) {
    Vector& command = commands_[static_cast<std::size_t>(i)];
    command = commands->row(i).transpose();
    require(simulations_.front()->controller().takes(command),
            "commands of simulation " + std::to_string(i) + " want finite numbers");
  }
}

void SimulationBatch::require_room(const Quantities& quantities, const MatrixRef& out) const {
  require(out.rows() == static_cast<Index>(size()) && out.cols() == quantities.size(),
          "quantities want room for (" + std::to_string(size()) + ", " +
              std::to_string(quantities.size()) + ") numbers");
}

}  // namespace hurcules
