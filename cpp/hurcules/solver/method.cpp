#include "hurcules/solver/method.hpp"

#include "hurcules/base/error.hpp"
#include "hurcules/solver/lexicographic.hpp"

namespace hurcules {

const std::vector<std::string>& method_names() {
  static const std::vector<std::string> names = {"lexicographic"};
  return names;
}

std::unique_ptr<Method> make_method(Index unknowns, const SolverOptions& options) {
  if (options.method == "lexicographic") return std::make_unique<Lexicographic>(unknowns, options);
  throw Error(unknown_name("method", options.method, method_names()));
}

}  // namespace hurcules
