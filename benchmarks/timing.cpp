// How long a control tick of the stretch takes, as ratios to things measured in the same run.
//
//   control tick   sense, kinematics, hierarchy, solve, servo; against its 1 ms period and against
//                  the physics
//   solve          warm, on the hierarchies of the mission; against the bare chain of their
//                  equality rows: Householder QR of the stacked equality rows with Q formed, the
//                  least that any orthogonal method has to do
//   closed loop    simulated time over the processor time that it took
//
// timing [--seconds S]   prints a table; numbers of one machine compare only within one run.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <vector>

#include "bare_chain.hpp"
#include "hurcules/mission/mission_simulation.hpp"
#include "measure.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_benchmark;

double processor_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

struct Samples {
  std::vector<double> tick, physics, solve;  // [s]
  std::vector<Hierarchy> hierarchies;        // of every 10th tick
  double loop = 0.0;                         // [s] of processor time
};

Samples run(Simulation& simulation, double seconds) {
  Samples samples;
  const double begin = processor_seconds();
  while (!simulation.finished() && simulation.time() < seconds) {
    simulation.step(10);
    samples.hierarchies.push_back(simulation.controller().law().hierarchy());
  }
  samples.loop = processor_seconds() - begin;
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
  BareChain bare;
  for (const Hierarchy& levels : hierarchies) {
    (void)solver.solve(levels);
    solve.push_back(seconds_of([&] { (void)solver.solve(levels); }));
    bare.read(levels, unknowns);
    chain.push_back(seconds_of([&] { bare.compute(); }));
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
  MissionOptions options;
  options.clock = &wall;
  options.record = false;
  MissionSimulation simulation(load_model(HURCULES_MODELS "/scenes/stretch.xml"), "stretch",
                               options);
  const Samples samples = run(simulation, seconds);
  std::vector<double> solve, chain;
  compare_with_chain(samples.hierarchies, simulation.controller().law().solution().x.size(), solve,
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
