// How a stretch went, in figures beside those of the thesis [T §4.4], and what it is judged by.
#pragma once

#include <string_view>
#include <vector>

#include "hurcules/mission/mission.hpp"

namespace hurcules {

// Errors of the tasks as they were measured last.
struct StretchErrors {
  double hand = 0.0;    // [m] the worse one
  double pitch = 0.0;   // [rad] the worse one
  double pelvis = 0.0;  // [m]
  double gaze = 0.0;    // [rad]
};

class StretchFigures {
 public:
  // coordinates whose limits tell the story
  struct Joints {
    Index hip = 0, left_shoulder = 0, right_shoulder = 0;
  };
  // `figures` is where the values are kept
  StretchFigures(const Robot& robot, std::vector<Figure>& figures);
  // the stretch begins; [s]
  void start(double time) { start_ = time; }
  void reset();

  void note_commanded(const TickReport& report, const StretchErrors& errors);
  void note_measured(const TickReport& report, const StretchErrors& errors);
  void note_stretched(double length);  // [m] of forward command
  // "" when hands and arms ended where they should and no motor saturated
  [[nodiscard]] std::string_view verdict() const;

  void save(StateWriter& writer) const;
  void restore(StateReader& reader);

 private:
  void set(std::size_t figure, double value) { figures_[figure].value = value; }
  void raise(std::size_t figure, double value);
  void note_limits(const TickReport& report, double pelvis);
  [[nodiscard]] bool is_unset(std::size_t figure) const;

  std::vector<Figure>& figures_;
  Joints joints_;
  double start_ = 0.0;  // [s]
  bool hip_locked_ = false;
};

}  // namespace hurcules
