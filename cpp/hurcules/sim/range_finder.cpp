#include "hurcules/sim/range_finder.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "hurcules/base/error.hpp"
#include "hurcules/base/number_text.hpp"
#include "hurcules/robot/object_names.hpp"

namespace hurcules {

namespace {

constexpr double kNothing = std::numeric_limits<double>::infinity();
constexpr double kCircle = 2.0 * std::numbers::pi;       // [rad]
constexpr mjtByte kSeen[mjNGROUP] = {1, 1, 0, 1, 1, 1};  // group 2 is looks alone

void check(const RangeFinderOptions& o) {
  require(o.rays >= 0 && o.rays <= 100000,
          "range finder: rays wants 0 to 100000, " + std::to_string(o.rays) + " came");
  require(o.period >= 1,
          "range finder: period wants 1 tick or more, " + std::to_string(o.period) + " came");
  require(o.angle >= 0.0 && o.angle <= kCircle,
          "range finder: angle wants 0 to 2 pi, " + number_text(o.angle) + " came");
  require(o.min_range >= 0.0 && o.min_range < o.max_range && std::isfinite(o.max_range),
          "range finder: ranges want 0 <= min_range < max_range, " + number_text(o.min_range) +
              " and " + number_text(o.max_range) + " came");
  require_sensor_model("range", o.model);
}

}  // namespace

RangeFinder::RangeFinder(const mjModel* m, double dt, const RangeFinderOptions& options)
    : options_(options) {
  check(options_);
  if (options_.rays == 0) return;
  site_ = find_object(*m, mjOBJ_SITE, options_.site);
  scan_seconds_ = options_.period * dt;
  per_tick_ = (options_.rays + options_.period - 1) / options_.period;
  scan_ = reading_ = Vector::Constant(options_.rays, kNothing);
  past_ = Matrix::Constant(options_.model.delay, options_.rays, kNothing);
  directions_ = Vector::Zero(3 * per_tick_);
  distances_ = Vector::Zero(per_tick_);
}

void RangeFinder::reset(std::uint64_t seed) {
  random_ = Random(options_.model.ideal() ? 0 : seed);  // ideal, it draws nothing
  bias_ = options_.model.bias > 0.0 ? options_.model.bias * random_.normal() : 0.0;
  next_ = oldest_ = 0;
  for (Vector* values : {&scan_, &reading_}) values->setConstant(kNothing);
  past_.setConstant(kNothing);
}

double RangeFinder::ray_angle(Index ray) const {
  // a full turn does not see its first direction twice
  const bool whole = options_.angle >= kCircle;
  const double gaps = std::max(whole ? options_.rays : options_.rays - 1, 1);
  return options_.angle * (static_cast<double>(ray) / gaps - 0.5);
}

void RangeFinder::sample(const mjModel* m, mjData* d) {
  if (options_.rays == 0) return;
  const Index count = std::min(per_tick_, options_.rays - next_);
  const mjtNum* const axes = d->site_xmat + 9 * site_;
  for (Index i = 0; i < count; ++i) {
    const double angle = ray_angle(next_ + i);
    const double x = std::cos(angle), y = std::sin(angle);
    for (int k = 0; k < 3; ++k) directions_[3 * i + k] = x * axes[3 * k] + y * axes[3 * k + 1];
  }
  mj_multiRay(m, d, d->site_xpos + 3 * site_, directions_.data(), kSeen, 1, m->site_bodyid[site_],
              nullptr, distances_.data(), nullptr, static_cast<int>(count), options_.max_range);
  for (Index i = 0; i < count; ++i) scan_[next_ + i] = measure(distances_[i], bias_);
  next_ += count;
  if (next_ == options_.rays) finish_scan();
}

double RangeFinder::measure(double distance, double bias) {
  if (distance < 0.0 || distance > options_.max_range) return kNothing;
  if (distance < options_.min_range) return 0.0;
  double value = distance + bias;
  if (options_.model.noise > 0.0) value += options_.model.noise * random_.normal();
  const double step = options_.model.step;
  return step > 0.0 ? step * std::nearbyint(value / step) : value;
}

void RangeFinder::finish_scan() {
  next_ = 0;
  const SensorModel& model = options_.model;
  if (model.drift > 0.0) {
    bias_ += model.drift * std::sqrt(scan_seconds_) * random_.normal();
  }
  if (model.delay == 0) {
    reading_ = scan_;
    return;
  }
  reading_ = past_.row(oldest_).transpose();
  past_.row(oldest_) = scan_.transpose();
  oldest_ = (oldest_ + 1) % model.delay;
}

void RangeFinder::save(StateWriter& writer) const {
  if (options_.rays == 0) return;
  random_.save(writer);
  writer.put(bias_);
  writer.put(static_cast<double>(next_));
  writer.put(static_cast<double>(oldest_));
  writer.put(scan_);
  writer.put(reading_);
  for (Index row = 0; row < past_.rows(); ++row) writer.put(past_.row(row).transpose());
}

void RangeFinder::restore(StateReader& reader) {
  if (options_.rays == 0) return;
  random_.restore(reader);
  bias_ = reader.get();
  next_ = reader.get_count(options_.rays - 1);
  oldest_ = reader.get_count(std::max(past_.rows() - 1, Index{0}));
  reader.get(scan_);
  reader.get(reading_);
  for (Index row = 0; row < past_.rows(); ++row) {
    for (double& value : past_.row(row)) value = reader.get();
  }
}

}  // namespace hurcules
