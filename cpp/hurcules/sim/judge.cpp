#include "hurcules/sim/judge.hpp"

#include <algorithm>
#include <cmath>

#include "hurcules/base/error.hpp"
#include "hurcules/sim/simulation.hpp"

namespace hurcules {

namespace {

constexpr double kExcess = 5e-3;  // [rad, of slides m] that servos may pass a limit by

enum Place : Index { kEnding, kWorst, kNow = 4, kMargin = 7, kTouching, kEnd = 13 };

bool fits(const Claims& claims, Index n) {
  const auto fit = [n](const auto& one) { return one.size() == n; };
  return fit(claims.failed) && fit(claims.ended) && fit(claims.costly) &&
         std::all_of(claims.terms.begin(), claims.terms.end(), fit);
}

}  // namespace

const std::vector<std::string>& judged() {
  static const std::vector<std::string> names = {"ending",
                                                 "excess/position",
                                                 "excess/velocity",
                                                 "excess/torque",
                                                 "excess_now/position",
                                                 "commanded_excess/position",
                                                 "monitor/self_collision_distance_m",
                                                 "monitor/static_margin_m",
                                                 "self_contacts",
                                                 "scaled",
                                                 "status",
                                                 "changes",
                                                 "time"};
  return names;
}

Verdict judge(const ConstMatrixRef& values, const Claims& claims, const ConstMatrixRef& beside,
              VectorRef worst) {
  const Index n = worst.size();
  if (values.rows() != n || values.cols() < kEnd || beside.cols() != n || !fits(claims, n))
    throw Error("judge wants values, claims and what is told beside of " + std::to_string(n) +
                " episodes");
  Verdict verdict{Vector::Zero(n), Flags(n), Flags(n), decltype(Verdict::ending)(n),
                  Matrix(kEnd + beside.rows(), n)};
  for (const ConstVectorRef& term : claims.terms) verdict.reward += term;
  for (Index i = 0; i < n; ++i) {
    const auto read = values.row(i).tail(kEnd);
    const auto over = static_cast<Ending>(static_cast<int>(read[kEnding]));
    const bool fell = over != Ending::Running && over != Ending::Completed;
    verdict.failed[i] = claims.failed[i] || fell;
    verdict.terminated[i] = verdict.failed[i] || claims.ended[i];
    verdict.ending[i] = static_cast<std::int64_t>(fell               ? over
                                                  : claims.failed[i] ? Ending::Missed
                                                  : claims.ended[i]  ? Ending::Completed
                                                                     : Ending::Running);
    const bool costs = claims.costly[i] || read[kTouching] > 0.0 || read[kNow] > kExcess ||
                       read[kWorst] > std::max(worst[i], kExcess);
    worst[i] = read[kWorst];
    verdict.told(0, i) = costs ? 1.0 : 0.0;
    for (Index j = 1; j < kEnd; ++j) verdict.told(j, i) = read[j];
    // of a robot that cannot tip
    if (std::isnan(read[kMargin])) verdict.told(kMargin, i) = 0.0;
  }
  verdict.told.bottomRows(beside.rows()) = beside;
  return verdict;
}

}  // namespace hurcules
