// sim: what a step of an environment comes to, of many episodes at once.
#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "hurcules/base/error.hpp"
#include "hurcules/sim/goals.hpp"
#include "hurcules/sim/judge.hpp"
#include "hurcules/sim/seen.hpp"
#include "lent.hpp"

namespace py = pybind11;
using namespace pybind11::literals;
using namespace hurcules;
using namespace hurcules_bindings;

void bind_judge(py::module_& module);

namespace {

constexpr const char* kJudge = R"(Judges a step of episodes side by side.

By what was read of their simulations and what their task says: reward, cost, how it ended, and the
numbers that are told of these. The cost is 1 where the robot touches itself; is beyond the
limit of a joint's place by more than 5 mrad (of slides 5 mm) at the end of the step, or within it
further than ever; or where the task says so.

Args:
  values: (n, m) as read, `judged()` its last columns.
  terms: list of (n,) arrays, the terms of the reward.
  failed: (n,) bool.
  ended: (n,) bool, by success.
  costly: (n,) bool: more that costs.
  worst: (n,) the worst excess [rad] of each at its last step, updated; 0 for one that begins.

Returns:
  reward (n,), failed (n,), terminated (n,), ending (n,), what is told (r, n): the terms, then by
  the names of `judged()`; and whether the rewards are finite.

Raises:
  Error: arrays of another size.
)";

constexpr const char* kJudged = R"(What `judge` reads, in this order, and what it tells of it.

Returns:
  Pairs of names; of the ending the cost is told.
)";

constexpr const char* kClipped = R"(Numbers cut to [-1, 1].

Args:
  values: of any shape.

Returns:
  A copy, and whether all are finite.
)";

constexpr const char* kSeen = R"(Arrays side by side, as an observation, and goals.

Args:
  parts: list of (n, k) arrays.
  bound: (m,) float32, what is beyond is cut off.
  errors: (n, e) or None, added first, to the first columns.
  goals: list of (n, g) arrays, which are not cut.

Returns:
  List of (n, m) float32 and of the goals likewise, and whether all are finite.

Raises:
  Error: arrays of another shape.
)";

constexpr const char* kDistances = R"(Distances of places from each other.

Args:
  one: (n, h size) h poses in a row: place [m], then what else they have.
  other: the same.
  size: of a pose, 3 or more.
  rounded: both as float32 has them, which is how they are seen.

Returns:
  (n, h) [m].

Raises:
  Error: arrays of another shape.
)";

constexpr const char* kHalfAngleCosines = R"(How orientations differ.

Args:
  one: (n, h size) h poses in a row: place, quaternion w, x, y, z of any length, what else they
    have.
  other: the same.
  size: of a pose, 7 or more.
  rounded: both as float32 has them, which is how they are seen.

Returns:
  (n, h) cosine, from 0 to 1, of half the angle between them.

Raises:
  Error: arrays of another shape.
)";

constexpr const char* kHold = R"(Counts for how long something holds without a break.

Args:
  now: (n,) bool: it does, after a step.
  dt: [s] of the step.
  least: [s] for which it is to hold.
  held: (n, 1) [s] so far, updated.
  done: (n, 1) updated: 1 from when it held for `least`.

Returns:
  (n,) what `done` grew by.

Raises:
  Error: arrays of another size.
)";

constexpr const char* kSwing = R"(Carries points in springs on by a step, along each axis alike.

What they hang in changes its velocity where the step begins.

Args:
  place: (n, k) [m] of what they hang in, now.
  free: (2, 2) what deflection and its rate become in the step by themselves.
  dt: [s] of the step.
  before: (n, k) [m] the place before, updated.
  velocity: (n, k) [m/s] of it, updated.
  deflection: (n, k) [m], updated.
  rate: (n, k) [m/s] of the deflection, updated.

Returns:
  (n, k) [m] where the points are.

Raises:
  Error: arrays of another shape.
)";

using Floats = py::array_t<float>;
using Given = Lent<double>;
using Own = Lent<double, true>;
using Said = Lent<bool>;

py::tuple judged_step(const Given& values, const std::vector<Given>& terms, const Said& failed,
                      const Said& ended, const Said& costly, const Own& worst) {
  Claims claims{{}, failed.column(), ended.column(), costly.column()};
  claims.terms.reserve(terms.size());
  for (const Given& term : terms) claims.terms.emplace_back(term.column());
  const Verdict verdict = judge(values.rows(), claims, worst.column());
  return py::make_tuple(new_array(verdict.reward), new_array(verdict.failed),
                        new_array(verdict.terminated), new_array(verdict.ending),
                        new_array(verdict.told), verdict.finite);
}

