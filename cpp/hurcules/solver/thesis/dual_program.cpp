#include "hurcules/solver/thesis/dual_program.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>

#include "hurcules/solver/kernels/dense_decompositions.hpp"

namespace hurcules {

namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
// what is left of a unit row that depends on the working set
constexpr double kDependent = 1e-10;
// rounding of the target, relative to its largest entry
constexpr double kTargetRounding = 1e-14;
// rows of the set that are nearly parallel are met to rounding after so many corrections
constexpr int kRefinements = 3;

// In z = L'y with H = L L' the program is: the point nearest to z0 = L^-1 g with M z >= d, |M_i|
// = 1.
class NearestPoint {
 public:
  NearestPoint(const QuadraticProgram& program, const Eigen::LLT<Eigen::MatrixXd>& llt)
      : target_(llt.matrixL().solve(program.g)),
        M_(llt.matrixL().solve(program.C.transpose())),
        norm_(M_.colwise().norm()),
        ignored_(program.d.size(), false) {
    for (Index i = 0; i < M_.cols(); ++i) {
      if (norm_[i] > 0.0) M_.col(i) /= norm_[i];
    }
    d_ = program.d.cwiseQuotient(norm_);
    tolerance_ = program.tolerance.cwiseQuotient(norm_).array() +
                 kTargetRounding * target_.lpNorm<Eigen::Infinity>();
    z_ = target_;
  }

  bool solve(int max_changes) {
    for (int p = most_broken(); p >= 0; p = most_broken()) {
      if (!enter(p, max_changes)) return false;
      refresh();
    }
    return true;
  }

  [[nodiscard]] const Vector& z() const { return z_; }
  [[nodiscard]] int changes() const { return changes_; }
  [[nodiscard]] Vector multipliers() const {
    Vector result = Vector::Zero(d_.size());
    for (std::size_t j = 0; j < set_.size(); ++j) result[set_[j]] = lambda_[j] / norm_[set_[j]];
    return result;
  }

 private:
  [[nodiscard]] int most_broken() const {
    int worst = -1;
    double most = 0.0;
    for (int i = 0; i < d_.size(); ++i) {
      if (ignored_[i] || norm_[i] == 0.0) continue;
      const double broken = d_[i] - M_.col(i).dot(z_);
      if (broken > std::max(most, tolerance_[i])) {
        worst = i;
        most = broken;
      }
    }
    return worst;
  }

  [[nodiscard]] Eigen::MatrixXd columns() const {
    Eigen::MatrixXd result(target_.size(), set_.size());
    for (std::size_t j = 0; j < set_.size(); ++j) result.col(j) = M_.col(set_[j]);
    return result;
  }

  // row p enters; rows whose multiplier would turn negative leave on the way
  bool enter(int p, int max_changes) {
    double lambda_p = 0.0;
    while (changes_++ < max_changes) {
      const Eigen::MatrixXd W = columns();
      Eigen::VectorXd direction = M_.col(p), r(W.cols());
      if (W.cols() > 0) {
        r = W.householderQr().solve(direction);
        direction -= W * r;
      }
      const double slope = direction.squaredNorm();
      const double full =
          slope > kDependent * kDependent ? (d_[p] - M_.col(p).dot(z_)) / slope : kInf;
      int first = -1;
      double step = full;
      for (int j = 0; j < r.size(); ++j) {
        if (r[j] > 0.0 && lambda_[j] / r[j] < step) {
          step = lambda_[j] / r[j];
          first = j;
        }
      }
      if (std::isinf(step)) {  // a hierarchy always has a feasible point: this is rounding
        ignored_[p] = true;
        return true;
      }
      for (int j = 0; j < r.size(); ++j) lambda_[j] -= step * r[j];
      lambda_p += step;
      if (full < kInf) z_ += step * direction;
      if (first < 0) {
        set_.push_back(p);
        lambda_.push_back(lambda_p);
        return true;
      }
      set_.erase(set_.begin() + first);
      lambda_.erase(lambda_.begin() + first);
    }
    return false;
  }

  // point and multipliers of the set from the target, so that no step's rounding stays
  void refresh() {
    const Eigen::MatrixXd W = columns();
    if (W.cols() == 0) {
      z_ = target_;
      return;
    }
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(W);
    const auto R = qr.matrixQR().topRows(W.cols()).triangularView<Eigen::Upper>();
    Eigen::VectorXd d(W.cols()), lambda = Eigen::VectorXd::Zero(W.cols());
    for (std::size_t j = 0; j < set_.size(); ++j) d[j] = d_[set_[j]];
    z_ = target_;
    for (int pass = 0; pass < kRefinements; ++pass) {
      Eigen::VectorXd u = d - W.transpose() * z_;
      R.transpose().solveInPlace(u);
      Eigen::VectorXd move = Eigen::VectorXd::Zero(z_.size());
      move.head(u.size()) = u;
      z_ += qr.householderQ() * move;
      R.solveInPlace(u);
      lambda += u;
    }
    for (std::size_t j = 0; j < set_.size(); ++j) lambda_[j] = std::max(0.0, lambda[j]);
  }

  Vector target_, z_;
  Eigen::MatrixXd M_;  // (size, rows): a row of the program in z is a column here
  Vector norm_, d_, tolerance_;
  std::vector<bool> ignored_;
  std::vector<int> set_;
  std::vector<double> lambda_;
  int changes_ = 0;
};

}  // namespace

QuadraticAnswer minimize(const QuadraticProgram& program, int max_changes) {
  QuadraticAnswer answer;
  const Eigen::LLT<Eigen::MatrixXd> llt(program.H);
  if (llt.info() != Eigen::Success) {
    answer.y.setZero(program.g.size());
    answer.multipliers.setZero(program.d.size());
    return answer;
  }
  NearestPoint nearest(program, llt);
  answer.optimal = nearest.solve(max_changes);
  answer.y = llt.matrixU().solve(nearest.z());
  answer.multipliers = nearest.multipliers();
  answer.changes = nearest.changes();
  return answer;
}

}  // namespace hurcules
