#include "timing_table.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <iterator>

namespace hurcules_sim {

namespace {

using hurcules::Index;
using hurcules::Vector;

// what a control tick is made of
constexpr std::array kControl = {"sense", "kinematics", "hierarchy", "solve", "servo"};

TimingRow row(const std::string& stage, Vector times) {
  TimingRow result{stage};
  if (times.size() == 0) return result;
  std::sort(times.begin(), times.end());
  const auto at = [&](double share) {
    return times[static_cast<Index>(share * static_cast<double>(times.size() - 1) + 0.5)];
  };
  result.median = at(0.5);
  result.p99 = at(0.99);
  result.p999 = at(0.999);
  result.max = at(1.0);
  return result;
}

template <typename... Values>
void print(std::ostream& out, const char* format, Values... values) {
  std::array<char, 160> line{};
  std::snprintf(line.data(), line.size(), format, values...);
  out << line.data();
}

}  // namespace

Vector control_ticks(const hurcules::Recorder& timings) {
  Vector sum = Vector::Zero(static_cast<Index>(timings.rows()));
  for (std::size_t i = 0; i < timings.columns(); ++i) {
    const std::string& stage = timings.channels()[i];
    if (std::find(kControl.begin(), kControl.end(), stage) == kControl.end()) continue;
    sum += 1e6 * timings.series(i);
  }
  return sum;
}

std::vector<TimingRow> timing_rows(const hurcules::Recorder& timings) {
  std::vector<TimingRow> rows;
  for (std::size_t i = 0; i < timings.columns(); ++i) {
    if (timings.channels()[i] == "time") continue;
    rows.push_back(row(timings.channels()[i], 1e6 * timings.series(i)));
  }
  rows.push_back(row("control tick", control_ticks(timings)));
  return rows;
}

void print_table(const std::vector<TimingRow>& rows, std::ostream& out) {
  print(out, "%-14s %9s %9s %9s %9s   [us]\n", "stage", "median", "p99", "p99.9", "max");
  for (const TimingRow& r : rows) {
    print(out, "%-14s %9.2f %9.2f %9.2f %9.2f\n", r.stage.c_str(), r.median, r.p99, r.p999, r.max);
  }
}

void print_histogram(const Vector& ticks, std::ostream& out) {
  constexpr std::array edges = {0, 5, 10, 15, 20, 30, 50, 100, 200, 500, 1000};  // [us]
  constexpr int kWidth = 50;
  std::array<int, edges.size()> counts{};
  for (const double tick : ticks) {
    const auto above = std::upper_bound(edges.begin(), edges.end(), tick);
    ++counts[static_cast<std::size_t>(std::max<std::ptrdiff_t>(above - edges.begin() - 1, 0))];
  }
  const int most = std::max(1, *std::max_element(counts.begin(), counts.end()));
  print(out, "control tick [us] and how many of %d ticks\n", static_cast<int>(ticks.size()));
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const bool last = i + 1 == edges.size();
    const std::string upper = last ? "" : std::to_string(edges[i + 1]);
    const std::string bar(static_cast<std::size_t>(counts[i] * kWidth / most), '#');
    print(out, "%5d - %-5s %8d %s\n", edges[i], upper.c_str(), counts[i], bar.c_str());
  }
}

}  // namespace hurcules_sim
