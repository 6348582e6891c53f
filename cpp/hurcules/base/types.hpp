// Eigen aliases and the index types of the house. Storage order is chosen here, once.
#pragma once

#include <Eigen/Core>

// With AVX Eigen aligns to 32 bytes, and what one side allocates the other cannot free.
#if EIGEN_MAX_ALIGN_BYTES != 16 || !EIGEN_MALLOC_ALREADY_ALIGNED
// clang-format off
#error "hurcules wants -DEIGEN_MAX_ALIGN_BYTES=16 -DEIGEN_MALLOC_ALREADY_ALIGNED=1 (hurcules::hurcules sets them)"
// clang-format on
#endif

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

using Flags = Eigen::Array<bool, Eigen::Dynamic, 1>;
using FlagsRef = Eigen::Ref<const Flags>;

using Index = Eigen::Index;

}  // namespace hurcules
