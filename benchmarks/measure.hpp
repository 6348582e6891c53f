// Clocks and quantiles of the benchmarks, and what a figure must carry: machine and commit.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

namespace hurcules_benchmark {

// [s]
inline double wall() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// [s] that the call took
template <typename Call>
double seconds_of(Call&& call) {
  const double begin = wall();
  call();
  return wall() - begin;
}

struct Quantiles {
  double median = 0.0, p99 = 0.0, max = 0.0, p999 = 0.0;  // [us]
};

inline Quantiles quantiles(std::vector<double> seconds) {
  if (seconds.empty()) return {};
  std::sort(seconds.begin(), seconds.end());
  const auto at = [&](double share) {
    return 1e6 * seconds[static_cast<std::size_t>(share * static_cast<double>(seconds.size() - 1))];
  };
  return {at(0.5), at(0.99), at(1.0), at(0.999)};
}

// Measures the same cases in several rounds and keeps the least of each: what other programs of the
// machine add is gone, what a case costs more than another stays.
class Rounds {
 public:
  explicit Rounds(std::size_t cases) : least_(cases, 1e9) {}

  template <typename Call>
  void time(std::size_t i, Call&& call) {
    least_[i] = std::min(least_[i], seconds_of(call));
  }
  [[nodiscard]] const std::vector<double>& seconds() const { return least_; }

 private:
  std::vector<double> least_;
};

// first line that a command prints, or "unknown"
inline std::string answer_of(const std::string& command) {
  char line[256] = "";
  if (FILE* pipe = popen((command + " 2>/dev/null").c_str(), "r")) {
    if (!std::fgets(line, sizeof line, pipe)) line[0] = '\0';
    pclose(pipe);
  }
  const std::string text = line;
  return text.empty() ? "unknown" : text.substr(0, text.find('\n'));
}

inline std::string commit() {
  return answer_of("git -C " HURCULES_SOURCE " describe --always --dirty");
}

inline std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown";
}

}  // namespace hurcules_benchmark
