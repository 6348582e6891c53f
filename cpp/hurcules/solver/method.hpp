// What every method of solving a hierarchy offers; `Solver` owns one (solver.md §4).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "hurcules/base/state.hpp"
#include "hurcules/solver/hierarchy.hpp"
#include "hurcules/solver/solution.hpp"
#include "hurcules/solver/solver_options.hpp"

namespace hurcules {

class SolvedHierarchy;

class Method {
 public:
  Method() = default;
  Method(const Method&) = delete;
  Method& operator=(const Method&) = delete;
  virtual ~Method() = default;

  // sizes the memory for problems of this shape
  virtual void reserve(HierarchyView hierarchy) = 0;
  // never throws, always ends; allocates nothing when the shape is reserved
  virtual const Solution& solve(HierarchyView hierarchy) = 0;
  [[nodiscard]] virtual const Solution& solution() const = 0;
  // multipliers[k][j] (m_j), j <= k  [T 3.4.116]
  [[nodiscard]] virtual std::vector<std::vector<Vector>> multipliers() const = 0;
  // a copy of the solve that can be differentiated and reported; null where a method has none
  [[nodiscard]] virtual std::shared_ptr<const SolvedHierarchy> solved() const { return nullptr; }
  virtual void reset() = 0;
  virtual void save(StateWriter& writer) const = 0;
  virtual void restore(StateReader& reader) = 0;
};

[[nodiscard]] const std::vector<std::string>& method_names();
// by options.method; throws Error on an unknown name
[[nodiscard]] std::unique_ptr<Method> make_method(Index unknowns, const SolverOptions& options);

}  // namespace hurcules
