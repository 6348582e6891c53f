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
 public:
  // throws Error where another thread (or a callback within this one) works with one of them;
  // `name` is what the message calls them
  explicit InUse(const char* name, const void* object, const void* other = nullptr)
      : mine_{object, other} {
    refuse(name);
    let_read();
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
  static void pause() {
    const pybind11::gil_scoped_release release;
    std::this_thread::sleep_for(std::chrono::microseconds(50));
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
    InUse::wait(&self);
    return (self.*method)(std::forward<Args>(args)...);
  };
}
template <typename Self, typename Result, typename... Args>
auto waiting(Result (*function)(Self&, Args...)) {
  return [function](Self& self, Args... args) -> Result {
    InUse::wait(&self);
    return function(self, std::forward<Args>(args)...);
  };
}

}  // namespace hurcules_bindings
