// One thread at a time: a second one is refused what works without the interpreter's lock, and waits
// to read until the work rests.
//
//   const InUse in_use("Simulation", &self);
//   const py::gil_scoped_release release;
#pragma once

#include <pybind11/pybind11.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "hurcules/base/error.hpp"

namespace hurcules_bindings {

// Made and destroyed under the interpreter's lock, which guards the lists too.
class InUse {
  struct Work;

 public:
  // throws Error where another thread (or a callback within this one) works with one of them;
  // `name` is what the message calls them
  explicit InUse(const char* name, const void* object, const void* other = nullptr)
      : mine_{object, other} {
    await_turns();
    refuse(name);
    let_read();
    await_turns();
    refuse(name);
    for (const void* one : mine_) {
      if (one != nullptr) works().push_back({one, std::this_thread::get_id()});
    }
  }
  ~InUse() {
    std::erase_if(works(), [this](const Work& work) { return is_mine(work.object); });
  }
  InUse(const InUse&) = delete;
  InUse& operator=(const InUse&) = delete;

  // other threads that wait for it read now; the work rests until they have
  void let_read() {
    const auto waits = [this] {
      return std::ranges::any_of(waiting(), [this](const void* one) { return is_mine(one); });
    };
    if (!waits()) return;
    rest(true);
    while (waits()) pause();
    rest(false);
  }
  // a call that waits until no other thread works with the object, whose next work waits for it
  class Turn {
   public:
    explicit Turn(const void* object) : object_(object) {
      mine_ = std::ranges::none_of(works(), [this](const Work& work) { return is_here(work); });
      if (!mine_) return;
      while (std::ranges::find(queue(), object) != queue().end()) pause();
      wait(object);
      works().push_back({object, std::this_thread::get_id(), false, true});
    }
    ~Turn() {
      if (mine_) std::erase_if(works(), [this](const Work& work) { return is_here(work); });
    }
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;

   private:
    [[nodiscard]] bool is_here(const Work& work) const {
      return work.object == object_ && work.thread == std::this_thread::get_id();
    }
    const void* object_;
    bool mine_ = false;  // else within a work of this thread
  };

  // waits while another thread works with it; what is read after that wants the interpreter's lock
  // throughout; throws what Ctrl-C raises
  static void wait(const void* object) {
    const auto busy = [object](const Work& work) {
      return work.object == object && !work.rests && work.thread != std::this_thread::get_id();
    };
    if (std::ranges::none_of(works(), busy)) return;
    const Waiting here(object);
    while (std::ranges::any_of(works(), busy)) {
      pause();
      if (PyErr_CheckSignals() != 0) throw pybind11::error_already_set();
    }
  }

 private:
  struct Work {
    const void* object;
    std::thread::id thread;
    bool rests = false;
    bool is_turn = false;
  };
  struct Waiting {
    explicit Waiting(const void* one) : object(one) { waiting().push_back(object); }
    Waiting(const Waiting&) = delete;
    Waiting& operator=(const Waiting&) = delete;
    ~Waiting() { waiting().erase(std::ranges::find(waiting(), object)); }
    const void* object;
  };
  static std::vector<Work>& works() {
    static std::vector<Work> all;
    return all;
  }
  static std::vector<const void*>& waiting() {
    static std::vector<const void*> all;
    return all;
  }
  static std::vector<const void*>& queue() {
    static std::vector<const void*> all;
    return all;
  }
  static void pause() {
    const pybind11::gil_scoped_release release;
    std::this_thread::sleep_for(std::chrono::microseconds(50));
  }

  // a short call of another thread is waited for: it may run Python, which gives the lock away. The
  // next turn comes after what waits here.
  void await_turns() const {
    const auto turns = [this](const Work& work) {
      return work.is_turn && is_mine(work.object) && work.thread != std::this_thread::get_id();
    };
    if (std::ranges::none_of(works(), turns)) return;
    for (const void* one : mine_) queue().push_back(one);
    while (std::ranges::any_of(works(), turns)) pause();
    for (const void* one : mine_) queue().erase(std::ranges::find(queue(), one));
  }

  [[nodiscard]] bool is_mine(const void* object) const {
    return object == mine_[0] || object == mine_[1];
  }
  void refuse(const char* name) const {
    if (std::ranges::any_of(works(), [this](const Work& work) { return is_mine(work.object); }))
      throw hurcules::Error("this " + std::string(name) +
                            " is at work in another thread; one thread at a time may use it");
  }
  void rest(bool rests) {
    for (Work& work : works())
      if (is_mine(work.object)) work.rests = rests;
  }

  std::array<const void*, 2> mine_;
};

// a method, or a function of the object, that waits until no other thread works with it
template <typename Self, typename Result, typename... Args>
auto waiting(Result (Self::*method)(Args...)) {
  return [method](Self& self, Args... args) -> Result {
    const InUse::Turn turn(&self);
    return (self.*method)(std::forward<Args>(args)...);
  };
}
template <typename Self, typename Result, typename... Args>
auto waiting(Result (*function)(Self&, Args...)) {
  return [function](Self& self, Args... args) -> Result {
    const InUse::Turn turn(&self);
    return function(self, std::forward<Args>(args)...);
  };
}

}  // namespace hurcules_bindings
