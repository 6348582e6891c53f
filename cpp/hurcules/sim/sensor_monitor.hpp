// Whether what the encoders say can be true: the joints' servos act on it.
//
//   NotANumber  a reading is not finite
//   Stuck       a position has not changed by a bit although its reference moved by `tolerance`
//   Disagrees   over a window, the position moved otherwise than its speed says
//
// Stuck also catches a joint that cannot move, which is as good a reason to stop.
#pragma once

#include <vector>

#include "hurcules/base/state.hpp"
#include "hurcules/base/types.hpp"

namespace hurcules {

struct SensorMonitorOptions {
  // [rad] or [m]. The largest control error of the thesis is 7 mrad: a joint that works is nearer
  double tolerance = 0.015;
  double share = 0.05;  // of the way in the window, allowed on top for Disagrees
  int window = 100;     // [ticks]
};

// joint = factor * coordinate; coordinate -1: its reference stays
struct EncoderReference {
  Index coordinate = -1;
  double factor = 1.0;
};

class SensorMonitor {
 public:
  enum class Trouble { None, NotANumber, Stuck, Disagrees };
  struct Finding {
    Trouble trouble = Trouble::None;
    Index entry = 0;     // of the encoders
    bool speed = false;  // of encoder_speed, else encoder_position
  };
  SensorMonitor(std::vector<EncoderReference> references, double dt,
                const SensorMonitorOptions& options = {});
  void reset();
  // readings (m) and the coordinates' reference (n) of a tick
  [[nodiscard]] Finding look(const Vector& position, const Vector& speed, const Vector& q_des);
  void save(StateWriter& writer) const;
  void restore(StateReader& reader);

 private:
  [[nodiscard]] double reference(std::size_t entry, const Vector& q_des) const;

  std::vector<EncoderReference> references_;  // (m)
  double dt_;
  SensorMonitorOptions options_;
  bool begun_ = false;
  int ticks_ = 0;                      // of the window
  Vector last_, reference_at_change_;  // (m)
  Vector window_start_, way_;          // (m) position then, integral of the speed since
};

}  // namespace hurcules
