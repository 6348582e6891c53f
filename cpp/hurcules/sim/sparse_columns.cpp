#include "hurcules/sim/sparse_columns.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cstring>

namespace hurcules {

namespace {

// memory behind all that a step has put into the arena so far; null when it is full
void* take_from_arena(mjData* d, std::size_t bytes) {
  const std::size_t begin = (d->parena + alignof(mjtNum) - 1) / alignof(mjtNum) * alignof(mjtNum);
  if (begin + bytes + d->pstack > static_cast<std::size_t>(d->narena)) return nullptr;
  d->parena = begin + bytes;
  d->maxuse_arena = std::max(d->maxuse_arena, static_cast<mjtSize>(d->parena + d->pstack));
  return static_cast<char*>(d->arena) + begin;
}

bool has(const mjData* d, int row, int column) {
  const int* const columns = d->efc_J_colind + d->efc_J_rowadr[row];
  return std::binary_search(columns, columns + d->efc_J_rownnz[row], column);
}

int count(const AddedColumns& added) {
  return (added.first >= 0 ? 1 : 0) + (added.second >= 0 ? 1 : 0);
}

// those that are not in the row, each once
AddedColumns missing(const mjData* d, int row, AddedColumns added) {
  if (added.second == added.first) added.second = -1;
  if (added.first >= 0 && has(d, row, added.first)) added.first = -1;
  if (added.second >= 0 && has(d, row, added.second)) added.second = -1;
  return added;
}

// the Jacobian that grows row by row
struct Copy {
  mjtNum* values;
  int* columns;
  int size = 0;
};

void append(const mjData* d, int begin, int entries, Copy& copy) {
  const auto n = static_cast<std::size_t>(entries);
  std::memcpy(copy.values + copy.size, d->efc_J + begin, n * sizeof(mjtNum));
  std::memcpy(copy.columns + copy.size, d->efc_J_colind + begin, n * sizeof(int));
  copy.size += entries;
}

// a 0 in this column of the last row, which begins here and stays sorted
void insert(Copy& copy, int begin, int column) {
  int at = copy.size++;
  for (; at > begin && copy.columns[at - 1] > column; --at) {
    copy.columns[at] = copy.columns[at - 1];
    copy.values[at] = copy.values[at - 1];
  }
  copy.columns[at] = column;
  copy.values[at] = 0.0;
}

void append_row(mjData* d, int row, const AddedColumns& added, Copy& copy) {
  const int begin = copy.size;
  append(d, d->efc_J_rowadr[row], d->efc_J_rownnz[row], copy);
  if (added.first >= 0) insert(copy, begin, added.first);
  if (added.second >= 0) insert(copy, begin, added.second);
  d->efc_J_rowadr[row] = begin;
  d->efc_J_rownnz[row] = copy.size - begin;
}

// rows [first, last), which stay as they are and lie one behind the other
void append_unchanged(mjData* d, int first, int last, Copy& copy) {
  const int begin = d->efc_J_rowadr[first], shift = copy.size - begin;
  append(d, begin, d->efc_J_rowadr[last - 1] + d->efc_J_rownnz[last - 1] - begin, copy);
  for (int row = first; row < last; ++row) d->efc_J_rowadr[row] += shift;
}

// rows of one pattern in a row count as one block for the solver: not those that got other columns
void split_blocks(mjData* d, const AddedColumns* added) {
  int* const below = d->efc_J_rowsuper;
  for (int row = d->nefc - 2; row >= 0; --row) {
    if (below[row] > 0) below[row] = added[row] == added[row + 1] ? below[row + 1] + 1 : 0;
  }
}

}  // namespace

ArenaScratch::ArenaScratch(mjData* d, std::size_t bytes) : data_(d), before_(d->pstack) {
  const std::size_t end = static_cast<std::size_t>(d->narena) - before_;
  if (end < d->parena + bytes + alignof(mjtNum)) return;
  const std::size_t begin = (end - bytes) / alignof(mjtNum) * alignof(mjtNum);
  d->pstack = static_cast<std::size_t>(d->narena) - begin;
  d->maxuse_arena = std::max(d->maxuse_arena, static_cast<mjtSize>(d->parena + d->pstack));
  memory_ = static_cast<char*>(d->arena) + begin;
}

ArenaScratch::~ArenaScratch() {
  data_->pstack = before_;
}

bool add_sparse_columns(mjData* d, const AddedColumns* added) {
  int size = d->nJ;
  for (int row = 0; row < d->nefc; ++row) size += count(added[row]);
  if (size == d->nJ) return true;
  const auto n = static_cast<std::size_t>(size);
  auto* const values = static_cast<mjtNum*>(take_from_arena(d, n * (sizeof(mjtNum) + sizeof(int))));
  if (!values) return false;

  Copy copy{values, reinterpret_cast<int*>(values + n)};
  for (int row = 0; row < d->nefc;) {
    int next = row;
    while (next < d->nefc && !added[next].any()) ++next;
    if (next > row) append_unchanged(d, row, next, copy);
    if (next < d->nefc) append_row(d, next, missing(d, next, added[next]), copy);
    row = next + 1;
  }
  d->efc_J = copy.values;
  d->efc_J_colind = copy.columns;
  d->nJ = copy.size;
  split_blocks(d, added);
  return true;
}

double* sparse_entry(mjData* d, int row, int column) {
  const int begin = d->efc_J_rowadr[row], end = begin + d->efc_J_rownnz[row];
  const int* const columns = d->efc_J_colind;
  const int* const found = std::lower_bound(columns + begin, columns + end, column);
  return found != columns + end && *found == column ? d->efc_J + (found - columns) : nullptr;
}

}  // namespace hurcules
