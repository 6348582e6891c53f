// Which pairs of geoms of a model are nearest to each other, and how their distances change.
//
// A tick costs the poses of the bodies, and what has come near. Pairs farther apart than `most` and a
// skin on top are not looked at before some body has moved by half of that skin (a Verlet list); of
// the others, bounds that shrink by what bodies move rule out most, then bounding spheres and boxes.
// The pairs that are reported are measured anew when their bodies have moved against each other by a
// twentieth of their distance; in between, their nearest points move with the bodies.
//
// Between flat faces the nearest point jumps from corner to corner. A pair that is near therefore keeps
// the points that were nearest before, as physics engines keep a contact manifold: geoms are convex, so
// along the direction d of the nearest points any other two are at least as far apart,
//   d . (p_2 - p_1) >= distance,
// and what keeps those apart forbids nothing that the distance allows.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hurcules/base/state.hpp"
#include "hurcules/robot/robot.hpp"

namespace hurcules {

struct GeomPair {
  int first = 0, second = 0;  // geom ids
  friend bool operator==(const GeomPair&, const GeomPair&) = default;
};

// The geoms of pairs of names of bodies or geoms; a body stands for all of its geoms that can touch
// something. Throws Error for a name that does not exist, for a body without such geoms, and for two
// that no coordinate moves against each other.
[[nodiscard]] std::vector<GeomPair> named_geom_pairs(
    const Robot& robot, const std::vector<std::pair<std::string, std::string>>& names);

// Where a body is and how it moves that the coordinates do not move.
struct BodyMotion {
  Skeleton::Pose pose;                // [m], in W
  Vector3 linear = Vector3::Zero();   // [m/s] of its origin
  Vector3 angular = Vector3::Zero();  // [rad/s]
};

class GeomDistance {
 public:
  struct Near {
    Index pair = -1;        // -1: nothing that is near; one pair may have several points
    bool kept = false;      // nearest before; others of the pair are now
    double distance = 0.0;  // [m], negative in each other
    // [m] in W, of the geoms of the pair: nearest to each other, deepest in each other, or once so
    Vector3 first = Vector3::Zero(), second = Vector3::Zero();
    Vector3 direction = Vector3::Zero();  // from first to second; 0 where they just touch
  };

  // reports the `count` nearest below `most` [m], up to `points` of a pair; throws Error unless `most`
  // is positive
  GeomDistance(const Robot& robot, std::vector<GeomPair> pairs, double most, std::size_t count,
               std::size_t points = 1);
  GeomDistance(const GeomDistance& other);

  [[nodiscard]] const std::vector<GeomPair>& pairs() const { return pairs_; }
  // At the robot's configuration: the nearest, in no order. A pair, or a point that it keeps, has its
  // place as long as no other is nearer by 5 mm. Until the next call.
  const std::vector<Near>& measure(const Robot& robot);
  [[nodiscard]] const std::vector<Near>& near() const { return near_; }
  // row (n) [m/rad]: how the distance changes with the coordinates; 0 where the pair just touches
  void gradient(const Robot& robot, const Near& near, Eigen::Ref<Eigen::RowVectorXd> row) const;
  // [m/s] the part of its change that comes from bodies of set_motion
  [[nodiscard]] double rate(const Near& near) const;

  // whose word a motion is: what is `Told` stays, whatever is `Seen`
  enum class Source { None, Told, Seen };
  // from now on the body, and what is welded to it, is there, wherever the robot has it; throws
  // Error for a body that is in no pair
  void set_motion(int body, const BodyMotion& motion, Source source = Source::Told);
  [[nodiscard]] std::vector<int> bodies() const;  // of all pairs, each once
  // that of a body of some pair; none where the robot has it
  [[nodiscard]] std::optional<BodyMotion> motion(int body) const;
  void clear_motions();
  // as it was made
  void reset();
  void save(StateWriter& writer) const;
  void restore(StateReader& reader);

