#include "hurcules/sim/events.hpp"

namespace hurcules {

void EventList::add(const Event& event) {
  if (events_.size() == kRoom) {
    ++lost_;
    return;
  }
  events_.push_back(event);
}

void EventList::clear() {
  events_.clear();
  lost_ = 0;
}

void EventList::truncate(double time) {
  while (!events_.empty() && events_.back().time >= time) events_.pop_back();
}

}  // namespace hurcules
