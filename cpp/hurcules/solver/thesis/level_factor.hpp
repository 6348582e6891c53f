// One level's rows in the coordinates that it is left with: B = U S Y~', rank revealed.
#pragma once

#include <vector>

#include "hurcules/base/types.hpp"
#include "hurcules/solver/kernels/padded.hpp"

namespace hurcules {

enum class FactorKind { SingularValues, CompleteOrthogonal };

struct LevelFactor {
  FactorKind kind = FactorKind::SingularValues;
  Index rows = 0, rank = 0;
  Matrix Ut;  // U' in its upper left (rank, rows)
  Matrix S;   // in its upper left (rank, rank): diagonal, or upper triangular
};

// what a level needs only while it is factored
struct FactorRoom {
  void reserve(Index rows, Index columns);

  std::vector<Index> order;  // (rows)
  PaddedRows turned;         // (rank, rows and rank): T and W' beside it
  PaddedRows Y;              // (rank, columns)
  PaddedVector row;          // (columns)
  Vector squares;            // (rank)
};

// Factors B (rows, columns); its first `rank` rows become the orthonormal Y~'. Singular values, and
// pivots, below `tolerance` count as zero.
void factor(MatrixRef B, double tolerance, LevelFactor& level, FactorRoom& room);

// s (rank) = (S'S + rho^2 I)^+ S' s; `work` is (rank, rank) or larger  [T 3.3.38], [T 3.5.126]
void solve_damped(const LevelFactor& level, double rho, VectorRef s, MatrixRef work);
// c (rank) = S'^-1 c
void solve_transposed(const LevelFactor& level, VectorRef c);

}  // namespace hurcules
