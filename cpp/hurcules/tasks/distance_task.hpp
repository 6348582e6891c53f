// Bodies keep away from each other: an inequality for each of the pairs that are nearest.
//
//   e_i = distance [m] (m),  J = its gradient (m, n),  de/dt = J qdot - velocity_des;   margin <= e_i
// A row belongs to a pair of geoms while that is nearer than `most` and among the m nearest, up to
// three more to points of it that were nearest before (flat faces); without one it asks for nothing
// (e = most, J = 0). Controllers brake before the margin as before joint
// limits (Task::is_limit): at the speed that half of the acceleration of the coordinates can
// stop. A pair that stands nearer than the margin by construction counts as that much farther.
// Left out: the change of J with the velocity (drift).
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hurcules/robot/collision_pairs.hpp"
#include "hurcules/robot/geom_distance.hpp"
#include "hurcules/tasks/task.hpp"

namespace hurcules {

struct DistanceTaskOptions {
  std::vector<std::pair<std::string, std::string>> pairs;  // names of bodies or geoms
  double margin = 0.03;                                    // [m]
  double most = 0.3;                                       // [m] > margin
  Index rows = 16;  // at most: so many points of pairs of geoms count at a time
  // a pair that is nearer than the margin now keeps half of its present distance, as if it was found
  bool as_it_stands = false;
};

struct CollisionOptions {
  double margin = 0.02;  // [m]
  double most = 0.15;    // [m] > margin
  Index rows = 16;
  int postures = 200;      // sampled to find the pairs (collision_pairs.hpp)
  std::uint32_t seed = 0;  // of them
};

class DistanceTask : public Task {
 public:
  // throws Error without a pair, for a name that is no body or geom, for two that no coordinate
  // moves against each other, and unless 0 <= margin < most
  DistanceTask(std::string name, const Robot& robot, const DistanceTaskOptions& options);
  // pairs that were found; none is no error: the task then asks for nothing
  DistanceTask(std::string name, const Robot& robot, const std::vector<CollisionPair>& pairs,
               const CollisionOptions& options);
  [[nodiscard]] std::unique_ptr<Task> clone() const override {
    return std::make_unique<DistanceTask>(*this);
  }
  [[nodiscard]] std::string unit() const override { return "m"; }

  void update(const Robot& robot) override;
  // as it was made: nothing is near yet, no obstacle has moved
  void reset(const Robot& robot) override;
  // there is no target: hold and advance change nothing
  void hold(const Robot& robot) override { update(robot); }
  void advance(const ConstVectorRef& velocity, double dt) override;
  void save(StateWriter& writer) const override;
  void restore(StateReader& reader) override;
  [[nodiscard]] bool rows_apart() const override { return true; }
  [[nodiscard]] bool is_limit() const override { return true; }
  [[nodiscard]] std::string row_name(const Robot& robot, Index row) const override;

  // Where a body that the coordinates do not move is, and how it moves, until the next call: pose in
  // W [m], velocity of its origin [m/s], angular velocity [rad/s]. The distance then counts that it
  // comes. Throws Error for a body that is in no pair, or a motion that is not finite.
  void set_obstacle(const Robot& robot, const std::string& body, const BodyMotion& motion);
  // all of them where the robot has them, at rest, or where a simulation sees them
  void clear_obstacles() { distances_.clear_motions(); }

  // A simulation says each tick where the bodies are that may move (`loose_bodies`), unless
  // set_obstacle has said so. false: it says nothing.
  void set_sees_obstacles(bool sees) { sees_obstacles_ = sees; }
  [[nodiscard]] bool sees_obstacles() const { return sees_obstacles_; }
  // bodies of its pairs that have joints or a mocap body below them, of no tree of the coordinates
  [[nodiscard]] std::vector<int> loose_bodies(const Robot& robot) const;
  void see_obstacle(int body, const BodyMotion& motion) {
    distances_.set_motion(body, motion, GeomDistance::Source::Seen);
  }
  // of a body of its pairs, none where the robot has it
  [[nodiscard]] std::optional<BodyMotion> obstacle(int body) const {
    return distances_.motion(body);
  }

  [[nodiscard]] const std::vector<GeomPair>& pairs() const { return distances_.pairs(); }
  // the pair of a row at the last update, -1 for none
  [[nodiscard]] Index pair(Index row) const {
    return distances_.near()[static_cast<std::size_t>(row)].pair;
  }
  // the points of a row were nearest before, others are now
  [[nodiscard]] bool is_kept(Index row) const {
    return distances_.near()[static_cast<std::size_t>(row)].kept;
  }

 private:
  void make_rows(double margin);
  // pairs that are nearer than the margin already keep half of what there is
  void keep_half(const std::vector<CollisionPair>& pairs, double margin);

  GeomDistance distances_;
  double most_;
  bool sees_obstacles_ = true;
  std::vector<double> nearer_;  // [m] of each pair: how much less than the margin it keeps
};

// The geoms of a robot keep away from each other, and from what stands around it (and the bodies
// of these names): pairs by collision_pairs.hpp, of the robot in its present configuration.
[[nodiscard]] DistanceTask self_collision(const Robot& robot, const CollisionOptions& options = {});
[[nodiscard]] DistanceTask obstacles(const Robot& robot,
                                     const std::vector<std::string>& bodies = {},
                                     const CollisionOptions& options = {});

}  // namespace hurcules
