// Time series: named numbers that live elsewhere, copied once a tick.
//
// A channel is a name and the address of a double; the owner keeps it alive. Memory grows in
// reserve only, never in a tick.
#pragma once

#include <string>
#include <vector>

#include "hurcules/base/types.hpp"

namespace hurcules {

class Recorder {
 public:
  // before the first row
  void add(std::string channel, const double* source);
  // PREFIX/NAME for each entry of a vector whose size stays as it is
  void add(const std::string& prefix, const std::vector<std::string>& names, const Vector& sources);

  // what a channel is copied from, null where there is none of this name
  [[nodiscard]] const double* source(const std::string& channel) const;

  // room for so many rows more; outside the tick
  void reserve(std::size_t rows);
  // one row of what the sources hold now
  void record();
  // forgets the rows from this time on [s]; the first channel is the time
  void truncate(double time);

  [[nodiscard]] const std::vector<std::string>& channels() const { return channels_; }
  [[nodiscard]] std::size_t rows() const { return rows_; }
  [[nodiscard]] std::size_t columns() const { return channels_.size(); }
  // one channel over time, (rows); these two throw Error for what is not there
  [[nodiscard]] Vector series(std::size_t channel) const;
  [[nodiscard]] double at(std::size_t row, std::size_t channel) const;
  // what a source holds now
  [[nodiscard]] double now(std::size_t channel) const { return *sources_[channel]; }
  // what the sources hold now, (columns)
  [[nodiscard]] Vector snapshot() const;

 private:
  std::vector<std::string> channels_;
  std::vector<const double*> sources_;
  std::vector<double> values_;  // row by row
  std::size_t rows_ = 0;
};

}  // namespace hurcules
