// Strategy: a row comes to depend on others, inside its level or on the level above, with and
// without a box, as s goes through 0 (singular_sweep.hpp). With smooth rank transition x stays
// bounded and does not jump where the strict rule does; away from singularity every bit is the
// strict one; the answer is that of the definition by dense algebra; what the level above loses is
// within its bound; warm equals cold; every class of hierarchies is solved and proven. Adaptive
// regularisation against its formula and claim R23. Not tested: levels below with rho = 0 are not
// continuous, and say so.
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "hurcules/solver/solver.hpp"
#include "support/each_problem.hpp"
#include "support/expect.hpp"
#include "support/no_allocation.hpp"
#include "support/nonnegative_least_squares.hpp"
#include "support/singular_sweep.hpp"
#include "support/smooth_reference.hpp"

namespace hurcules {
namespace {

using namespace hurcules_test;

constexpr unsigned kSeeds = 6;
const SolverOptions kSmooth{.handover = Handover::Smooth};

Vector answer(const Hierarchy& levels, const SolverOptions& options) {
  Solver solver(unknowns_of(levels), options);
  const Solution& solution = solver.solve(levels);
  EXPECT_EQ(to_string(solution.status), "solved");
  EXPECT_LE(solution.optimality, kProven);
  return solution.x;
}

Vector answer_until(const Hierarchy& levels, std::size_t end, const SolverOptions& options) {
  return answer(Hierarchy(levels.begin(), levels.begin() + static_cast<long>(end)), options);
}

// worst |dx| / ds over steps of [from, to], on grids each ten times finer where the last moved most
std::vector<double> slopes(const SingularSweep& sweep, const SolverOptions& options,
                           std::initializer_list<double> grids) {
  constexpr double kFrom = -0.15, kTo = 0.15;
  constexpr std::size_t kFiner = 4;
  Solver solver(SingularSweep::kUnknowns, options);
  const auto x = [&](double s) {
    const Solution& solution = solver.solve(sweep.at(s));
    EXPECT_EQ(to_string(solution.status), "solved") << "s = " << s;
    EXPECT_LE(solution.optimality, kProven) << "s = " << s;
    return solution.x;
  };
  std::vector<double> worst, starts(static_cast<std::size_t>((kTo - kFrom) / *grids.begin() + 0.5));
  for (std::size_t i = 0; i < starts.size(); ++i) {
    starts[i] = kFrom + static_cast<double>(i) * *grids.begin();
  }
  for (const double grid : grids) {
    std::vector<std::pair<double, double>> moves;
    Vector last;
    double at = -1.0;
    for (const double s : starts) {
      if (std::abs(s - at) > 1e-3 * grid) last = x(s);
      const Vector next = x(at = s + grid);
      moves.emplace_back((next - last).norm() / grid, s);
      last = next;
    }
    std::sort(moves.rbegin(), moves.rend());
    worst.push_back(moves[0].first);
    starts.clear();
    for (std::size_t i = 0; i < std::min(kFiner, moves.size()); ++i) {
      for (int j = 0; j < 10; ++j) starts.push_back(moves[i].second + 0.1 * j * grid);
    }
  }
  return worst;
}

TEST(SolverSingular, StepsExplainEveryMove) {
  each_sweep(kSeeds, [](const SingularSweep& sweep) {
    // s = 0 lies on every grid; with limits the steepest places are short, so it takes fine grids
    const auto smooth = slopes(sweep, kSmooth, {2e-3, 2e-4, 2e-5, 2e-6, 2e-7});
    EXPECT_LE(smooth[3], 1.05 * smooth[2]);
    EXPECT_LE(smooth[4], 1.05 * smooth[2]);
    // strict, the same path has a jump
    const auto strict = slopes(sweep, {}, {2e-3, 2e-4, 2e-5});
    if (!sweep.boxed()) {
      EXPECT_GE(strict[2], 50.0 * strict[0]);
    }
  });
}

TEST(SolverSingular, AnswerIsThatOfTheDefinition) {
  each_sweep(kSeeds, [](const SingularSweep& sweep) {
    for (const double s : {0.2, 0.09, 0.05, -0.03, 1e-2, 1e-3, 1e-5, 1e-9, 1e-12, 0.0}) {
      SCOPED_TRACE("s = " + std::to_string(s));
      const Hierarchy levels = sweep.at(s);
      SmoothReference reference(SingularSweep::kUnknowns, SingularSweep::kRho);
      Vector x_above = Vector::Zero(SingularSweep::kUnknowns);
      for (std::size_t k = sweep.boxed() ? 1 : 0; k < levels.size(); ++k) {
        const Vector x = answer_until(levels, k + 1, kSmooth);
        const Eigen::MatrixXd& B = reference.basis();
        const Vector t = B.completeOrthogonalDecomposition().solve(x - x_above);
        EXPECT_TRUE(near(B * t, x - x_above, 1e-9));
        const Vector residual = levels[k].A * x - levels[k].lower;
        const Vector force = SingularSweep::kRho * SingularSweep::kRho * t +
                             B.transpose() * levels[k].A.transpose() * residual;
        // limits that x stands at push back
        Matrix limits(0, B.cols());
        for (Index i = 0; sweep.boxed() && i < x.size(); ++i) {
          // 1e-12 is what a level may break a limit by, and there are seven
          EXPECT_LE(std::abs(x[i]) - SingularSweep::kBox, 1e-11);
          if (std::abs(x[i]) < SingularSweep::kBox - 1e-11) continue;
          limits.conservativeResize(limits.rows() + 1, Eigen::NoChange);
          limits.row(limits.rows() - 1) = std::copysign(1.0, x[i]) * B.row(i);
        }
        const NonnegativeLeastSquares balance(limits.cast<long double>(),
                                              force.cast<long double>());
        EXPECT_LE(balance.residual().norm(), 1e-8L);
        if (!sweep.boxed()) {
          EXPECT_TRUE(near(x, x_above + reference.step(levels[k], x_above), 1e-9));
        }
        reference.close(levels[k]);
        x_above = x;
      }
    }
  });
}

TEST(SolverSingular, BoundedDownToNothing) {
  each_sweep(kSeeds, [](const SingularSweep& sweep) {
    Solver warm(SingularSweep::kUnknowns, kSmooth);
    for (int decade = 0; decade <= 48; ++decade) {
      const double s = std::pow(10.0, -0.25 * decade);
      const Hierarchy levels = sweep.at(s);
      // |t| <= |residual| / (2 rho): the largest of sigma / (sigma^2 + rho^2)
      double most = 0.0;
      for (const Level& level : levels) {
        if (level.bounds) continue;
        most += (level.lower.norm() + level.A.norm() * most) / (2.0 * SingularSweep::kRho);
      }
      const Vector x = warm.solve(levels).x;
      EXPECT_EQ(to_string(warm.solution().status), "solved");
      EXPECT_LE(x.norm(), most);
      EXPECT_TRUE(near(x, answer(levels, kSmooth), 1e-8)) << "s = " << s;
    }
  });
}

TEST(SolverSingular, NoEffectAwayFromSingularity) {
  // singular values at least rho: none of random rows of many more unknowns is near 0.1
  each_sweep(kSeeds, [](const SingularSweep& sweep) {
    const SingularSweep weaker(false, sweep.boxed(), kSeeds, 0.01);
    for (double s = 0.2; s <= 1.0; s += 0.1) {
      const Hierarchy levels = weaker.at(s);
      EXPECT_EQ(answer(levels, kSmooth), answer(levels, {})) << "s = " << s;
    }
  });
}

TEST(SolverSingular, LeakIsWithinItsBound) {
  double worst = 0.0;
  each_sweep(kSeeds, [&](const SingularSweep& sweep) {
    const SmoothReference reference(SingularSweep::kUnknowns, SingularSweep::kRho);
    const double rate = reference.most_leak(SingularSweep::kRho) / (2.0 * SingularSweep::kRho);
    for (double s = 0.0; s <= 0.2; s += 0.005) {
      const Hierarchy levels = sweep.at(s);
      const std::size_t singular = sweep.singular();
      const Vector x_own = answer_until(levels, singular + 1, kSmooth);
      Vector x = x_own;
      double residuals = 0.0;
      for (std::size_t k = singular + 1; k < levels.size(); ++k) {
        residuals += (levels[k].lower - levels[k].A * x).norm();
        x = answer_until(levels, k + 1, kSmooth);
      }
      const double leak = (levels[singular].A * (x - x_own)).norm();
      worst = std::max(worst, leak);
      // it is proven without limits only; with this box it holds, too (at most 0.3 of it)
      EXPECT_LE(leak, rate * residuals + 1e-9) << "s = " << s;
    }
  });
  EXPECT_GT(worst, 0.1);  // there is a price: residuals here are up to 16
}

TEST(SolverSingular, ReceiverWithoutRegularisationStaysStrict) {
  each_sweep(1, [](const SingularSweep& sweep) {
    Hierarchy levels = sweep.at(0.03);
    levels.back().rho = 0.0;
    EXPECT_EQ(answer(levels, kSmooth), answer(levels, {}));
  });
}

TEST(SolverSingular, AdaptiveRegularisationByHand) {
  // sigma = 1 and 0.2, threshold 0.4: rho^2 = 0.25 (1 - 0.25) = 0.1875
  const Level level = equality(Matrix{{1.0, 0.0}, {0.0, 0.2}}, Vector{{1.0, 1.0}}, 0.5);
  SolverOptions options{.regularization = Regularization::Adaptive, .singular_threshold = 0.4};
  EXPECT_TRUE(near(answer({level}, options), Vector{{1.0 / 1.1875, 0.2 / 0.2275}}, 1e-14));
  // at the threshold, none; a row that depends on the other, all of it
  options.singular_threshold = 0.2;
  EXPECT_TRUE(near(answer({level}, options), Vector{{1.0, 5.0}}, 1e-13));
  const Level twice = equality(Matrix{{1.0, 0.0}, {1.0, 0.0}}, Vector{{1.0, 1.0}}, 0.5);
  EXPECT_TRUE(near(answer({twice}, options), Vector{{2.0 / 2.25, 0.0}}, 1e-14));
}

// claim R23: no regularisation error away from singularity, a bounded x near it
TEST(SolverSingular, AdaptiveRegularisationVanishesAwayFromSingularity) {
  constexpr double kThreshold = SingularSweep::kRho;
  const SolverOptions adaptive{.regularization = Regularization::Adaptive,
                               .singular_threshold = kThreshold};
  int exact = 0;
  each_sweep(kSeeds, [&](const SingularSweep& sweep) {
    const SingularSweep without = sweep.with_rho(0.0);
    for (int decade = 0; decade <= 48; ++decade) {
      const double s = std::pow(10.0, -0.25 * decade);
      SCOPED_TRACE("s = " + std::to_string(s));
      // the singular level is the last
      const std::size_t end = sweep.singular() + 1;
      const Vector x = answer_until(sweep.at(s), end, adaptive);
      SmoothReference reference(SingularSweep::kUnknowns, SingularSweep::kRho);
      double most = 0.0, least = 1.0;
      for (std::size_t k = sweep.boxed() ? 1 : 0; k < end; ++k) {
        const Level level = sweep.at(s)[k];
        // sigma / (sigma^2 + rho_k^2) <= 1 / rho where the threshold is rho
        most += (level.lower.norm() + level.A.norm() * most) / SingularSweep::kRho;
        least = std::min(least, reference.smallest(level));
        reference.close(level);
      }
      EXPECT_LE(x.norm(), most);
      if (least < 1.01 * kThreshold) continue;
      ++exact;
      EXPECT_EQ(x, answer_until(without.at(s), end, {}));
    }
  });
  EXPECT_GE(exact, 50);
}

TEST(SolverSingular, OptionsAreCheckedAndNamed) {
  for (const char* name : {"strict", "smooth"}) EXPECT_EQ(to_string(handover_named(name)), name);
  for (const char* name : {"constant", "adaptive"}) {
    EXPECT_EQ(to_string(regularization_named(name)), name);
  }
  EXPECT_EQ(error_text([] { static_cast<void>(handover_named("soft")); }),
            "handover 'soft' does not exist; there are: strict, smooth");
  EXPECT_EQ(error_text([] { static_cast<void>(regularization_named("x")); }),
            "regularization 'x' does not exist; there are: constant, adaptive");
  EXPECT_TRUE(contains(error_text([] { Solver(2, {.singular_threshold = 0.0}); }),
                       "singular_threshold must be finite and positive"));
}

TEST(SolverSingular, NothingIsAllocatedInASolve) {
  const SolverOptions both{.handover = Handover::Smooth,
                           .regularization = Regularization::Adaptive};
  each_sweep(1, [&](const SingularSweep& sweep) {
    Solver solver(SingularSweep::kUnknowns, both);
    const Hierarchy regular = sweep.at(0.9), singular = sweep.at(1e-3);
    solver.reserve(regular);
    const hurcules_test::NoAllocation none;
    static_cast<void>(solver.solve(regular));
    static_cast<void>(solver.solve(singular));
    EXPECT_EQ(none.count(), 0u);
  });
}

class SmoothOnEachClass : public EachClass {};

TEST_P(SmoothOnEachClass, SolvedProvenAndWarmLikeCold) {
  // rows at the rank tolerance may reduce accuracy, strict too: no worse than that
  const bool thin = is({"thin_cones"});
  each_problem(60, {0.1, 1e-2, 1e-3}, [&](const Hierarchy& levels, Draw&) {
    Solver strict(unknowns_of(levels));
    Solver solver(unknowns_of(levels), kSmooth);
    for (const char* start : {"cold", "warm"}) {
      SCOPED_TRACE(start);
      const Solution& solution = solver.solve(levels);
      const SolverStatus like = strict.solve(levels).status;
      if (thin && like != SolverStatus::Solved) continue;
      EXPECT_EQ(to_string(solution.status), "solved");
      EXPECT_LE(solution.optimality, kProven);
    }
  });
}

HURCULES_FOR_EACH_CLASS(SmoothOnEachClass);

}  // namespace
}  // namespace hurcules
