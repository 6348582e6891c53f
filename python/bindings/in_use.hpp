// One thread at a time: a second one is refused what works without the interpreter's lock.
//
//   const InUse in_use("Simulation", &self);
//   const py::gil_scoped_release release;
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "hurcules/base/error.hpp"

namespace hurcules_bindings {

// Made and destroyed under the interpreter's lock, which guards the list too.
class InUse {
 public:
  // throws Error where another thread (or a callback within this one) works with one of them;
  // `name` is what the message calls them
  explicit InUse(const char* name, const void* object, const void* other = nullptr)
      : mine_{object, other} {
    const auto works = [](const void* one) { return std::ranges::find(all(), one) != all().end(); };
    if (works(object) || (other != nullptr && works(other)))
      throw hurcules::Error("this " + std::string(name) +
                            " is at work in another thread; one thread at a time may use it");
    for (const void* one : mine_) {
      if (one != nullptr) all().push_back(one);
    }
  }
  ~InUse() {
    for (const void* one : mine_) std::erase(all(), one);
  }
  InUse(const InUse&) = delete;
  InUse& operator=(const InUse&) = delete;

 private:
  static std::vector<const void*>& all() {
    static std::vector<const void*> objects;
    return objects;
  }
  std::array<const void*, 2> mine_;
};

}  // namespace hurcules_bindings
