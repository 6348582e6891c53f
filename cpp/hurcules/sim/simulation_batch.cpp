#include "hurcules/sim/simulation_batch.hpp"

#include <algorithm>
#include <string>

#include "hurcules/base/error.hpp"

namespace hurcules {

SimulationBatch::SimulationBatch(const Simulation& original, std::size_t n, int threads,
                                 const std::vector<ModelPtr>& models) {
  require(n >= 1, "a batch wants at least one simulation");
  require(threads >= 0,
          "threads must be positive, or 0 for one a processor, got " + std::to_string(threads));
  require(models.empty() || models.size() == n, "a batch wants one model for each of its " +
                                                    std::to_string(n) + " simulations, " +
                                                    std::to_string(models.size()) + " came");
  for (std::size_t i = 0; i < n; ++i) {
    simulations_.push_back(original.clone(models.empty() ? nullptr : models[i]));
    commands_.push_back(Vector::Zero(original.controller().scale().size()));
  }
  const std::size_t wanted = threads > 0 ? static_cast<std::size_t>(threads)
                                         : std::max(1u, std::thread::hardware_concurrency());
  for (std::size_t i = 1; i < std::min(wanted, n); ++i) {
    workers_.emplace_back([this] { work(); });
  }
}

SimulationBatch::~SimulationBatch() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  wake_.notify_all();
  for (std::thread& worker : workers_) worker.join();
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

void SimulationBatch::for_each(const std::function<void(std::size_t)>& work) {
  {
    const std::lock_guard lock(mutex_);
    job_ = &work;
    next_ = 0;
    thrown_ = nullptr;
    busy_ = workers_.size();
    ++round_;
  }
  wake_.notify_all();
  take_jobs();
  std::unique_lock lock(mutex_);
  done_.wait(lock, [this] { return busy_ == 0; });
  job_ = nullptr;
  if (thrown_) std::rethrow_exception(thrown_);
}

// the simulations, one after the other, until none is left
void SimulationBatch::take_jobs() {
  for (std::size_t i = next_++; i < size(); i = next_++) {
    try {
      (*job_)(i);
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!thrown_) thrown_ = std::current_exception();
    }
  }
}

// of one thread of the pool
void SimulationBatch::work() {
  std::size_t round = 0;
  for (;;) {
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [&] { return ends_ || round_ != round; });
      if (ends_) return;
      round = round_;
    }
    take_jobs();
    {
      const std::lock_guard lock(mutex_);
      --busy_;
    }
    done_.notify_one();
  }
}

}  // namespace hurcules
