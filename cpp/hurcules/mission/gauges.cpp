#include "hurcules/mission/gauges.hpp"

#include <cmath>
#include <utility>

#include "hurcules/base/error.hpp"

namespace hurcules {

std::vector<Figure> Gauges::figures_of(const MissionTable& table) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  std::vector<Figure> figures;
  for (const Measure& measure : table.measures)
    figures.push_back({measure.name, kNone, kNone, measure.least, measure.most});
  return figures;
}

void Gauges::attach(const MissionTable& table, SceneQuantities& scene) {
  gauges_.clear();
  for (const Measure& measure : table.measures) {
    const std::string where = "figure '" + measure.name + "'";
    Gauge gauge;
    gauge.source = scene.find(measure.quantity, where);
    gauge.take = measure.take;
    gauge.counts.assign(table.phases.size(), measure.phases.empty());
    for (const std::string& phase : measure.phases) {
      gauge.counts[find_phase(table.phases, phase, where)] = true;
    }
    gauges_.push_back(std::move(gauge));
  }
}

void Gauges::reset() {
  for (Gauge& gauge : gauges_) {
    gauge.seen_least = gauge.seen_most = std::numeric_limits<double>::quiet_NaN();
  }
}

void Gauges::look(std::size_t phase, std::vector<Figure>& figures) {
  for (std::size_t i = 0; i < gauges_.size(); ++i) {
    if (gauges_[i].counts[phase]) figures[i].value = gauges_[i].look();
  }
}

double Gauges::Gauge::look() {
  const double now = *source;
  if (!(seen_least <= now)) seen_least = now;
  if (!(seen_most >= now)) seen_most = now;
  switch (take) {
    case Measure::Take::Largest:
      return seen_most;
    case Measure::Take::Smallest:
      return seen_least;
    case Measure::Take::Span:
      return seen_most - seen_least;
    case Measure::Take::Last:
      break;
  }
  return now;
}

void Gauges::save(StateWriter& writer) const {
  for (const Gauge& gauge : gauges_) {
    writer.put(gauge.seen_least);
    writer.put(gauge.seen_most);
  }
}

void Gauges::restore(StateReader& reader) {
  for (Gauge& gauge : gauges_) {
    gauge.seen_least = reader.get_any();
    gauge.seen_most = reader.get_any();
  }
}

std::string out_of_bounds(const std::vector<Figure>& figures) {
  for (const Figure& figure : figures) {
    if (std::isinf(figure.least) && std::isinf(figure.most)) continue;
    if (figure.value >= figure.least && figure.value <= figure.most) continue;
    const bool none = std::isnan(figure.value);  // none of its phases ran
    const bool high = none ? std::isinf(figure.least) : figure.value > figure.most;
    return figure.name + (none ? " has no value" : " is " + to_text(figure.value)) +
           ", wanted at " + (high ? "most " : "least ") +
           to_text(high ? figure.most : figure.least);
  }
  return "";
}

}  // namespace hurcules
