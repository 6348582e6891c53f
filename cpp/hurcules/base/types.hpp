// Eigen aliases and the index types of the house. Storage order is chosen here, once.
#pragma once

#include <Eigen/Core>

namespace hurcules {

// numpy and MuJoCo are row-major, so every dynamic matrix here is; only the binding wall copies
using Vector = Eigen::VectorXd;
using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;

using VectorRef = Eigen::Ref<Vector>;
using MatrixRef = Eigen::Ref<Matrix>;
using ConstVectorRef = Eigen::Ref<const Vector>;
using ConstMatrixRef = Eigen::Ref<const Matrix>;

using Index = Eigen::Index;

}  // namespace hurcules
