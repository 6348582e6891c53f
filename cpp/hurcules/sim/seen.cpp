#include "hurcules/sim/seen.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "hurcules/base/error.hpp"

namespace hurcules {

bool put_together(const std::vector<ConstMatrixRef>& parts, const ConstMatrixRef& errors,
                  const Eigen::Ref<const FloatVector>& bound, Eigen::Ref<FloatMatrix> rows) {
  bool fits = errors.rows() == rows.rows() && errors.cols() <= rows.cols();
  Index columns = 0;
  for (const ConstMatrixRef& part : parts) {
    fits = fits && part.rows() == rows.rows();
    columns += part.cols();
  }
  if (!fits || columns != rows.cols() || columns != bound.size())
    throw Error("an observation wants parts, errors and goals of " + std::to_string(rows.rows()) +
                " rows, the parts of " + std::to_string(bound.size()) + " columns in all");
  bool finite = true;
  Index place = 0;
  for (const ConstMatrixRef& part : parts) {
    for (Index j = 0; j < part.cols(); ++j, ++place) {
      for (Index i = 0; i < rows.rows(); ++i) {
        auto value = static_cast<float>(part(i, j));
        if (place < errors.cols()) value += static_cast<float>(errors(i, place));
        value = std::clamp(value, -bound[place], bound[place]);
        finite = finite && std::isfinite(value);
        rows(i, place) = value;
      }
    }
  }
  return finite;
}

bool cut(VectorRef numbers) {
  const bool finite = numbers.allFinite();
  for (double& number : numbers) number = std::clamp(number, -1.0, 1.0);
  return finite;
}

}  // namespace hurcules