std::pair<Array, bool> clipped(const py::array& values) {
  Array result(std::vector<py::ssize_t>(values.shape(), values.shape() + values.ndim()));
  Eigen::Map<Vector> numbers(result.mutable_data(), values.size());
  if (py::isinstance<Floats>(values) && (values.flags() & py::array::c_style) != 0) {
    const auto* const first = static_cast<const float*>(values.data());
    numbers = Eigen::Map<const FloatVector>(first, values.size()).cast<double>();
  } else {
    const Array given(values);
    numbers = Eigen::Map<const Vector>(given.data(), values.size());
  }
  return {result, cut(numbers)};
}

std::pair<py::list, bool> seen(const std::vector<Given>& parts, const Lent<float>& bound,
                               const std::optional<Given>& errors,
                               const std::vector<Given>& goals) {
  py::list results;
  bool finite = true;
  const Index n = parts.empty() ? 0 : parts.front().rows().rows();
  const auto put = [&](const std::vector<ConstMatrixRef>& from, const ConstMatrixRef& added,
                       const Eigen::Ref<const FloatVector>& most) {
    Floats to({n, most.size()});
    const Eigen::Map<FloatMatrix> rows(to.mutable_data(), n, most.size());
    finite = put_together(from, added, most, rows) && finite;
    results.append(to);
  };
  std::vector<ConstMatrixRef> from;
  from.reserve(parts.size());
  for (const Given& part : parts) from.emplace_back(part.rows());
  const Matrix none(n, 0);
  put(from, errors ? ConstMatrixRef(errors->rows()) : ConstMatrixRef(none), bound.column());
  for (const Given& goal : goals) {
    const FloatVector far = FloatVector::Constant(goal.rows().cols(), HUGE_VALF);
    put({goal.rows()}, none, far);
  }
  return {results, finite};
}

py::array_t<double> distances_of(const Given& one, const Given& other, Index size, bool rounded) {
  return new_array(distances(one.rows(), other.rows(), size, rounded));
}

py::array_t<double> half_angle_cosines_of(const Given& one, const Given& other, Index size,
                                          bool rounded) {
  return new_array(half_angle_cosines(one.rows(), other.rows(), size, rounded));
}

py::array_t<double> hold_all(const Said& now, double dt, double least, const Own& held,
                             const Own& done) {
  return new_array(hold(now.column(), dt, least, held.column(), done.column()));
}

py::array_t<double> swing_points(const Given& place, const Given& free, double dt,
                                 const Own& before, const Own& velocity, const Own& deflection,
                                 const Own& rate) {
  Swing state{before.rows(), velocity.rows(), deflection.rows(), rate.rows()};
  return new_array(swing(place.rows(), free.rows(), dt, state));
}

}  // namespace

void bind_judge(py::module_& module) {
  module.def("judged", &judged, kJudged);
  module.def("judge", &judged_step, "values"_a, "terms"_a, "failed"_a, "ended"_a, "costly"_a,
             "worst"_a, kJudge);
  module.def("clipped", &clipped, "values"_a, kClipped);
  module.def("seen", &seen, "parts"_a, "bound"_a, "errors"_a = py::none(), "goals"_a = py::tuple(),
             kSeen);
  module.def("distances", &distances_of, "one"_a, "other"_a, "size"_a, "rounded"_a = false,
             kDistances);
  module.def("half_angle_cosines", &half_angle_cosines_of, "one"_a, "other"_a, "size"_a,
             "rounded"_a = false, kHalfAngleCosines);
  module.def(
      "all_below",
      [](const Given& values, double bound) { return new_array(all_below(values.rows(), bound)); },
      "values"_a, "bound"_a, "(n,) bool: whether all of a row (n, k) are smaller than `bound`.");
  module.def(
      "means",
      [](const Given& values, double factor) { return new_array(means(values.rows(), factor)); },
      "values"_a, "factor"_a = 1.0, "(n,) `factor` times the mean of a row of (n, k).");
  module.def(
      "squares", [](const Given& values) { return new_array(squares(values.rows())); }, "values"_a,
      "(n,) sum of the squares of a row of (n, k).");
  module.def("hold", &hold_all, "now"_a, "dt"_a, "least"_a, "held"_a, "done"_a, kHold);
  module.def("swing", &swing_points, "place"_a, "free"_a, "dt"_a, "before"_a, "velocity"_a,
             "deflection"_a, "rate"_a, kSwing);
}
