#include "hurcules/solver/sensitivity/sensitivity.hpp"

#include <string>

#include "hurcules/base/error.hpp"

namespace hurcules {

namespace {

using Rows = std::vector<DecidingRow>;
using Changes = std::vector<LevelChange>;

std::string shape(Index rows, Index columns) {
  return std::string("(") + std::to_string(rows) + ", " + std::to_string(columns) + ")";
}

}  // namespace

Sensitivity::Sensitivity(std::shared_ptr<const SolvedHierarchy> solved)
    : solved_(std::move(solved)) {
  require_solved(solved_.get());
  require(solved_->levels() > 0, "sensitivity wants a solve before it");
  require(solved_->final_levels() == solved_->levels() &&
              solved_->status() != SolverStatus::InvalidInput,
          "sensitivity wants a solved hierarchy, this solve ended with " +
              to_string(solved_->status()));
  pieces_.reserve(solved_->levels());
  if (solved_->handed_over() || solved_->rules().adaptive) {
    directions_ = nullspace_derivatives(*solved_);
    receivers_ = receivers(*solved_);
  }
  EqualityRows above(solved_->unknowns());
  for (int k = 0; k < solved_->levels(); ++k) {
    if (solved_->handed_over()) {
      pieces_.emplace_back(*solved_, k, directions_[k].basis());
      continue;
    }
    // what equality rows leave is known better from them
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

DirectionsChange Sensitivity::directions_change(int k, const Changes& changes,
                                                const Matrix& dB) const {
  const auto rho_change = [&](int level) {
    return level < static_cast<int>(changes.size()) ? changes[level].rho : 0.0;
  };
  Rows rows;
  for (const int i : directions_[k].rows()) rows.push_back({i});
  DirectionsChange change{.A = row_changes(*solved_, rows, changes), .B = dB, .rho = rho_change(k)};
  const Receiver& receiver = receivers_[k];
  if (receiver.level < 0) return change;
  // p = rho / |a|
  const double norm = solved_->row(receiver.row).norm;
  const Matrix da = row_changes(*solved_, {{receiver.row}}, changes);
  change.receiver = (rho_change(receiver.level) -
                     receiver.p / norm * da.row(0).dot(solved_->dense(receiver.row))) /
                    norm;
  return change;
}

void Sensitivity::add_directions_gradient(int k, const DirectionsChange& bar,
                                          Changes& gradient) const {
  const auto add_row = [&](int i, const Vector& a_bar) {
    const Row& row = solved_->row(i);
    if (gradient[row.level].A.size() > 0) gradient[row.level].A.row(row.row) += a_bar.transpose();
  };
  const std::vector<int>& rows = directions_[k].rows();
  for (std::size_t i = 0; i < rows.size(); ++i)
    add_row(rows[i], bar.A.row(static_cast<Index>(i)).transpose());
  gradient[k].rho += bar.rho;
  const Receiver& receiver = receivers_[k];
  if (receiver.level < 0) return;
  const double norm = solved_->row(receiver.row).norm;
  gradient[receiver.level].rho += bar.receiver / norm;
  add_row(receiver.row, -bar.receiver * receiver.p / (norm * norm) * solved_->dense(receiver.row));
}

Vector Sensitivity::forward(const Changes& changes) const {
  check(changes);
  const Index n = solved_->unknowns();
  Moved moved{.x_above = Vector::Zero(n), .B = {}};
  Matrix dB = Matrix::Zero(n, n);
  for (int k = 0; k < solved_->levels(); ++k) {
    if (directions_.empty()) {
      moved.rho = k < static_cast<int>(changes.size()) ? changes[k].rho : 0.0;
    } else {
      const DirectionsChange change = directions_change(k, changes, dB);
      moved.rho = directions_[k].rho_change(change);
      if (solved_->handed_over()) moved.B = dB;
      dB = directions_[k].behind_change(change);
    }
    moved.x_above = advance(*solved_, pieces_[k], changes, moved);
  }
  return moved.x_above;
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
  Matrix behind_bar = Matrix::Zero(n, n);
  for (int k = solved_->levels() - 1; k >= 0; --k) {
    Moved moved = retreat(*solved_, pieces_[k], bar, gradient);
    bar = moved.x_above;
    if (directions_.empty()) {
      gradient[k].rho += moved.rho;
      continue;
    }
    const Index m = static_cast<Index>(directions_[k].rows().size());
    DirectionsChange change{.A = Matrix::Zero(m, n), .B = Matrix::Zero(n, n)};
    if (solved_->handed_over()) change.B = moved.B;
    directions_[k].add_gradient(behind_bar, moved.rho, change);
    behind_bar = change.B;
    add_directions_gradient(k, change, gradient);
  }
  return gradient;
}

}  // namespace hurcules
