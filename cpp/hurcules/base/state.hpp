// A snapshot as one flat list of numbers: what must be kept so that a run continues bit for bit.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "hurcules/base/types.hpp"

namespace hurcules {

// Each object with a memory between ticks has save(StateWriter&) and restore(StateReader&), in the
// same order.
class StateWriter {
 public:
  explicit StateWriter(std::vector<double>& out) : out_(out) {}
  void put(double value);  // NaN too: it is kept as a number that nobody uses
  void put(const ConstVectorRef& values);
  // the bits of a 64-bit word (a random generator), in two exact halves
  void put_bits(unsigned long long word);

 private:
  std::vector<double>& out_;
};

// FNV-1a, of these bytes after those that `so_far` is of
inline constexpr std::uint64_t kHashOfNothing = 0xcbf29ce484222325;
[[nodiscard]] std::uint64_t hash_of(std::string_view bytes, std::uint64_t so_far = kHashOfNothing);
// what tells the names that a snapshot belongs to from others: as much of it as a double holds
[[nodiscard]] double hash_of_names(std::initializer_list<const std::vector<std::string>*> lists,
                                   std::uint64_t so_far = kHashOfNothing);

class StateReader {
 public:
  // any: what somebody holds now and not a snapshot, so that every number may be NaN
  explicit StateReader(const std::vector<double>& in, bool any = false) : in_(in), any_(any) {}
  // each throws Error when the snapshot is too short for what is asked, or holds no such number
  [[nodiscard]] double get();                 // not NaN, but with any
  [[nodiscard]] double get_any();             // NaN too: a figure that has not happened
  [[nodiscard]] Index get_count(Index most);  // a whole number from 0 to most
  void get(VectorRef values);
  [[nodiscard]] unsigned long long get_bits();
  [[nodiscard]] bool at_end() const { return next_ == in_.size(); }

 private:
  const std::vector<double>& in_;
  bool any_;
  std::size_t next_ = 0;
};

}  // namespace hurcules
