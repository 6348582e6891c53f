#include "hurcules/solver/solver_options.hpp"

#include <cmath>

#include "hurcules/base/error.hpp"
#include "hurcules/base/number_text.hpp"

namespace hurcules {

std::string to_string(Handover handover) {
  return handover == Handover::Smooth ? "smooth" : "strict";
}

Handover handover_named(const std::string& name) {
  if (name == "strict") return Handover::Strict;
  if (name == "smooth") return Handover::Smooth;
  throw Error(unknown_name("handover", name, {"strict", "smooth"}));
}

std::string to_string(Regularization regularization) {
  return regularization == Regularization::Adaptive ? "adaptive" : "constant";
}

Regularization regularization_named(const std::string& name) {
  if (name == "constant") return Regularization::Constant;
  if (name == "adaptive") return Regularization::Adaptive;
  throw Error(unknown_name("regularization", name, {"constant", "adaptive"}));
}

void check(const SolverOptions& options) {
  require(options.max_changes > 0,
          "max_changes must be positive, got " + std::to_string(options.max_changes));
  require(options.max_iterations > 0,
          "max_iterations must be positive, got " + std::to_string(options.max_iterations));
  require(std::isfinite(options.singular_threshold) && options.singular_threshold > 0.0,
          "singular_threshold must be finite and positive, got " +
              number_text(options.singular_threshold));
}

}  // namespace hurcules
