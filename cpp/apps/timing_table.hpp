// Times of the stages of all ticks as a table: median, p99, p99.9, maximum; and as a histogram.
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "hurcules/sim/recorder.hpp"

namespace hurcules_sim {

struct TimingRow {
  std::string stage;
  double median = 0.0, p99 = 0.0, p999 = 0.0, max = 0.0;  // [us]
};

// [us] of each tick from sensing to the torques, without physics and record
[[nodiscard]] hurcules::Vector control_ticks(const hurcules::Recorder& timings);
// a row a stage, then "control tick"
[[nodiscard]] std::vector<TimingRow> timing_rows(const hurcules::Recorder& timings);
void print_table(const std::vector<TimingRow>& rows, std::ostream& out);
void print_histogram(const hurcules::Vector& ticks, std::ostream& out);

}  // namespace hurcules_sim
