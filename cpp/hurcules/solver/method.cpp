#include "hurcules/solver/method.hpp"

#include "hurcules/base/error.hpp"
#include "hurcules/solver/cascade.hpp"
#include "hurcules/solver/dls_hqp.hpp"
#include "hurcules/solver/hqp.hpp"
#include "hurcules/solver/lexicographic.hpp"
#include "hurcules/solver/rhqp_thesis.hpp"

namespace hurcules {

const std::vector<std::string>& method_names() {
  static const std::vector<std::string> names = {"lexicographic", "rhqp_thesis", "hqp", "dls_hqp",
                                                 "cascade"};
  return names;
}

std::unique_ptr<Method> make_method(Index unknowns, const SolverOptions& options) {
  if (options.method == "lexicographic") return std::make_unique<Lexicographic>(unknowns, options);
  if (options.method == "rhqp_thesis") return std::make_unique<RhqpThesis>(unknowns, options);
  if (options.method == "hqp") return std::make_unique<Hqp>(unknowns, options);
  if (options.method == "dls_hqp") return std::make_unique<DlsHqp>(unknowns, options);
  if (options.method == "cascade") return std::make_unique<Cascade>(unknowns, options);
  throw Error(unknown_name("method", options.method, method_names()));
}

}  // namespace hurcules
