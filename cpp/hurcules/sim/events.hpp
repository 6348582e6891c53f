// What happened and when, without text until somebody reads it.
#pragma once

#include <string>
#include <vector>

#include "hurcules/base/types.hpp"

namespace hurcules {

enum class EventKind {
  PhaseStarted,
  LimitMet,
  LimitReleased,
  AlarmRaised,
  AlarmFell,
  Reacted,  // in a phase, as all that follow; its side and answer: as trouble and reaction in Cause
  Asked,
  Paused,
  Resumed,
  Unborne,  // the body that the robot is said to stand on bears nothing
};

struct Event {
  double time = 0.0;  // [s]
  EventKind kind = EventKind::PhaseStarted;
  Index what = 0;  // phase, coordinate, or quantity of the monitors
  int side = 0;    // -1 lower, 1 upper limit; which trouble
  int answer = 0;  // which reaction
};

class EventList {
 public:
  EventList() { events_.reserve(kRoom); }
  // does not grow in a tick: beyond its room events are counted only
  void add(const Event& event);
  void clear();
  // forgets what happened from this time on [s]
  void truncate(double time);
  [[nodiscard]] const std::vector<Event>& events() const { return events_; }
  [[nodiscard]] std::size_t lost() const { return lost_; }

 private:
  static constexpr std::size_t kRoom = 4096;
  std::vector<Event> events_;
  std::size_t lost_ = 0;
};

}  // namespace hurcules
