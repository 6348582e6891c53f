// Memory for the inner loops: rows that start on a vector boundary and end in zeros.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <memory>

#include "hurcules/base/types.hpp"

namespace hurcules {

// the length of a row of n numbers with its zeros: a multiple of the widest vector, four doubles
[[nodiscard]] constexpr Index padded(Index n) {
  return (n + 3) / 4 * 4;
}

// n doubles on a 64-byte boundary, zero at the start
class PaddedVector {
 public:
  void reserve(Index n) {
    if (n <= capacity_) return;
    const Index size = (n + 7) / 8 * 8;
    data_.reset(static_cast<double*>(std::aligned_alloc(64, sizeof(double) * size)));
    if (!data_) throw std::bad_alloc();
    std::fill_n(data_.get(), size, 0.0);
    capacity_ = size;
  }
  [[nodiscard]] double* data() { return data_.get(); }
  [[nodiscard]] const double* data() const { return data_.get(); }
  double& operator[](Index i) { return data_.get()[i]; }
  const double& operator[](Index i) const { return data_.get()[i]; }

 private:
  struct Free {
    void operator()(double* p) const { std::free(p); }
  };
  std::unique_ptr<double, Free> data_;
  Index capacity_ = 0;
};

// Rows of one padded length that can change between problems. Three rows of zeros stand behind the
// last, so that four rows can be taken at a time.
class PaddedRows {
 public:
  void reserve(Index rows, Index columns) { data_.reserve((rows + 3) * padded(columns)); }
  void shape(Index columns) { stride_ = padded(columns); }
  void set_zero(Index rows) { std::fill_n(data_.data(), rows * stride_, 0.0); }
  [[nodiscard]] Index stride() const { return stride_; }
  [[nodiscard]] double* row(Index i) { return data_.data() + i * stride_; }
  [[nodiscard]] const double* row(Index i) const { return data_.data() + i * stride_; }

 private:
  PaddedVector data_;
  Index stride_ = 0;
};

}  // namespace hurcules
