#include "hurcules/solver/sensitivity.hpp"

#include <string>

#include "hurcules/base/error.hpp"

namespace hurcules {

namespace {

using Target = DecidingRow::Target;
using Rows = std::vector<DecidingRow>;
using Changes = std::vector<LevelChange>;

std::string shape(Index rows, Index columns) {
  return std::string("(") + std::to_string(rows) + ", " + std::to_string(columns) + ")";
}

// the changes of a list of rows: dA (rows, n)
Matrix row_changes(const SolvedHierarchy& solved, const Rows& rows, const Changes& changes) {
  Matrix stacked = Matrix::Zero(static_cast<Index>(rows.size()), solved.unknowns());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Row& row = solved.row(rows[i].row);
    if (row.level >= static_cast<int>(changes.size())) continue;
    const Matrix& A = changes[row.level].A;
    if (A.size() > 0) stacked.row(static_cast<Index>(i)) = A.row(row.row);
  }
  return stacked;
}

double target_change(const SolvedHierarchy& solved, const DecidingRow& deciding,
                     const Changes& changes) {
  const Row& row = solved.row(deciding.row);
  if (deciding.target == Target::Present || row.level >= static_cast<int>(changes.size()))
    return 0.0;
  const LevelChange& change = changes[row.level];
  const double lower = change.lower.size() > 0 ? change.lower[row.row] : 0.0;
  const double upper = change.upper.size() > 0 ? change.upper[row.row] : 0.0;
  if (deciding.target == Target::Both) return 0.5 * (lower + upper);
  return deciding.target == Target::Lower ? lower : upper;
}

// what C t, V t or W t has to change by while x_above changes by dx_above:
// a t = target - a x_above, or 0 where the target is the present value
Vector value_changes(const SolvedHierarchy& solved, const LevelPiece& piece, const Rows& rows,
                     const Changes& changes, const Vector& dx_above) {
  const Matrix dA = row_changes(solved, rows, changes);
  Vector change(dA.rows());
  for (std::size_t j = 0; j < rows.size(); ++j) {
    const Index i = static_cast<Index>(j);
    change[i] = rows[j].target == Target::Present
                    ? -dA.row(i).dot(piece.x - piece.x_above)
                    : target_change(solved, rows[j], changes) - dA.row(i).dot(piece.x) -
                          solved.dense(rows[j].row).dot(dx_above);
  }
  return change;
}

// dx after the level of a piece, from dx_above
Vector advance(const SolvedHierarchy& solved, const LevelPiece& piece, int k,
               const Changes& changes, const Vector& dx_above) {
  const auto rows = [&](const Rows& which) { return row_changes(solved, which, changes); };
  const auto values = [&](const Rows& which) {
    return value_changes(solved, piece, which, changes, dx_above);
  };
  const Matrix dC = rows(piece.fixed), dV = rows(piece.own);
  Vector force = dV.transpose() * piece.e + dC.transpose() * piece.mu;
  if (k < static_cast<int>(changes.size()))
    force += 2.0 * piece.rho * changes[k].rho * (piece.x - piece.x_above);
  Vector dt = piece.C.solve(values(piece.fixed));
  dt += piece.step(values(piece.own) - piece.V * dt, force);
  if (piece.rho > 0.0) return dx_above + dt;
  // the smallest step moves along what the violation leaves open
  const Vector force_of_step = dV.transpose() * piece.Vp + dC.transpose() * piece.q +
                               rows(piece.keeping).transpose() * piece.s;
  const Vector pull = piece.Z * (piece.Z.transpose() * force_of_step);
  const Vector missing = values(piece.keeping) - piece.W * (dt - pull);
  return dx_above + dt - pull + piece.W_inverse * missing;
}

// gradients of rows and of their targets, added to the levels that they belong to
void add_gradient(const SolvedHierarchy& solved, const Rows& rows, const Vector& target,
                  const Matrix& A, Changes& gradient) {
  for (std::size_t j = 0; j < rows.size(); ++j) {
    const Index i = static_cast<Index>(j);
    const Row& row = solved.row(rows[j].row);
    LevelChange& level = gradient[row.level];
    if (level.A.size() > 0) level.A.row(row.row) += A.row(i);
    const double share = rows[j].target == Target::Both ? 0.5 : 1.0;
    if (rows[j].target == Target::Both || rows[j].target == Target::Lower)
      level.lower[row.row] += share * target[i];
    if (rows[j].target == Target::Both || rows[j].target == Target::Upper)
      level.upper[row.row] += share * target[i];
  }
}

// value_changes, transposed: `value` (rows) is the gradient in the values, `force` that in dA'
// weight
void add_values(const SolvedHierarchy& solved, const LevelPiece& piece, const Rows& rows,
                const Vector& value, Matrix A_bar, Vector& x_above_bar, Changes& gradient) {
  const Vector t = piece.x - piece.x_above;
  for (std::size_t j = 0; j < rows.size(); ++j) {
    const Index i = static_cast<Index>(j);
    const bool present = rows[j].target == Target::Present;
    A_bar.row(i) -= value[i] * (present ? t : piece.x).transpose();
    if (!present) x_above_bar -= value[i] * solved.dense(rows[j].row);
  }
  add_gradient(solved, rows, value, A_bar, gradient);
}

// advance, transposed: x_bar after the level -> x_bar before it
Vector retreat(const SolvedHierarchy& solved, const LevelPiece& piece, int k, const Vector& x_bar,
               Changes& gradient) {
  Vector pull = Vector::Zero(x_bar.size()), kept = Vector::Zero(piece.W.rows());
  if (piece.rho == 0.0) {
    kept = piece.W_inverse.transpose() * x_bar;
    pull = piece.Z * (piece.Z.transpose() * (x_bar - piece.W.transpose() * kept));
  }
  const Vector t_bar = x_bar - piece.W.transpose() * kept;
  const LevelPiece::StepGradient step = piece.step_transposed(t_bar);
  const Vector fixed = piece.C.solve_transposed(t_bar - piece.V.transpose() * step.right);
  Vector x_above_bar = x_bar;
  const auto add = [&](const Rows& rows, const Vector& value, const Matrix& A_bar) {
    add_values(solved, piece, rows, value, A_bar, x_above_bar, gradient);
  };
  add(piece.own, step.right, piece.e * step.force.transpose() - piece.Vp * pull.transpose());
  add(piece.fixed, fixed, piece.mu * step.force.transpose() - piece.q * pull.transpose());
  add(piece.keeping, kept, -piece.s * pull.transpose());
  gradient[k].rho += 2.0 * piece.rho * step.force.dot(piece.x - piece.x_above);
  return x_above_bar;
}

}  // namespace

