// A planar laser scanner: rays in the x-y plane of a site, a few each tick, as its mirror turns.
//
// It sees contact shapes (all geom groups but the looks, 2), never the body that it sits on. A scan
// is there when its last ray is: the reading is then up to one period old, and rays of one scan are
// not of one moment. Rays are counted from the right end of the field of view to the left.
#pragma once

#include <cstdint>
#include <string>

#include "hurcules/base/random.hpp"
#include "hurcules/base/state.hpp"
#include "hurcules/base/types.hpp"
#include "hurcules/sim/sensor.hpp"

struct mjModel_;
struct mjData_;

namespace hurcules {

struct RangeFinderOptions {
  int rays = 0;                                 // a scan, 0: there is no scanner
  int period = 25;                              // [ticks] a scan: 40 Hz
  double angle = 1.5 * 3.14159265358979323846;  // [rad] field of view about x of the site
  double min_range = 0.1;                       // [m] what is nearer reads 0
  double max_range = 30.0;                      // [m] what is further reads inf
  SensorModel model;                            // [m]; its delay in whole scans
  std::string site = "lidar";
};

class RangeFinder {
 public:
  // throws Error for options out of range, or a site that the model lacks
  RangeFinder(const mjModel_* model, double dt,
              const RangeFinderOptions& options);  // dt [s] a tick
  void reset(std::uint64_t seed);
  // after a step: the rays of this tick, from where the scanner was at its beginning
  void sample(const mjModel_* model, mjData_* data);

  [[nodiscard]] const RangeFinderOptions& options() const { return options_; }
  // the last whole scan [m] (rays); inf for nothing in range, and before the first scan
  [[nodiscard]] const Vector& reading() const { return reading_; }
  [[nodiscard]] double ray_angle(Index ray) const;  // [rad] about z of the site, 0 along x
  void save(StateWriter& writer) const;
  void restore(StateReader& reader);

 private:
  void finish_scan();
  [[nodiscard]] double measure(double distance, double bias);

  RangeFinderOptions options_;
  int site_ = -1;
  double scan_seconds_ = 0.0;      // [s] a scan
  Index per_tick_ = 0, next_ = 0;  // rays
  Random random_;
  double bias_ = 0.0;      // [m] of the whole scanner
  Vector scan_, reading_;  // (rays)
  Matrix past_;            // (delay, rays)
  Index oldest_ = 0;
  Vector directions_, distances_;  // scratch of a tick: (3 per_tick), (per_tick)
};

}  // namespace hurcules
