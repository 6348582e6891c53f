// What is left of a run: text for the terminal, JSON and CSV for files.
#pragma once

#include <ostream>
#include <string>

#include "arguments.hpp"
#include "hurcules/mission/mission_simulation.hpp"

namespace hurcules_sim {

struct Run {
  const Arguments& arguments;
  const hurcules::MissionSimulation& simulation;
  double wall_seconds = 0.0;
  std::string reason;  // why it ended, also where the mission itself did not end it
};

// the outcome, the figures beside the thesis' own, the timing table and a histogram of the tick
void print(const Run& run, std::ostream& out);
// the contents of summary.json
void write_json(const Run& run, std::ostream& out);
// every channel of the log, a row a tick, each number with all its bits
void write_csv(const hurcules::Simulation& simulation, std::ostream& out);

}  // namespace hurcules_sim