Sensitivity::Sensitivity(std::shared_ptr<const SolvedHierarchy> solved)
    : solved_(std::move(solved)) {
  require_solved(solved_.get());
  require(solved_->final_levels() == solved_->levels() &&
              solved_->status() != SolverStatus::InvalidInput,
          "sensitivity wants a solved hierarchy, this solve ended with " +
              to_string(solved_->status()));
  EqualityRows above(solved_->unknowns());
  pieces_.reserve(solved_->levels());
  for (int k = 0; k < solved_->levels(); ++k) {
    pieces_.emplace_back(*solved_, k, above);
    above.add_level(*solved_, k);
  }
}

void Sensitivity::check(const Changes& changes) const {
  const int levels = solved_->levels();
  require(static_cast<int>(changes.size()) <= levels, "forward wants a change a level, at most " +
                                                          std::to_string(levels) + ", got " +
                                                          std::to_string(changes.size()));
  for (int k = 0; k < static_cast<int>(changes.size()); ++k) {
    const LevelChange& change = changes[k];
    const Index m = solved_->begin(k + 1) - solved_->begin(k), n = solved_->unknowns();
    const std::string where = "change of level " + std::to_string(k) + ": ";
    const auto fits = [m](const Vector& v) { return v.size() == 0 || v.size() == m; };
    require(fits(change.lower) && fits(change.upper),
            where + "lower and upper must have length " + std::to_string(m) + " or 0, got " +
                std::to_string(change.lower.size()) + " and " +
                std::to_string(change.upper.size()));
    require(change.A.size() == 0 || !solved_->is_bounds(k),
            where + "simple bounds have no A that could change");
    require(change.A.size() == 0 || (change.A.rows() == m && change.A.cols() == n),
            where + "A must be " + shape(m, n) + " or empty, got " +
                shape(change.A.rows(), change.A.cols()));
  }
}

Vector Sensitivity::forward(const Changes& changes) const {
  check(changes);
  Vector dx = Vector::Zero(solved_->unknowns());
  for (int k = 0; k < solved_->levels(); ++k) dx = advance(*solved_, pieces_[k], k, changes, dx);
  return dx;
}

std::vector<LevelChange> Sensitivity::transposed(const ConstVectorRef& x_bar) const {
  const Index n = solved_->unknowns();
  require(x_bar.size() == n, "transposed wants a gradient of length " + std::to_string(n) +
                                 ", got " + std::to_string(x_bar.size()));
  Changes gradient(solved_->levels());
  for (int k = 0; k < solved_->levels(); ++k) {
    const Index m = solved_->begin(k + 1) - solved_->begin(k);
    if (!solved_->is_bounds(k)) gradient[k].A.setZero(m, n);
    gradient[k].lower.setZero(m);
    gradient[k].upper.setZero(m);
  }
  Vector bar = x_bar;
  for (int k = solved_->levels() - 1; k >= 0; --k) {
    bar = retreat(*solved_, pieces_[k], k, bar, gradient);
  }
  return gradient;
}

}  // namespace hurcules
