#include "report.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <string_view>

#include "timing_table.hpp"

namespace hurcules_sim {

namespace {

using hurcules::Excess;
using hurcules::Simulation;

std::string text(const char* format, double value) {
  std::array<char, 40> digits{};
  std::snprintf(digits.data(), digits.size(), format, value);
  return digits.data();
}

// JSON has no word for a number that is not finite
std::string json(double value) {
  return std::isfinite(value) ? text("%.17g", value) : "null";
}

std::string json(std::string_view words) {
  std::string quoted = "\"";
  for (const char c : words) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + '"';
}

std::string json(const Excess& excess) {
  return "\"position_rad\": " + json(excess.position) + ", \"velocity\": " + json(excess.velocity) +
         ", \"torque\": " + json(excess.torque);
}

std::string json(const TimingRow& row) {
  return "{\"median\": " + json(row.median) + ", \"p99\": " + json(row.p99) +
         ", \"p99.9\": " + json(row.p999) + ", \"max\": " + json(row.max) + "}";
}

// one member a line, indented twice
class Members {
 public:
  Members(std::ostream& out, const char* name) : out_(out) { out_ << ",\n  \"" << name << "\": {"; }
  ~Members() { out_ << "\n  }"; }
  Members(const Members&) = delete;
  Members& operator=(const Members&) = delete;
  void add(const std::string& name, const std::string& value) {
    out_ << (first_ ? "\n    " : ",\n    ") << json(name) << ": " << value;
    first_ = false;
  }

 private:
  std::ostream& out_;
  bool first_ = true;
};

void write_events(const Simulation& simulation, std::ostream& out) {
  out << ",\n  \"events\": [";
  bool first = true;
  for (const hurcules::Event& event : simulation.events().events()) {
    out << (first ? "\n    " : ",\n    ") << "{\"time_s\": " << json(event.time)
        << ", \"text\": " << json(simulation.text(event)) << "}";
    first = false;
  }
  out << "\n  ]";
}

bool is_bounded(const hurcules::Figure& figure) {
  return std::isfinite(figure.least) || std::isfinite(figure.most);
}

// "at least 0.3, at most 0.5", "" for anything
std::string wanted(const hurcules::Figure& figure) {
  std::string words;
  if (std::isfinite(figure.least)) words = text("at least %.6g", figure.least);
  if (std::isfinite(figure.most)) {
    if (!words.empty()) words += ", ";
    words += text("at most %.6g", figure.most);
  }
  return words;
}

void print_figures(const Simulation& simulation, std::ostream& out) {
  const auto line = [&](const std::string& name, const std::string& value,
                        const std::string& thesis, const std::string& wanted) {
    std::array<char, 160> words{};
    std::snprintf(words.data(), words.size(), "%-36s %12s %12s  %s", name.c_str(), value.c_str(),
                  thesis.c_str(), wanted.c_str());
    const std::string_view all = words.data();
    out << all.substr(0, all.find_last_not_of(' ') + 1) << '\n';
  };
  line("figure", "here", "thesis", "wanted");
  for (const hurcules::Figure& figure : simulation.figures()) {
    line(figure.name, std::isnan(figure.value) ? "-" : text("%.6g", figure.value),
         std::isnan(figure.thesis) ? "" : text("%.6g", figure.thesis), wanted(figure));
  }
}

}  // namespace

void print(const Run& run, std::ostream& out) {
  const Simulation& simulation = run.simulation;
  out << run.simulation.mission().setup().name << ", seed " << run.arguments.seed << ": "
      << run.reason << " (" << text("%.3f", simulation.time()) << " s, "
      << text("%.1f", simulation.time() / run.wall_seconds) << " x real time)\n\n";
  print_figures(simulation, out);
  out << '\n';
  print_table(timing_rows(simulation.timings()), out);
  out << '\n';
  print_histogram(control_ticks(simulation.timings()), out);
}

void write_json(const Run& run, std::ostream& out) {
  const Simulation& simulation = run.simulation;
  const std::vector<TimingRow> timings = timing_rows(simulation.timings());
  out << "{\n  \"mission\": " << json(run.simulation.mission().setup().name)
      << ",\n  \"seed\": " << run.arguments.seed
      << ",\n  \"variation\": " << json(run.arguments.variation)
      << ",\n  \"sensors\": " << json(run.arguments.sensors ? "realistic" : "exact")
      << ",\n  \"version\": " << json(HURCULES_VERSION)
      << ",\n  \"success\": " << (simulation.success() ? "true" : "false")
      << ",\n  \"reason\": " << json(run.reason)
      << ",\n  \"simulated_seconds\": " << json(simulation.time())
      << ",\n  \"real_time_factor\": " << json(simulation.time() / run.wall_seconds)
      << ",\n  \"control_tick_us\": " << json(timings.back()) << ",\n  \"limit_violation\": {"
      << json(simulation.limits().measured()) << ", \"commanded\": {"
      << json(simulation.limits().commanded()) << "}}";
  {
    Members figures(out, "figures");
    for (const hurcules::Figure& figure : simulation.figures()) {
      figures.add(figure.name, json(figure.value));
    }
  }
  {
    Members thesis(out, "thesis");
    for (const hurcules::Figure& figure : simulation.supervisor()->figures()) {
      if (!std::isnan(figure.thesis)) thesis.add(figure.name, json(figure.thesis));
    }
  }
  {
    Members wanted(out, "wanted");
    for (const hurcules::Figure& figure : simulation.figures()) {
      if (!is_bounded(figure)) continue;
      std::string bounds = "{\"least\": ";
      bounds.append(json(figure.least)).append(", \"most\": ").append(json(figure.most));
      wanted.add(figure.name, bounds + "}");
    }
  }
  {
    Members stages(out, "stages_us");
    for (const TimingRow& row : timings) stages.add(row.stage, json(row));
  }
  write_events(simulation, out);
  out << "\n}\n";
}

void write_csv(const Simulation& simulation, std::ostream& out) {
  const hurcules::Recorder& log = simulation.log();
  for (std::size_t i = 0; i < log.columns(); ++i) out << (i ? "," : "") << log.channels()[i];
  out << '\n';
  std::array<char, 40> digits{};
  for (std::size_t row = 0; row < log.rows(); ++row) {
    for (std::size_t i = 0; i < log.columns(); ++i) {
      std::snprintf(digits.data(), digits.size(), "%.17g", log.at(row, i));
      out << (i ? "," : "") << digits.data();
    }
    out << '\n';
  }
}

}  // namespace hurcules_sim
