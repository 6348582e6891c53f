// How long a control tick of the stretch takes, as ratios to things measured in the same run.
//
//   control tick   sense, kinematics, hierarchy, solve, servo; against its 1 ms period and against
//   the physics solve          warm, on the hierarchies of the mission; against the bare chain of
//   their equality rows: Householder
//                  QR of the stacked equality rows with Q formed, the least that any orthogonal
//                  method has to do
//   closed loop    simulated time over the processor time that it took
//
// timing [--seconds S]   prints a table; numbers of one machine compare only within one run.
#include <Eigen/QR>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <vector>

#include "hurcules/sim/simulation.hpp"

namespace {

using namespace hurcules;

double wall() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double processor() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

struct Quantiles {
  double median = 0.0, p99 = 0.0, max = 0.0;  // [us]
};

Quantiles quantiles(std::vector<double> seconds) {
  std::sort(seconds.begin(), seconds.end());
  const auto at = [&](double share) {
    return 1e6 * seconds[static_cast<std::size_t>(share * static_cast<double>(seconds.size() - 1))];
  };
  return {at(0.5), at(0.99), at(1.0)};
}

// the equality rows of all levels, one below the other
Matrix stacked_equalities(const Hierarchy& levels, Index unknowns) {
  Matrix stacked(0, unknowns);
  for (const Level& level : levels) {
    if (level.bounds) continue;
    stacked.conservativeResize(stacked.rows() + level.rows(), unknowns);
    stacked.bottomRows(level.rows()) = level.A;
  }
  return stacked;
}

struct Samples {
  std::vector<double> tick, physics, solve;  // [s]
  std::vector<Hierarchy> hierarchies;        // of every 10th tick
  double loop = 0.0;                         // [s] of processor time
};

Samples run(Simulation& simulation, double seconds) {
  Samples samples;
  const double begin = processor();
  while (!simulation.finished() && simulation.time() < seconds) {
    simulation.step(10);
    samples.hierarchies.push_back(simulation.controller().hierarchy());
  }
  samples.loop = processor() - begin;
  const Recorder& timings = simulation.timings();
  samples.tick.assign(timings.rows(), 0.0);
  for (std::size_t c = 0; c < timings.columns(); ++c) {
    const std::string& stage = timings.channels()[c];
    const Vector series = timings.series(c);
    if (stage == "physics") samples.physics.assign(series.begin(), series.end());
    if (stage == "solve") samples.solve.assign(series.begin(), series.end());
    if (stage == "physics" || stage == "record" || stage == "time") continue;
    for (std::size_t i = 0; i < samples.tick.size(); ++i)
      samples.tick[i] += series[static_cast<Index>(i)];
  }
  return samples;
}

// [s] each of a warm solve and of the bare chain, in turn on the same hierarchies
void compare_with_chain(const std::vector<Hierarchy>& hierarchies, Index unknowns,
                        std::vector<double>& solve, std::vector<double>& chain) {
  Solver solver(unknowns);
  Eigen::HouseholderQR<Eigen::MatrixXd> qr;
  Eigen::MatrixXd Q;
  for (const Hierarchy& levels : hierarchies) {
    (void)solver.solve(levels);
    double begin = wall();
    (void)solver.solve(levels);
    solve.push_back(wall() - begin);
    const Eigen::MatrixXd transposed = stacked_equalities(levels, unknowns).transpose();
    begin = wall();
    qr.compute(transposed);
    Q = qr.householderQ() * Eigen::MatrixXd::Identity(unknowns, unknowns);
    chain.push_back(wall() - begin);
  }
}

void print(const char* what, const Quantiles& q, const char* ratio_to, double ratio) {
  std::printf("%-34s %9.2f %9.2f %9.2f   %8.3f x %s\n", what, q.median, q.p99, q.max, ratio,
              ratio_to);
}

}  // namespace

int main(int argc, char** argv) {
  double seconds = 45.0;
  for (int i = 1; i + 1 < argc; ++i) {
    if (!std::strcmp(argv[i], "--seconds")) seconds = std::atof(argv[i + 1]);
  }
  SimulationOptions options;
  options.clock = &wall;
  options.record = false;
  Simulation simulation(load_model(HURCULES_MODELS "/scenes/stretch.xml"), "stretch", options);
  const Samples samples = run(simulation, seconds);
  std::vector<double> solve, chain;
  compare_with_chain(samples.hierarchies, simulation.controller().solution().x.size(), solve,
                     chain);

  const Quantiles tick = quantiles(samples.tick), physics = quantiles(samples.physics);
  const Quantiles warm = quantiles(solve), bare = quantiles(chain);
  std::printf("%-34s %9s %9s %9s   ratio of medians\n", "[us]", "median", "p99", "max");
  print("control tick", tick, "its period of 1 ms", tick.median / 1000.0);
  std::printf("%-34s %9s %9.2f\n", "  p99 / median", "", tick.p99 / tick.median);
  print("physics of a tick", physics, "control tick", physics.median / tick.median);
  print("solve in the loop", quantiles(samples.solve), "control tick",
        quantiles(samples.solve).median / tick.median);
  print("solve, warm and unchanged", warm, "bare chain", warm.median / bare.median);
  print("bare chain", bare, "bare chain", 1.0);
  std::printf("closed loop: %.1f s simulated in %.1f s of one core, %.1f x real time\n",
              simulation.time(), samples.loop, simulation.time() / samples.loop);
  return 0;
}
