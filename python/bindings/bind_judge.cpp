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
#include "hurcules/sim/judge.hpp"

namespace py = pybind11;
using namespace pybind11::literals;
using namespace hurcules;
using namespace hurcules_bindings;

void bind_judge(py::module_& module);

namespace {

constexpr const char* kJudge = R"(Judges a step of episodes side by side.

By what was read of their simulations and what their task says: reward, cost, how it ended, and the
numbers that are told beside these. The cost is 1 where the robot touches itself; is beyond the
limit of a joint's place by more than 5 mrad (of slides 5 mm) at the end of the step, or within it
further than ever; or where the task says so.

Args:
  values: (n, m) as read, `judged()` its last columns.
  terms: list of (n,) arrays, the terms of the reward.
  failed: (n,) bool.
  ended: (n,) bool, by success.
  costly: (n,) bool: more that costs.
  beside: (s, n): told too.
  worst: (n,) the worst excess [rad] of each at its last step, updated; 0 for one that begins.

Returns:
  reward (n,), failed (n,), terminated (n,), ending (n,), and what is told (r, n): cost, what is
  judged but the first, then what stood beside.

Raises:
  Error: arrays of another size.
)";

constexpr const char* kClipped = R"(Numbers cut to [-1, 1].

Args:
  values: of any shape.

Returns:
  A copy, and whether all are finite.
)";

constexpr const char* kSeen = R"(Arrays side by side, as an observation.

Args:
  parts: list of (n, k) arrays.
  bound: (m,) float32, what is beyond is cut off.
  errors: (n, m) or None, added first.

Returns:
  (n, m) float32, and whether all are finite.

Raises:
  Error: arrays of another shape.
)";

using Floats = py::array_t<float>;
using Strided = py::array_t<double>;  // as it lies in memory

py::tuple judged_step(const ConstMatrixRef& values, const std::vector<Array>& terms,
                      const FlagsRef& failed, const FlagsRef& ended, const FlagsRef& costly,
                      const ConstMatrixRef& beside, VectorRef worst) {
  Claims claims{{}, failed, ended, costly};
  for (const Array& term : terms)
    claims.terms.emplace_back(Eigen::Map<const Vector>(term.data(), term.size()));
  Verdict verdict = judge(values, claims, beside, worst);
  return py::make_tuple(std::move(verdict.reward), std::move(verdict.failed),
                        std::move(verdict.terminated), std::move(verdict.ending),
                        std::move(verdict.told));
}

std::pair<Array, bool> clipped(const Array& values) {
  Array result(std::vector<py::ssize_t>(values.shape(), values.shape() + values.ndim()));
  bool finite = true;
  std::transform(values.data(), values.data() + values.size(), result.mutable_data(),
                 [&finite](double value) {
                   finite = finite && std::isfinite(value);
                   return std::clamp(value, -1.0, 1.0);
                 });
  return {result, finite};
}

std::pair<Floats, bool> seen(const std::vector<Strided>& parts, const Floats& bound,
                             const std::optional<Strided>& errors) {
  const py::ssize_t n = parts.empty() ? 0 : parts.front().shape(0);
  const py::ssize_t m = bound.size();
  py::ssize_t columns = 0;
  for (const Strided& part : parts) {
    const bool fits = part.ndim() == 2 && part.shape(0) == n;
    columns += fits ? part.shape(1) : m + 1;
  }
  const bool fits =
      !errors || (errors->ndim() == 2 && errors->shape(0) == n && errors->shape(1) == m);
  if (bound.ndim() != 1 || columns != m || !fits)
    throw Error("an observation wants parts, and errors, of " + std::to_string(n) + " rows and " +
                std::to_string(m) + " columns in all");
  Floats result({n, m});
  const auto most = bound.unchecked<1>();
  auto out = result.mutable_unchecked<2>();
  bool finite = true;
  py::ssize_t place = 0;
  for (const Strided& part : parts) {
    const auto from = part.unchecked<2>();
    for (py::ssize_t j = 0; j < from.shape(1); ++j, ++place) {
      for (py::ssize_t i = 0; i < n; ++i) {
        auto value = static_cast<float>(from(i, j));
        if (errors) value += static_cast<float>(errors->at(i, place));
        value = std::clamp(value, -most(place), most(place));
        finite = finite && std::isfinite(value);
        out(i, place) = value;
      }
    }
  }
  return {result, finite};
}

}  // namespace

void bind_judge(py::module_& module) {
  module.def("judged", &judged, "What `judge` reads, in this order.");
  module.def("judge", &judged_step, "values"_a, "terms"_a, "failed"_a, "ended"_a, "costly"_a,
             "beside"_a, "worst"_a, kJudge);
  module.def("clipped", &clipped, "values"_a, kClipped);
  module.def("seen", &seen, "parts"_a, "bound"_a, "errors"_a = py::none(), kSeen);
}
