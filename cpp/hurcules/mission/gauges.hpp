// The measures of a table while it runs: figures from quantities of the log, over their phases.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "hurcules/base/state.hpp"
#include "hurcules/mission/scene_quantities.hpp"
#include "hurcules/mission/table.hpp"
#include "hurcules/sim/supervisor.hpp"

namespace hurcules {

class Gauges {
 public:
  // figures of the table, in the order of its measures, before anything was seen
  [[nodiscard]] static std::vector<Figure> figures_of(const MissionTable& table);
  // finds the quantities; throws Error with the columns that exist. Keeps the table.
  void attach(const MissionTable& table, SceneQuantities& scene);
  void reset();
  // writes the figures that count in this phase
  void look(std::size_t phase, std::vector<Figure>& figures);
  void save(StateWriter& writer) const;
  void restore(StateReader& reader);

 private:
  struct Gauge {
    const double* source = nullptr;
    Measure::Take take = Measure::Take::Last;
    std::vector<bool> counts;  // a phase
    double seen_least = std::numeric_limits<double>::quiet_NaN(), seen_most = seen_least;
    [[nodiscard]] double look();
  };
  std::vector<Gauge> gauges_;
};

// the first figure out of its bounds, in words; "" for none
[[nodiscard]] std::string out_of_bounds(const std::vector<Figure>& figures);

}  // namespace hurcules
