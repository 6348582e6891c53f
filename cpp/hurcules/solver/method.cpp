#include "hurcules/solver/method.hpp"

#include "hurcules/base/error.hpp"
#include "hurcules/solver/level/lexicographic.hpp"
#include "hurcules/solver/thesis/cascade.hpp"
#include "hurcules/solver/thesis/modified_active_set.hpp"

namespace hurcules {

const std::vector<std::string>& method_names() {
  static const std::vector<std::string> names = {"lexicographic", "rhqp_thesis", "hqp", "dls_hqp",
                                                 "cascade"};
  return names;
}

std::unique_ptr<Method> make_method(Index unknowns, const SolverOptions& options) {
  const auto algorithm_1 = [&](const ActiveSetRules& rules) {
    return std::make_unique<ModifiedActiveSet>(unknowns, options, rules);
  };
  if (options.method == "lexicographic") return std::make_unique<Lexicographic>(unknowns, options);
  if (options.method == "rhqp_thesis") return algorithm_1(kRhqpThesis);
  if (options.method == "hqp") return algorithm_1(kHqp);
  if (options.method == "dls_hqp") return algorithm_1(kDlsHqp);
  if (options.method == "cascade") return std::make_unique<Cascade>(unknowns, options);
  throw Error(unknown_name("method", options.method, method_names()));
}

}  // namespace hurcules
