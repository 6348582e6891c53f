#include "hurcules/solver/sensitivity/level_report.hpp"

#include <algorithm>

#include "hurcules/solver/kernels/dense_decompositions.hpp"
#include "hurcules/solver/sensitivity/level_kkt_system.hpp"
#include "hurcules/solver/sensitivity/nullspace_derivative.hpp"

namespace hurcules {

namespace {

// of the equality rows of level k on what `above` leaves free
Vector singular_values(const SolvedHierarchy& solved, int k, const EqualityRows& above) {
  std::vector<int> rows;
  for (int i = solved.begin(k); i < solved.begin(k + 1); ++i) {
    if (solved.row(i).equality) rows.push_back(i);
  }
  const Index free = solved.unknowns() - above.space.size();
  const Index count = std::min<Index>(static_cast<Index>(rows.size()), free);
  if (count == 0) return Vector();
  Eigen::MatrixXd projected(static_cast<Index>(rows.size()), solved.unknowns());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    projected.row(static_cast<Index>(i)) = above.space.free_part(solved.dense(rows[i]));
  }
  return Eigen::JacobiSVD<Eigen::MatrixXd>(projected).singularValues().head(count);
}

// the part of the violation that a step in the level's own directions could remove
void split_violation(const SolvedHierarchy& solved, int k, const LevelKktSystem& piece,
                     LevelReport& report) {
  const int begin = solved.begin(k);
  const Index m = solved.begin(k + 1) - begin;
  report.infeasible.resize(m);
  for (Index i = 0; i < m; ++i) {
    report.infeasible[i] = solved.violation(begin + static_cast<int>(i), piece.x);
  }
  report.regularized.setZero(m);
  if (piece.rho == 0.0) return;
  const Vector regularized = piece.U * (piece.U.transpose() * piece.e);
  for (std::size_t i = 0; i < piece.own.size(); ++i) {
    report.regularized[piece.own[i].row - begin] = regularized[static_cast<Index>(i)];
  }
  report.infeasible -= report.regularized;
}

// where directions were handed over
std::vector<LevelReport> reports_in_directions(const SolvedHierarchy& solved) {
  std::vector<LevelReport> reports(solved.final_levels());
  const std::vector<NullspaceDerivative> directions = nullspace_derivatives(solved);
  for (int k = 0; k < solved.final_levels(); ++k) {
    LevelReport& report = reports[k];
    report.rho = solved.rho(k);
    report.singular_values = directions[k].singular_values();
    report.rank = directions[k].rank();
    report.handed_over = directions[k].handed_over();
    split_violation(solved, k, LevelKktSystem(solved, k, directions[k].basis()), report);
  }
  return reports;
}

}  // namespace

std::vector<LevelReport> level_reports(const SolvedHierarchy& solved) {
  if (solved.handed_over()) return reports_in_directions(solved);
  std::vector<LevelReport> reports(solved.final_levels());
  EqualityRows above(solved.unknowns());
  for (int k = 0; k < solved.final_levels(); ++k) {
    LevelReport& report = reports[k];
    report.rho = solved.rho(k);
    report.singular_values = singular_values(solved, k, above);
    split_violation(solved, k, LevelKktSystem(solved, k, above), report);
    const Index taken = above.space.size();
    above.add_level(solved, k);
    report.rank = above.space.size() - taken;
    report.handed_over.setOnes(report.singular_values.size());
    report.handed_over.head(report.rank).setZero();
  }
  return reports;
}

}  // namespace hurcules