 private:
  struct Body {
    int id = 0;
    double radius = 0.0;                  // [m] of a ball about its origin around its geoms
    Skeleton::Pose pose = {}, seen = {};  // now, and when the list was made
    double moved = 0.0;                   // [m] by which no point of it has moved more, since then
    Vector3 linear = Vector3::Zero(), angular = Vector3::Zero();
    Source source = Source::None;  // of its motion
    [[nodiscard]] bool own() const { return source != Source::None; }
  };
  struct Geom {
    int id = 0;
    std::size_t body = 0;         // of bodies_
    Skeleton::Pose mounted = {};  // in the body
    Index tick = 0;               // of the last measure that placed it
  };
  struct Pair {
    std::size_t first = 0, second = 0;  // of geoms_
    // of bodies_: the larger one, and the other, whose motion is seen from it
    std::size_t reference = 0, mover = 0;
    bool reported = false;
    // [m] the distance was at least `bound` when the bodies had moved by `moved`
    double bound = -std::numeric_limits<double>::infinity(), moved = 0.0;
  };
  // what was measured for a pair that is reported, or a point that it keeps
  struct Seen {
    Index pair = -1;
    bool kept = false;  // nearest once; its direction is that of the nearest points
    double distance = 0.0;
    Vector3 first = Vector3::Zero(), second = Vector3::Zero();  // each in its body
    Vector3 direction = Vector3::Zero();                        // in the body of the reference
    Skeleton::Pose mover = {};                                  // in it
  };
  std::size_t add_geom(int geom);
  void place_bodies(const Robot& robot);
  [[nodiscard]] bool list_is_old() const;
  void make_list();
  void place(Geom& geom);  // where MuJoCo looks for it
  // [m] the distance is at least that; looks no further when that is `enough`
  [[nodiscard]] double bound(Pair& pair, double enough);
  [[nodiscard]] Seen look(Index index);
  [[nodiscard]] Near now(const Seen& seen) const;
  void renew_reported();
  void renew(std::size_t place);
  [[nodiscard]] std::size_t place_beside(std::size_t place, const Seen& fresh);
  [[nodiscard]] double spread(std::size_t place, const Seen& fresh) const;
  void move_kept();
  void report(const Seen& seen);
  // free, or taken from what is farther by 5 mm than `distance`; count: none
  [[nodiscard]] std::size_t free_place(double distance);
  void leave(std::size_t place);
  static void forget(Pair& pair);
  [[nodiscard]] double threshold() const;
  [[nodiscard]] Body& body_of(std::size_t geom) { return bodies_[geoms_[geom].body]; }
  [[nodiscard]] const Body& body_of(std::size_t geom) const { return bodies_[geoms_[geom].body]; }
  // pose of its mover in its reference
  [[nodiscard]] Skeleton::Pose mover(const Pair& pair) const;
  [[nodiscard]] double moved(const Pair& pair) const {
    return bodies_[pair.reference].moved + bodies_[pair.mover].moved;
  }
  [[nodiscard]] Pair& pair(Index index) { return table_[static_cast<std::size_t>(index)]; }
  [[nodiscard]] const Pair& pair(Index index) const {
    return table_[static_cast<std::size_t>(index)];
  }
  // as the coordinates move it
  [[nodiscard]] BodyPoint moved_point(std::size_t geom, const Vector3& point) const;
  [[nodiscard]] Vector3 velocity(std::size_t geom, const Vector3& point) const;

  ModelPtr model_;
  mjData_* data_ = nullptr;  // of the robot that is measured, for the poses of geoms
  std::vector<GeomPair> pairs_;
  double most_;
  std::size_t points_;
  std::vector<Body> bodies_;
  std::vector<Geom> geoms_;
  std::vector<Pair> table_;  // of the pairs
  std::vector<Index> list_;  // pairs that may come near before it is made again
  bool listed_ = false;
  Index tick_ = 0;
  std::vector<Seen> seen_;  // (count)
  std::vector<Near> near_;  // (count) the same now
};

}  // namespace hurcules
