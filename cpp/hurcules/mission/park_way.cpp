#include "hurcules/mission/park_way.hpp"

#include <cmath>

#include "hurcules/base/pose.hpp"
#include "hurcules/sim/readings.hpp"

namespace hurcules {

namespace {

ParkingOptions options_of(const Park& park) {
  ParkingOptions options;
  options.speed = park.speed;
  options.yaw_rate = park.yaw_rate;
  options.turn_centre = 0.0;  // poses are those of the turning centre
  return options;
}

}  // namespace

ParkWay::ParkWay(const Park& park, Index row, double dt)
    : park_(park), row_(row), parking_(options_of(park), dt) {}

void ParkWay::attach(const Plant& plant, int robot, const std::string& where) {
  plant_ = &plant;
  robot_ = robot;
  body_ = park_.body.empty() ? -1 : find_body(plant.model(), park_.body, where);
}

void ParkWay::reset() {
  started_ = false;
  enter();
}

void ParkWay::enter() {
  aimed_ = stopped_ = false;
  parking_.stop();
}

void ParkWay::look(bool rules) {
  if (!started_ || rules) here_ = centre_on_ground(plant_->data(), robot_);
  if (!started_) start_ = here_;
  started_ = true;
  if (!rules || aimed_) return;
  const PlanarPose from = body_ < 0 ? start_ : pose_on_ground(plant_->data(), body_);
  const double c = std::cos(from.yaw), s = std::sin(from.yaw);
  parking_.start({from.x + c * park_.ahead - s * park_.left,
                  from.y + s * park_.ahead + c * park_.left, wrap_angle(from.yaw + park_.heading)});
  aimed_ = true;
}

void ParkWay::command(Vector& out) {
  if (!aimed_) return;
  const DriveCommand wanted = parking_.command(here_, stopped_);
  out[row_] = wanted.speed;
  out[row_ + 1] = wanted.yaw_rate;
}

void ParkWay::save(StateWriter& writer) const {
  for (const PlanarPose& pose : {start_, here_}) {
    for (const double value : {pose.x, pose.y, pose.yaw}) writer.put(value);
  }
  for (const bool flag : {started_, aimed_, stopped_}) writer.put(flag ? 1.0 : 0.0);
  parking_.save(writer);
}

void ParkWay::restore(StateReader& reader) {
  for (PlanarPose* pose : {&start_, &here_}) {
    for (double* value : {&pose->x, &pose->y, &pose->yaw}) *value = reader.get();
  }
  for (bool* flag : {&started_, &aimed_, &stopped_}) *flag = reader.get_count(1) > 0;
  parking_.restore(reader);
}

}  // namespace hurcules
