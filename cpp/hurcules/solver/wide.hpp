// A number kept as the sum of two long double, one the rounding of the other: about 38 digits on
// x86-64, 31 where long double is double.
//
// For the last way of a level alone (careful_level.hpp). A row that stands out by 1e-9, of which
// limits leave 1e-6, decides with 1e-15 of itself, and with 1e-18 beside a regularisation of 1e-9:
// long double has four digits of the one and none of the other. Sums and products are those of
// Knuth and Dekker, without error in long double; infinite and not-a-number stay what they are.
#pragma once

#include <cmath>
#include <limits>

namespace hurcules {

class Wide {
 public:
  using Part = long double;
  Wide() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): as from any smaller to a larger kind of number
  constexpr Wide(Part value) : high_(value), low_(0.0L) {}
  explicit constexpr operator double() const { return static_cast<double>(high_ + low_); }

  Wide operator-() const { return {-high_, -low_}; }
  Wide& operator+=(const Wide& b) { return *this = *this + b; }
  Wide& operator-=(const Wide& b) { return *this = *this - b; }
  Wide& operator/=(const Wide& b) { return *this = *this / b; }

  friend Wide operator+(const Wide& a, const Wide& b) {
    const Part sum = a.high_ + b.high_;
    const Part of_b = sum - a.high_;
    const Part error = (a.high_ - (sum - of_b)) + (b.high_ - of_b);
    return joined(sum, error + (a.low_ + b.low_));
  }
  friend Wide operator-(const Wide& a, const Wide& b) { return a + -b; }
  friend Wide operator*(const Wide& a, const Wide& b) {
    const Part product = a.high_ * b.high_;
    const Halves x = split(a.high_), y = split(b.high_);
    const Part error =
        ((x.high * y.high - product) + x.high * y.low + x.low * y.high) + x.low * y.low;
    return joined(product, error + (a.high_ * b.low_ + a.low_ * b.high_));
  }
  friend Wide operator/(const Wide& a, const Wide& b) {
    const Part first = a.high_ / b.high_;
    if (!std::isfinite(first)) return first;
    const Wide rest = a - b * first;
    return joined(first, rest.high_ / b.high_);
  }
  friend Wide sqrt(const Wide& a) {
    const Part root = std::sqrt(a.high_);
    if (!(root > 0.0L) || !std::isfinite(root)) return root;
    const Wide rest = a - Wide(root) * root;
    return joined(root, rest.high_ / (2.0L * root));
  }
  friend Wide abs(const Wide& a) { return a.high_ < 0.0L ? -a : a; }
  friend bool isinf(const Wide& a) { return std::isinf(a.high_); }
  friend bool operator==(const Wide& a, const Wide& b) {
    return a.high_ == b.high_ && a.low_ == b.low_;
  }
  friend bool operator<(const Wide& a, const Wide& b) {
    return a.high_ < b.high_ || (a.high_ == b.high_ && a.low_ < b.low_);
  }
  friend bool operator>(const Wide& a, const Wide& b) { return b < a; }
  friend bool operator<=(const Wide& a, const Wide& b) { return a < b || a == b; }
  friend bool operator>=(const Wide& a, const Wide& b) { return b <= a; }

 private:
  struct Halves {
    Part high, low;
  };
  constexpr Wide(Part high, Part low) : high_(high), low_(low) {}

  // the sum of a number and one that is smaller
  static Wide joined(Part large, Part small) {
    const Part sum = large + small;
    // infinite less infinite is no rounding
    if (!std::isfinite(sum)) return large;
    return {sum, small - (sum - large)};
  }
  // into two of half the digits each, whose products are exact
  static Halves split(Part a) {
    constexpr int kHalf = (std::numeric_limits<Part>::digits + 1) / 2;
    constexpr Part kFactor = static_cast<Part>(1ULL << kHalf) + 1.0L;
    const Part scaled = kFactor * a;
    const Part high = scaled - (scaled - a);
    return {high, a - high};
  }

  Part high_, low_;
};

}  // namespace hurcules
