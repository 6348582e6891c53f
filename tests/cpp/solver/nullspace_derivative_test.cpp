// Strategy: B B', which every answer behind a smooth transition is made of, against dense algebra
// from the definition alone (smooth_reference.hpp); its derivative against central differences of
// that. The derivatives of x are in Python (test_sensitivity_singular.py).
#include "hurcules/solver/sensitivity/nullspace_derivative.hpp"

#include <gtest/gtest.h>

#include "hurcules/solver/solver.hpp"
#include "support/expect.hpp"
#include "support/singular_sweep.hpp"
#include "support/smooth_reference.hpp"

namespace hurcules {
namespace {

using namespace hurcules_test;

constexpr double kSigma = 0.03, kStep = 1e-6;

std::vector<NullspaceDerivative> directions_of(const Hierarchy& levels) {
  Solver solver(SingularSweep::kUnknowns, {.handover = Handover::Smooth});
  static_cast<void>(solver.solve(levels));
  return nullspace_derivatives(*solver.solved());
}

// B B' behind the level that hands over; p of the levels below stays
Matrix square(const SingularSweep& sweep, const Hierarchy& levels) {
  SmoothReference reference(SingularSweep::kUnknowns, SingularSweep::kRho);
  for (std::size_t k = sweep.boxed() ? 1 : 0; k <= sweep.singular(); ++k)
    reference.close(levels[k]);
  return reference.basis() * reference.basis().transpose();
}

TEST(NullspaceDerivative, AreThoseOfTheDefinition) {
  each_sweep(4, [](const SingularSweep& sweep) {
    for (const double s : {0.5, 0.05, 1e-3, 1e-9, 0.0}) {
      const Hierarchy levels = sweep.at(s);
      const NullspaceDerivative last = directions_of(levels)[sweep.singular()];
      const Matrix behind = last.behind();
      EXPECT_TRUE(near(behind * behind.transpose(), square(sweep, levels), 1e-7)) << "s = " << s;
      EXPECT_EQ(last.handed_over().size(), 3);
      EXPECT_EQ(last.handed_over()[2] > 0.0, last.singular_values()[2] < SingularSweep::kRho);
    }
  });
}

TEST(NullspaceDerivative, MoveByTheirDerivative) {
  each_sweep(4, [](const SingularSweep& sweep) {
    const std::size_t k = sweep.singular();
    const NullspaceDerivative last = directions_of(sweep.at(kSigma))[k];
    // only the level itself moves, along the sweep: what it was left stands
    const Hierarchy before = sweep.at(kSigma - kStep), after = sweep.at(kSigma + kStep);
    const Index n = SingularSweep::kUnknowns;
    const DirectionsChange change{.A = (after[k].A - before[k].A) / (2.0 * kStep),
                                  .B = Matrix::Zero(n, n)};
    const Matrix B = last.behind(), dB = last.behind_change(change);
    const Matrix wanted = (square(sweep, after) - square(sweep, before)) / (2.0 * kStep);
    EXPECT_TRUE(near(dB * B.transpose() + B * dB.transpose(), wanted, 1e-5));
  });
}

}  // namespace
}  // namespace hurcules
