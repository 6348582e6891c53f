// Table 4.2 of the thesis (M17): time of a solve over the number of levels, n = 19, 19 rows of
// motion tasks in all under one level of joint limits, no singularity; mean, deviation and median
// [ms]. A sample above 20 medians was interrupted by another program, since all problems of a
// column take the same way; such samples are left out and their share is told.
//
// The thesis' figures stand beside ours; its machine is not ours, so compare along a row, and one
// method with another. Solved are the ticks of a motion, up and down again, warm.
//
// solver_table_4_2 [--solves N]   500,000 solves a method, spread over p = 2..8
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <map>

#include "hurcules/solver/method.hpp"
#include "hurcules/solver/solver.hpp"
#include "measure.hpp"
#include "robot_problems.hpp"

namespace {

using namespace hurcules_benchmark;

constexpr int kFirst = 2, kLast = 8;  // levels, the joint limits counted
using Row = std::vector<double>;      // p = 2..8, [ms]

struct Moments {
  double mean = 0.0, deviation = 0.0, median = 0.0;  // [ms]
  double interrupted = 0.0;                          // share of the samples
};

Moments moments(const std::vector<double>& seconds) {
  Moments moments;
  moments.median = 1e-3 * quantiles(seconds).median;
  Row kept;
  for (const double s : seconds)
    if (1e3 * s <= 20.0 * moments.median) kept.push_back(1e3 * s);
  const auto count = static_cast<double>(kept.size());
  for (const double ms : kept) moments.mean += ms / count;
  for (const double ms : kept) moments.deviation += std::pow(ms - moments.mean, 2.0) / count;
  moments.deviation = std::sqrt(moments.deviation);
  moments.interrupted = 1.0 - count / static_cast<double>(seconds.size());
  return moments;
}

// 19 rows shared out as evenly as it goes; at p = 8 the thesis has 3, 3, 3, 3, 2, 3, 2
Shape shape_of(int levels) {
  if (levels == kLast) return {19, {3, 3, 3, 3, 2, 3, 2}};
  Shape shape{19, {}};
  for (Index left = 19, tasks = levels - 1; tasks > 0; --tasks) {
    shape.rows.push_back((left + tasks - 1) / tasks);
    left -= shape.rows.back();
  }
  return shape;
}

Moments measure(const std::string& method, int levels, int solves) {
  Solver solver(19, {.method = method});
  const Motion motion(shape_of(levels), Conflict::None, 0.1, 1);
  std::vector<Hierarchy> ticks;
  for (int k = 0; k < 1000; ++k) ticks.push_back(motion.at(1e-3 * k));
  for (int k = 0; k < 1000 && k < solves; ++k) (void)solver.solve(ticks[k]);
  std::vector<double> seconds;
  for (int i = 0; i < solves; ++i) {
    const int k = i % 2000 < 1000 ? i % 1000 : 999 - i % 1000;
    seconds.push_back(seconds_of([&] { (void)solver.solve(ticks[k]); }));
  }
  return moments(seconds);
}

void print(const std::string& what, const Row& row) {
  std::printf("%-34s", what.c_str());
  for (const double value : row) std::printf(" %8.4f", value);
  std::printf("\n");
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  int solves = 500000;
  if (argc == 3 && !std::strcmp(argv[1], "--solves")) solves = std::atoi(argv[2]);
  const std::map<std::string, Row> thesis = {
      {"rhqp_thesis", {0.1878, 0.0920, 0.0700, 0.0833, 0.0868, 0.0838, 0.0828}},
      {"hqp", {0.0492, 0.0673, 0.0672, 0.0628, 0.0700, 0.0949, 0.0888}},
      {"dls_hqp", {0.0728, 0.0803, 0.0833, 0.0928, 0.1017, 0.1193, 0.1241}},
  };
  std::printf("[ms]                        levels:");
  for (int levels = kFirst; levels <= kLast; ++levels) std::printf(" %8d", levels);
  std::printf("\n");
  for (const std::string& method : method_names()) {
    Row means, deviations, medians;
    double interrupted = 0.0;
    for (int levels = kFirst; levels <= kLast; ++levels) {
      const Moments moments = measure(method, levels, solves / (kLast - kFirst + 1));
      means.push_back(moments.mean);
      deviations.push_back(moments.deviation);
      medians.push_back(moments.median);
      interrupted = std::max(interrupted, moments.interrupted);
    }
    print(method + ", mean", means);
    print(method + ", deviation", deviations);
    print(method + ", median", medians);
    std::printf("%-34s %.1e\n", (method + ", left out at most").c_str(), interrupted);
    if (thesis.contains(method)) print(method + ", mean in the thesis", thesis.at(method));
  }
  return 0;
}
