// Which reading of a force sensor counts as none: the weight of a tool behind it, say.
#pragma once

#include "hurcules/base/state.hpp"

namespace hurcules {

class Tare {
 public:
  // the mean of so many readings (1 or more), after the next one, is zero from then on
  void begin(double readings);
  // A start: zero is what the sensor says, until the tare that was asked for before the first start
  // and is taken anew at each.
  void restart();
  [[nodiscard]] bool begins() const { return left_ > size_; }  // with the next reading
  [[nodiscard]] bool runs() const { return left_ > 0.0; }
  // what is left of a reading [N]; 0 while it runs, but for a reading that is none
  [[nodiscard]] double off(double reading);
  void save(StateWriter& writer) const;
  void restore(StateReader& reader);

 private:
  double zero_ = 0.0, sum_ = 0.0;                    // [N]
  double left_ = 0.0, size_ = 0.0, at_start_ = 0.0;  // readings
};

}  // namespace hurcules
