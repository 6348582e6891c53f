#include "hurcules/solver/sensitivity/level_sensitivity.hpp"

namespace hurcules {

namespace {

using Target = DecidingRow::Target;
using Rows = std::vector<DecidingRow>;
using Changes = std::vector<LevelChange>;

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

// dB t, (n)
Vector turned_step(const LevelKktSystem& piece, const Matrix& dB) {
  if (dB.size() == 0) return Vector::Zero(piece.t.size());
  return dB * piece.t;
}

// what C t, V t or W t has to change by while x_above changes by dx_above and B t by dB t:
// a t = target - a x_above, or 0 where the target is the present value
Vector value_changes(const SolvedHierarchy& solved, const LevelKktSystem& piece, const Rows& rows,
                     const Changes& changes, const Moved& moved) {
  const Matrix dA = row_changes(solved, rows, changes);
  const Vector turned = turned_step(piece, moved.B);
  Vector change(dA.rows());
  for (std::size_t j = 0; j < rows.size(); ++j) {
    const Index i = static_cast<Index>(j);
    const Vector a = solved.dense(rows[j].row);
    change[i] = rows[j].target == Target::Present
                    ? -dA.row(i).dot(piece.x - piece.x_above)
                    : target_change(solved, rows[j], changes) - dA.row(i).dot(piece.x) -
                          a.dot(moved.x_above);
    change[i] -= a.dot(turned);
  }
  return change;
}

// f as it acts on t, where x feels df and B turns under the force f
Vector turned_force(const LevelKktSystem& piece, const Vector& df, const Vector& f,
                    const Matrix& dB) {
  Vector change = piece.on_step(df);
  if (dB.size() > 0) change += dB.transpose() * f;
  return change;
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

// value_changes, transposed: `value` (rows) is the gradient in the values, A_bar that in dA from
// the forces; `step_bar` is that in B t
void add_values(const SolvedHierarchy& solved, const LevelKktSystem& piece, const Rows& rows,
                const Vector& value, Matrix A_bar, Moved& bar, Vector& step_bar,
                Changes& gradient) {
  const Vector step = piece.x - piece.x_above;
  for (std::size_t j = 0; j < rows.size(); ++j) {
    const Index i = static_cast<Index>(j);
    const bool present = rows[j].target == Target::Present;
    const Vector pushed = value[i] * solved.dense(rows[j].row);
    A_bar.row(i) -= value[i] * (present ? step : piece.x).transpose();
    if (!present) bar.x_above -= pushed;
    step_bar -= pushed;
  }
  add_gradient(solved, rows, value, A_bar, gradient);
}

}  // namespace

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

Vector advance(const SolvedHierarchy& solved, const LevelKktSystem& piece, const Changes& changes,
               const Moved& moved) {
  const auto rows = [&](const Rows& which) { return row_changes(solved, which, changes); };
  const auto values = [&](const Rows& which) {
    return value_changes(solved, piece, which, changes, moved);
  };
  const Vector dx = moved.x_above + turned_step(piece, moved.B);
  const Matrix dC = rows(piece.fixed), dV = rows(piece.own);
  const Vector force = turned_force(piece, dV.transpose() * piece.e + dC.transpose() * piece.mu,
                                    piece.force, moved.B) +
                       2.0 * piece.rho * moved.rho * piece.t;
  Vector dt = piece.C.solve(values(piece.fixed));
  dt += piece.step(values(piece.own) - piece.V * dt, force);
  if (piece.rho > 0.0) return dx + piece.step_in_x(dt);
  // the smallest step moves along what the violation leaves open
  const Vector force_of_step = turned_force(piece,
                                            dV.transpose() * piece.Vp + dC.transpose() * piece.q +
                                                rows(piece.keeping).transpose() * piece.s,
                                            piece.force_of_step, moved.B);
  const Vector pull = piece.Z * (piece.Z.transpose() * force_of_step);
  const Vector missing = values(piece.keeping) - piece.W * (dt - pull);
  return dx + piece.step_in_x(dt - pull + piece.W_inverse * missing);
}

Moved retreat(const SolvedHierarchy& solved, const LevelKktSystem& piece, const Vector& x_bar,
              Changes& gradient) {
  const Vector whole_bar = piece.on_step(x_bar);
  Vector pull = Vector::Zero(x_bar.size()), kept = Vector::Zero(piece.W.rows());
  if (piece.rho == 0.0) {
    kept = piece.W_inverse.transpose() * whole_bar;
    pull = piece.Z * (piece.Z.transpose() * (whole_bar - piece.W.transpose() * kept));
  }
  const Vector t_bar = whole_bar - piece.W.transpose() * kept;
  const LevelKktSystem::StepGradient step = piece.step_transposed(t_bar);
  const Vector fixed = piece.C.solve_transposed(t_bar - piece.V.transpose() * step.right);
  const Vector force = piece.step_in_x(step.push), pulled = piece.step_in_x(pull);
  Moved bar{.x_above = x_bar, .B = {}, .rho = 2.0 * piece.rho * step.push.dot(piece.t)};
  Vector step_bar = x_bar;
  const auto add = [&](const Rows& rows, const Vector& value, const Matrix& A_bar) {
    add_values(solved, piece, rows, value, A_bar, bar, step_bar, gradient);
  };
  add(piece.own, step.right, piece.e * force.transpose() - piece.Vp * pulled.transpose());
  add(piece.fixed, fixed, piece.mu * force.transpose() - piece.q * pulled.transpose());
  add(piece.keeping, kept, -piece.s * pulled.transpose());
  if (piece.B.size() > 0) {
    bar.B = step_bar * piece.t.transpose() + piece.force * step.push.transpose() -
            piece.force_of_step * pull.transpose();
  }
  return bar;
}

}  // namespace hurcules
