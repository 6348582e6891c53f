// One level of many hierarchies as stacked numpy arrays: what a batch of equal shapes comes as.
#pragma once

#include <string>
#include <vector>

#include "hurcules/solver/batch.hpp"
#include "solver_levels.hpp"

namespace hurcules_bindings {

struct ArrayStack {
  SharedArray A;             // (B, m, n), or (m, n) for all; (0, 0) for simple bounds
  SharedArray lower, upper;  // (B, m), or (m) for all
  double rho = 0.0;
  bool bounds = false;

  // B; 1 when one slice serves all
  [[nodiscard]] pybind11::ssize_t count() const;
  [[nodiscard]] hurcules::Index unknowns() const;
  // of hierarchy i
  [[nodiscard]] hurcules::LevelView view(pybind11::ssize_t i) const;
  // false when the arrays have other numbers of slices, or one was given another number of axes or
  // another layout in place
  [[nodiscard]] bool is_readable() const;
};

[[nodiscard]] ArrayStack make_stack(const ArrayLike& A, const ArrayLike& lower,
                                    const ArrayLike& upper, const As<"float">& rho);
[[nodiscard]] ArrayStack make_bounds_stack(const ArrayLike& lower, const ArrayLike& upper);
[[nodiscard]] bool is_stack(pybind11::handle object);

// The hierarchies of a sequence of stacks, for the time of a batch.
class HeldStacks {
 public:
  explicit HeldStacks(const pybind11::tuple& stacks);

  [[nodiscard]] const std::vector<hurcules::BatchProblem>& problems() const { return problems_; }
  // throws the Error of what the solver refused
  [[noreturn]] void refuse(std::size_t problem) const;

 private:
  pybind11::tuple kept_;
  std::vector<hurcules::LevelView> views_;  // of all hierarchies, one after the other
  std::vector<hurcules::BatchProblem> problems_;
};

}  // namespace hurcules_bindings
