#include "hurcules/solver/problem/candidates.hpp"

#include <cmath>
#include <utility>

#include "hurcules/solver/problem/tolerances.hpp"

namespace hurcules {

void Candidates::reserve(Index most) {
  for (PaddedVector* v : {&above, &value, &target, &lower_, &upper_}) v->reserve(most + 8);
}

void Candidates::start(const RowTable& rows) {
  const Index count = rows.candidates(rows.levels()) + 1;  // and that of rows without limits
  widened_ = false;
  std::fill_n(lower_.data(), count, -kAbsent);
  std::fill_n(upper_.data(), count, kAbsent);
  for (PaddedVector* v : {&above, &value, &target}) std::fill_n(v->data(), count, 0.0);
}

void Candidates::open(const RowTable& rows, int level, const double* x) {
  rows.own_values(level, x, above.data());
  const RowTable::Range own = rows.own_candidates(level);
  std::copy_n(rows.asked_lower() + own.first, own.count, lower_.data() + own.first);
  std::copy_n(rows.asked_upper() + own.first, own.count, upper_.data() + own.first);
}

bool Candidates::violated(const RowTable& rows, int level, const PaddedVector& value,
                          double x_scale) {
  const RowTable::Range own = rows.own_candidates(level);
  if (own.count == 0) return false;
  const kernels::LimitArrays asked = {rows.asked_lower() + own.first,
                                      rows.asked_upper() + own.first, rows.norms() + own.first};
  return kernels::chosen->worst_excess(own.count, value.data() + own.first, asked,
                                       tolerance::kBroken * x_scale, 0.0) > 0.0;
}

void Candidates::close(const RowTable& rows, int level, double x_scale, bool held) {
  // as long as no row stands at a limit or beyond there is nothing to do
  widened_ = widened_ || held || violated(rows, level, value, x_scale);
  if (!widened_) {
    std::swap(above, value);
    return;
  }
  const auto widen = [&](Index first, Index count) {
    const kernels::LimitArrays asked = {rows.asked_lower() + first, rows.asked_upper() + first,
                                        rows.norms() + first};
    kernels::chosen->widen(count, value.data() + first, asked, tolerance::kBroken * x_scale,
                           lower_.data() + first, upper_.data() + first);
  };
  for (int b = 0; b < rows.bounds_blocks(); ++b) {
    if (rows.block_level(b) <= level) widen(b * rows.stride(), rows.stride());
  }
  const Index first = rows.first_dense_candidate();
  widen(first, rows.candidates(level + 1) - first);
  // what the last four reached of the next level is not open yet
  for (Index c = first + rows.inequalities(level + 1); c < rows.candidates(level + 1); ++c) {
    set(c, -kAbsent, kAbsent);
  }
  std::swap(above, value);
}

}  // namespace hurcules
