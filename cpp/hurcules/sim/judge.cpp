#include "hurcules/sim/judge.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>

#include "hurcules/base/error.hpp"
#include "hurcules/sim/simulation.hpp"

namespace hurcules {

namespace {

constexpr double kExcess = 5e-3;  // [rad, of slides m] that servos may pass a limit by

struct Name {
  std::string_view read, told;
};

constexpr Name kNames[] = {
    {"ending", "cost"},
    {"excess/position", "limit_excess"},
    {"excess/velocity", "limit_excess_velocity"},
    {"excess/torque", "limit_excess_torque"},
    {"excess_now/position", "limit_excess_now"},
    {"commanded_excess/position", "commanded_excess"},
    {"monitor/self_collision_distance_m", "self_distance"},
    {"monitor/static_margin_m", "support_margin"},
    {"self_contacts", "self_contacts"},
    {"scaled", "scaled"},
    {"status", "solver_status"},
    {"changes", "solver_changes"},
    {"time", "time"},
};
constexpr Index kEnd = std::size(kNames);

constexpr Index judged_place(std::string_view name) {
  Index place = 0;
  while (kNames[place].read != name) ++place;  // beyond the end the compiler refuses
  return place;
}

constexpr Index kEnding = judged_place("ending"), kCost = kEnding;
constexpr Index kWorst = judged_place("excess/position"),
                kNow = judged_place("excess_now/position");
constexpr Index kMargin = judged_place("monitor/static_margin_m");
constexpr Index kTouching = judged_place("self_contacts");

bool fits(const Claims& claims, Index n) {
  const auto fit = [n](const auto& one) { return one.size() == n; };
  return fit(claims.failed) && fit(claims.ended) && fit(claims.costly) &&
         std::all_of(claims.terms.begin(), claims.terms.end(), fit);
}

}  // namespace

const std::vector<std::pair<std::string, std::string>>& judged() {
  static const auto names = [] {
    std::vector<std::pair<std::string, std::string>> all;
    for (const Name& name : kNames) all.emplace_back(name.read, name.told);
    return all;
  }();
  return names;
}

Verdict judge(const ConstMatrixRef& values, const Claims& claims, VectorRef worst) {
  const Index n = worst.size();
  if (values.rows() != n || values.cols() < kEnd || !fits(claims, n))
    throw Error("judge wants values and claims of " + std::to_string(n) + " episodes");
  const auto terms = static_cast<Index>(claims.terms.size());
  Verdict verdict{Vector::Zero(n),         Flags(n), Flags(n), decltype(Verdict::ending)(n),
                  Matrix(terms + kEnd, n), true};
  for (Index k = 0; k < terms; ++k) {
    const ConstVectorRef& term = claims.terms[static_cast<std::size_t>(k)];
    verdict.reward += term;
    verdict.told.row(k) = term.transpose();
  }
  verdict.finite = verdict.reward.allFinite();
  auto told = verdict.told.bottomRows(kEnd);
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
    for (Index j = 0; j < kEnd; ++j) told(j, i) = read[j];
    told(kCost, i) = costs ? 1.0 : 0.0;
    // of a robot that cannot tip
    if (std::isnan(read[kMargin])) told(kMargin, i) = 0.0;
  }
  return verdict;
}

}  // namespace hurcules
