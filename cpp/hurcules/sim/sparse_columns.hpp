// More columns in the rows of MuJoCo's sparse constraint Jacobian.
//
// A sparse row lists only the joints that move its two bodies. The belt that runs around a track is
// none of them, so its rows are written anew, further on in MuJoCo's arena, with a place for it.
// The next step takes that memory back.
#pragma once

#include <cstddef>

struct mjData_;

namespace hurcules {

// Memory at the far end of MuJoCo's arena, where its own stack lies, for as long as this lives.
// (mj_markStack is missing from MuJoCo's library where a program has the address sanitizer.)
class ArenaScratch {
 public:
  ArenaScratch(mjData_* data, std::size_t bytes);
  ~ArenaScratch();
  ArenaScratch(const ArenaScratch&) = delete;
  ArenaScratch& operator=(const ArenaScratch&) = delete;
  // aligned for doubles; null when the arena is full
  [[nodiscard]] void* memory() const { return memory_; }

 private:
  mjData_* data_;
  std::size_t before_;  // size of the stack
  void* memory_ = nullptr;
};

// columns that a row gets, -1 for none; two at most, as a contact has two geoms
struct AddedColumns {
  int first = -1;
  int second = -1;
  [[nodiscard]] bool any() const { return first >= 0 || second >= 0; }
  friend bool operator==(const AddedColumns&, const AddedColumns&) = default;
};

// Between mj_step1 and mj_step2. `added` has an entry for every row (nefc); a column that a row
// has already is not added again. New entries are 0. Returns false when the arena is full; the
// Jacobian is then as before.
bool add_sparse_columns(mjData_* data, const AddedColumns* added);

// the entry of a row in this column; null when it has none
[[nodiscard]] double* sparse_entry(mjData_* data, int row, int column);

}  // namespace hurcules
