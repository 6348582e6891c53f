#include "hurcules/tasks/distance_task.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hurcules/base/error.hpp"
#include "hurcules/base/number_text.hpp"
#include "hurcules/base/pose.hpp"
#include "hurcules/base/values.hpp"
#include "hurcules/robot/object_names.hpp"
#include "hurcules/robot/trees.hpp"

namespace hurcules {

namespace {

// a flat face touches another at three points or more
constexpr std::size_t kPoints = 4;

Index rows_for(std::size_t pairs, Index most) {
  require_number(most >= 1, "rows of a distance task want a number >= 1",
                 static_cast<double>(most));
  return std::clamp(static_cast<Index>(kPoints * pairs), Index{1}, most);
}

std::vector<GeomPair> geoms_of(const std::vector<CollisionPair>& pairs) {
  std::vector<GeomPair> geoms;
  for (const CollisionPair& pair : pairs) geoms.push_back(pair.geoms);
  return geoms;
}

// how far apart they are now, [m] `most` where farther
std::vector<CollisionPair> standing(const Robot& robot, const std::vector<GeomPair>& geoms,
                                    double most) {
  std::vector<CollisionPair> pairs;
  for (const GeomPair& pair : geoms) pairs.push_back({pair, most});
  GeomDistance distance(robot, geoms, most, geoms.size());
  for (const GeomDistance::Near& one : distance.measure(robot))
    if (one.pair >= 0) pairs[static_cast<std::size_t>(one.pair)].distance = one.distance;
  return pairs;
}

CollisionSampling sampling_of(const CollisionOptions& options) {
  return {.near = 2.0 * options.most, .postures = options.postures, .seed = options.seed};
}

}  // namespace

DistanceTask::DistanceTask(std::string name, const Robot& robot, const DistanceTaskOptions& options)
    : Task(std::move(name), rows_for(named_geom_pairs(robot, options.pairs).size(), options.rows),
           robot),
      distances_(robot, named_geom_pairs(robot, options.pairs), options.most,
                 static_cast<std::size_t>(rows()), kPoints),
      most_(options.most),
      nearer_(pairs().size(), 0.0) {
  require(!pairs().empty(), "task '" + name_ + "' wants at least one pair of bodies");
  make_rows(options.margin);
  if (options.as_it_stands) keep_half(standing(robot, pairs(), options.most), options.margin);
  DistanceTask::update(robot);
}

DistanceTask::DistanceTask(std::string name, const Robot& robot,
                           const std::vector<CollisionPair>& pairs, const CollisionOptions& options)
    : Task(std::move(name), rows_for(pairs.size(), options.rows), robot),
      distances_(robot, geoms_of(pairs), options.most, static_cast<std::size_t>(rows()), kPoints),
      most_(options.most),
      nearer_(pairs.size(), 0.0) {
  make_rows(options.margin);
  keep_half(pairs, options.margin);
  DistanceTask::update(robot);
}

void DistanceTask::make_rows(double margin) {
  require_number(margin >= 0.0 && margin < most_,  // also for a number that is none
                 "margin of task '" + name_ + "' wants 0 m or more, below `most`, " +
                     number_text(most_) + " m",
                 margin);
  lower_.setConstant(margin);
  upper_.setConstant(std::numeric_limits<double>::infinity());
  max_speed_ = 0.5;
}

void DistanceTask::keep_half(const std::vector<CollisionPair>& pairs, double margin) {
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (pairs[i].distance < margin) nearer_[i] = margin - 0.5 * pairs[i].distance;
}

void DistanceTask::reset(const Robot& robot) {
  distances_.reset();
  target_is_set_ = false;
  update(robot);
}

void DistanceTask::update(const Robot& robot) {
  require_robot(robot);
  const std::vector<GeomDistance::Near>& nearest = distances_.measure(robot);
  error_.setConstant(most_);
  velocity_des_.setZero();
  jacobian_.setZero();
  for (Index row = 0; row < rows(); ++row) {
    const GeomDistance::Near& near = nearest[static_cast<std::size_t>(row)];
    if (near.pair < 0) continue;
    error_[row] = near.distance + nearer_[static_cast<std::size_t>(near.pair)];
    velocity_des_[row] = -distances_.rate(near);
    distances_.gradient(robot, near, jacobian_.row(row));
  }
}

void DistanceTask::advance(const ConstVectorRef& velocity, double /*dt*/) {
  require_rows(velocity, "velocity");
}

void DistanceTask::set_obstacle(const Robot& robot, const std::string& body,
                                const BodyMotion& motion) {
  require_robot(robot);
  require(motion.pose.p.allFinite() && is_rotation(motion.pose.R) && motion.linear.allFinite() &&
              motion.angular.allFinite(),
          "obstacle '" + body + "' of task '" + name_ +
              "' wants a finite position and velocity, and a rotation");
  const Frame frame = robot.frame(body);
  require(robot.is_body(frame), "obstacle '" + body + "' of task '" + name_ + "' wants a body");
  require(!robot.moves(frame),
          "body '" + body + "' is moved by the coordinates: it is no obstacle");
  distances_.set_motion(frame.id, motion);
  target_is_set_ = true;
}

std::vector<int> DistanceTask::loose_bodies(const Robot& robot) const {
  require_robot(robot);
  std::vector<int> loose;
  for (const int body : distances_.bodies())
    if (may_move(*robot.model(), body) && !in_own_tree(robot, body)) loose.push_back(body);
  return loose;
}

void DistanceTask::save(StateWriter& writer) const {
  Task::save(writer);
  distances_.save(writer);
}

void DistanceTask::restore(StateReader& reader) {
  Task::restore(reader);
  distances_.restore(reader);
}

std::string DistanceTask::row_name(const Robot& robot, Index row) const {
  const Index index = pair(row);
  if (index < 0) return name_;
  const GeomPair& geoms = pairs()[static_cast<std::size_t>(index)];
  return name_ + " (" + geom_name(*robot.model(), geoms.first) + ", " +
         geom_name(*robot.model(), geoms.second) + ")";
}

DistanceTask self_collision(const Robot& robot, const CollisionOptions& options) {
  return {"self_collision", robot, self_pairs(robot, sampling_of(options)), options};
}

DistanceTask obstacles(const Robot& robot, const std::vector<std::string>& bodies,
                       const CollisionOptions& options) {
  return {"obstacles", robot, obstacle_pairs(robot, bodies, sampling_of(options)), options};
}

}  // namespace hurcules
