#include "hurcules/base/values.hpp"

#include <cmath>
#include <string>

#include "hurcules/base/error.hpp"
#include "hurcules/base/number_text.hpp"

namespace hurcules {

void require_size(std::string_view what, Index size, Index wanted) {
  if (size == wanted) return;
  throw Error(std::string(what) + " wants " + std::to_string(wanted) + " numbers, " +
              std::to_string(size) + " came");
}

void require_shape(std::string_view what, const MatrixRef& matrix, Index rows, Index columns) {
  if (matrix.rows() == rows && matrix.cols() == columns) return;
  std::string text(what);  // appended: GCC 12 takes a sum for an overlap
  text.append(" wants a matrix of (").append(std::to_string(rows)).append(", ");
  text.append(std::to_string(columns)).append("), (").append(std::to_string(matrix.rows()));
  text.append(", ").append(std::to_string(matrix.cols())).append(") came");
  throw Error(text);
}

void require_values(std::string_view what, const ConstVectorRef& values, Index wanted) {
  require_size(what, values.size(), wanted);
  for (Index i = 0; i < wanted; ++i) {
    if (std::isfinite(values[i])) continue;
    throw Error(std::string(what) + " wants finite numbers, number " + std::to_string(i) + " is " +
                std::to_string(values[i]));
  }
}

void require_number(bool holds, std::string_view wanted, double came) {
  if (!holds) throw Error(std::string(wanted) + ", " + number_text(came) + " came");
}

}  // namespace hurcules
