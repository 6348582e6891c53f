// A way of all coordinates through keys, from where they are at its beginning: smooth in time (rest
// to rest), straight between two keys, or rounded at them where nothing that follows smooths it.
//
//   u = s(t / T),  s(x) = x^3 (10 - 15 x + 6 x^2),   q(u) between the keys by their shares
//
// Rounded: a cubic of Hermite between two keys, its slope at a key the harmonic mean of those of the
// straight lines on both sides, 0 at a turning point (Fritsch and Butland 1984): no overshoot.
#pragma once

#include <vector>

#include "hurcules/base/state.hpp"
#include "hurcules/mission/phase.hpp"

namespace hurcules {

// 0 to 1 with rest at both ends
[[nodiscard]] double smooth_step(double x);
inline constexpr double kSmoothPeak = 1.875;  // its largest slope

// The coordinates that a key means: the one of this name, or the left and the right one, "SP" for
// "LSP" and "RSP"; empty: none.
[[nodiscard]] std::vector<Index> coordinates_of(const std::string& name,
                                                const std::vector<std::string>& coordinates);

class PostureWay {
 public:
  // coordinates: all names, (n)
  PostureWay(const std::vector<PostureKey>& keys, const std::vector<std::string>& coordinates,
             double seconds, bool rounded = false);
  void start(const Vector& q);  // [rad] (n)
  // the mean velocity [rad/s] (n) over the dt [s] after a time [s] since the start
  void velocity(double time, double dt, VectorRef out);
  void save(StateWriter& writer) const { writer.put(points_.col(0)); }
  void restore(StateReader& reader);

 private:
  void place(double time, Vector& q) const;
  void fill();

  double seconds_;
  bool rounded_;
  Vector shares_;      // (k + 1)
  Matrix angles_;      // (n, k) NaN: as at the start
  Matrix points_;      // (n, k + 1)
  Matrix slopes_;      // (n, k + 1) by the share, of a rounded way
  Vector now_, next_;  // (n) scratch
};

}  // namespace hurcules
