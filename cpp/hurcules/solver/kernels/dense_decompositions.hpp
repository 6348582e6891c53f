// Eigen's decompositions of dynamic matrices, compiled once in dense_decompositions.cpp: each takes the compiler seconds.
#pragma once

#include <Eigen/QR>
#include <Eigen/SVD>

extern template class Eigen::HouseholderQR<Eigen::MatrixXd>;
extern template class Eigen::ColPivHouseholderQR<Eigen::MatrixXd>;
extern template class Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>;
extern template class Eigen::JacobiSVD<Eigen::MatrixXd>;
