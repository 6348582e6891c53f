#include "hurcules/robot/geom_distance.hpp"

#include <mujoco/mujoco.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "hurcules/base/error.hpp"
#include "hurcules/base/values.hpp"
#include "hurcules/robot/geom_bounds.hpp"
#include "hurcules/robot/object_names.hpp"

namespace hurcules {

namespace {

constexpr double kSkin = 0.2;      // [m] of the list
constexpr double kTouches = 1e-9;  // [m] nearer, there is no direction
constexpr double kStale = 0.05;    // of its distance: a pair that moved so much is measured anew
constexpr double kNearer = 5e-3;   // [m] by which a pair must be nearer to take another's place
constexpr double kPlane = 100.0;   // [m] of a plane that moves: how far from its origin it counts
// a pair nearer than kClose `most` keeps its nearest points when others that are kApart [m] away on
// both bodies have become that, until it is nearer than they are by kLeft [m]
constexpr double kClose = 1.0 / 3.0, kApart = 0.01, kLeft = 0.02;

std::vector<int> geoms_of(const Robot& robot, const std::string& name) {
  const mjModel& m = *robot.model();
  const int geom = mj_name2id(&m, mjOBJ_GEOM, name.c_str());
  if (geom >= 0) return {geom};
  const Frame body = robot.frame(name);
  require(body.type == mjOBJ_BODY, "a distance wants bodies or geoms; '" + name + "' is neither");
  std::vector<int> found;
  for (int i = 0; i < m.ngeom; ++i) {
    const bool touches = m.geom_contype[i] != 0 || m.geom_conaffinity[i] != 0;
    if (m.geom_bodyid[i] == body.id && touches) found.push_back(i);
  }
  require(!found.empty(), "body '" + name + "' has no geom that can touch anything");
  return found;
}

Matrix3 rotation(const double* q) {
  return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
}

void put(StateWriter& writer, const Skeleton::Pose& pose) {
  writer.put(pose.p);
  for (Index i = 0; i < 9; ++i) writer.put(pose.R(i));
}

void get(StateReader& reader, Skeleton::Pose& pose) {
  reader.get(pose.p);
  for (Index i = 0; i < 9; ++i) pose.R(i) = reader.get();
}

// of two points on each of two bodies
template <typename Points>
bool apart(const Points& a, const Points& b) {
  return (a.first - b.first).norm() > kApart && (a.second - b.second).norm() > kApart;
}

// [m] no point of a ball of this radius has moved further
double travel(const Skeleton::Pose& from, const Skeleton::Pose& to, double radius) {
  return (to.p - from.p).norm() + radius * M_SQRT1_2 * (to.R - from.R).norm();
}

}  // namespace

std::vector<GeomPair> named_geom_pairs(
    const Robot& robot, const std::vector<std::pair<std::string, std::string>>& names) {
  std::vector<GeomPair> pairs;
  for (const auto& [first, second] : names) {
    const std::vector<int> ours = geoms_of(robot, first), theirs = geoms_of(robot, second);
    require(robot.moves(Frame{mjOBJ_GEOM, ours.front()}, Frame{mjOBJ_GEOM, theirs.front()}),
            "a distance wants bodies that come nearer, no coordinate moves '" + first +
                "' against '" + second + "'");
    for (const int a : ours)
      for (const int b : theirs) pairs.push_back({a, b});
  }
  return pairs;
}

GeomDistance::GeomDistance(const Robot& robot, std::vector<GeomPair> pairs, double most,
                           std::size_t count, std::size_t points)
    : model_(robot.model()),
      pairs_(std::move(pairs)),
      most_(most),
      points_(points),
      seen_(count),
      near_(count) {
  require_number(std::isfinite(most) && most > 0.0,
                 "the largest distance wants a positive number [m]", most);
  for (const GeomPair& pair : pairs_) {
    for (const int geom : {pair.first, pair.second}) {
      require(model_->geom_type[geom] != mjGEOM_HFIELD,
              "a height field has no distance that MuJoCo measures rightly: boxes or meshes do");
    }
    Pair entry;
    entry.first = add_geom(pair.first);
    entry.second = add_geom(pair.second);
    table_.push_back(entry);
  }
  for (Pair& entry : table_) {
    entry.reference = geoms_[entry.first].body;
    entry.mover = geoms_[entry.second].body;
    if (bodies_[entry.reference].radius < bodies_[entry.mover].radius)
      std::swap(entry.reference, entry.mover);
  }
  list_.reserve(pairs_.size());
}

GeomDistance::GeomDistance(const GeomDistance& other)
    : model_(other.model_),
      pairs_(other.pairs_),
      most_(other.most_),
      points_(other.points_),
      bodies_(other.bodies_),
      geoms_(other.geoms_),
      table_(other.table_),
      seen_(other.seen_),
      near_(other.near_) {
  for (Geom& geom : geoms_) geom.tick = 0;
  list_.reserve(pairs_.size());
}

std::size_t GeomDistance::add_geom(int id) {
  const auto known = [id](const Geom& geom) { return geom.id == id; };
  const auto found = std::find_if(geoms_.begin(), geoms_.end(), known);
  if (found != geoms_.end()) return static_cast<std::size_t>(found - geoms_.begin());

  const mjModel& m = *model_;
  Geom geom{.id = id};
  geom.mounted = {Eigen::Map<const Vector3>(m.geom_pos + 3 * id), rotation(m.geom_quat + 4 * id)};
  const int carrier = m.geom_bodyid[id];
  const auto same = [carrier](const Body& body) { return body.id == carrier; };
  const auto body = std::find_if(bodies_.begin(), bodies_.end(), same);
  geom.body = static_cast<std::size_t>(body - bodies_.begin());
  if (body == bodies_.end()) bodies_.push_back({.id = carrier});
  const bool plane = m.geom_type[id] == mjGEOM_PLANE;
  const double reach = plane ? kPlane : geom.mounted.p.norm() + m.geom_rbound[id];
  bodies_[geom.body].radius = std::max(bodies_[geom.body].radius, reach);
  geoms_.push_back(geom);
  return geoms_.size() - 1;
}

const std::vector<GeomDistance::Near>& GeomDistance::measure(const Robot& robot) {
  data_ = &robot.geom_poses();
  place_bodies(robot);
  if (list_is_old()) make_list();
  renew_reported();
  double enough = threshold();
  for (const Index index : list_) {
    Pair& candidate = pair(index);
    if (candidate.reported || bound(candidate, enough) >= enough) continue;
    const Seen found = look(index);
    candidate.bound = found.distance;
    if (found.distance >= enough) continue;
    report(found);
    enough = threshold();
  }
  return near_;
}

void GeomDistance::place_bodies(const Robot& robot) {
  ++tick_;
  for (Body& body : bodies_) {
    const Skeleton::Pose before = body.pose;
    if (!body.own()) body.pose = robot.pose({mjOBJ_BODY, body.id});
    body.moved += travel(before, body.pose, body.radius);
  }
}

// the two bodies that moved most together by the skin
bool GeomDistance::list_is_old() const {
  if (!listed_) return true;
  const auto together = [this](auto way_of) {
    double most = 0.0, second = 0.0;
    for (const Body& body : bodies_) {
      const double way = way_of(body);
      second = std::max(second, std::min(way, most));
      most = std::max(most, way);
    }
    return most + second;
  };
  const auto counted = [](const Body& body) { return body.moved; };
  const auto straight = [](const Body& body) { return travel(body.seen, body.pose, body.radius); };
  return together(counted) >= kSkin && together(straight) >= kSkin;
}

void GeomDistance::make_list() {
  list_.clear();
  // ways are counted from here on
  for (Pair& entry : table_) {
    entry.bound -= moved(entry) - entry.moved;
    entry.moved = 0.0;
  }
  for (Body& body : bodies_) {
    body.seen = body.pose;
    body.moved = 0.0;
  }
  for (std::size_t i = 0; i < table_.size(); ++i)
    if (bound(table_[i], most_ + kSkin) < most_ + kSkin) list_.push_back(static_cast<Index>(i));
  listed_ = true;
}

Skeleton::Pose GeomDistance::mover(const Pair& pair) const {
  const Skeleton::Pose &from = bodies_[pair.reference].pose, &to = bodies_[pair.mover].pose;
  return {from.R.transpose() * (to.p - from.p), from.R.transpose() * to.R};
}

// those whose bodies moved against each other are measured anew; what is not near any more goes
void GeomDistance::renew_reported() {
  for (std::size_t i = 0; i < seen_.size(); ++i) {
    Seen& seen = seen_[i];
    if (seen.pair < 0 || seen.kept) continue;
    const Pair& entry = pair(seen.pair);
    near_[i] = now(seen);
    if (travel(seen.mover, mover(entry), bodies_[entry.mover].radius) >
        kStale * std::max(0.0, near_[i].distance))
      renew(i);
    if (seen.pair >= 0 && !seen.kept && near_[i].distance >= most_) leave(i);
  }
  move_kept();
}

// the nearest points of the pair are looked for; those of before may stay beside them
void GeomDistance::renew(std::size_t place) {
  Seen& before = seen_[place];
  const Seen fresh = look(before.pair);
  near_[place] = now(fresh);
  const bool close = points_ > 1 && fresh.distance < kClose * most_;
  std::size_t next = place;
  if (close && apart(fresh, before)) next = place_beside(place, fresh);
  before.kept = next != place;
  seen_[next] = fresh;
  near_[next] = now(fresh);
}

// where the nearest points go, those at `place` being kept; `place` itself where they are not
std::size_t GeomDistance::place_beside(std::size_t place, const Seen& fresh) {
  std::size_t points = 1, least = place;
  for (std::size_t i = 0; i < seen_.size(); ++i) {
    if (seen_[i].pair != fresh.pair || i == place) continue;
    if (!apart(fresh, seen_[i])) return i;  // nearest once more
    ++points;
    if (spread(i, fresh) < spread(least, fresh)) least = i;
  }
  if (points >= points_) return least;
  const std::size_t free = free_place(fresh.distance);
  return free < seen_.size() ? free : place;
}

// [m] from points of the pair to its others
double GeomDistance::spread(std::size_t place, const Seen& fresh) const {
  const Seen& one = seen_[place];
  const auto way = [&one](const Seen& other) {
    return (one.first - other.first).norm() + (one.second - other.second).norm();
  };
  double sum = way(fresh);
  for (const Seen& other : seen_)
    if (other.pair == fresh.pair) sum += way(other);
  return sum;
}

// along the direction of the nearest points of their pair
void GeomDistance::move_kept() {
  for (std::size_t i = 0; i < seen_.size(); ++i) {
    if (seen_[i].pair < 0 || !seen_[i].kept) continue;
    const auto nearest = [&](const Seen& seen) { return seen.pair == seen_[i].pair && !seen.kept; };
    const auto found = std::find_if(seen_.begin(), seen_.end(), nearest);
    if (found == seen_.end()) {  // of a snapshot that was made up
      seen_[i].pair = near_[i].pair = -1;
      continue;
    }
    const Near& near = near_[static_cast<std::size_t>(found - seen_.begin())];
    near_[i] = now(seen_[i]);
    near_[i].direction = near.direction;
    near_[i].distance = near.direction.dot(near_[i].second - near_[i].first);
    if (near_[i].distance > near.distance + kLeft) seen_[i].pair = near_[i].pair = -1;
  }
}

GeomDistance::Seen GeomDistance::look(Index index) {
  const Pair& entry = pair(index);
  Geom &first = geoms_[entry.first], &second = geoms_[entry.second];
  place(first);
  place(second);
  std::array<double, 6> points{};
  const double distance =
      mj_geomDistance(model_.get(), data_, first.id, second.id, most_ + kSkin, points.data());
  const Vector3 p(points[0], points[1], points[2]),
      apart = Vector3(points[3], points[4], points[5]) - p;
  const Skeleton::Pose &a = body_of(entry.first).pose, &b = body_of(entry.second).pose;
  Seen seen{.pair = index, .distance = distance};
  seen.first = a.R.transpose() * (p - a.p);
  seen.second = b.R.transpose() * (p + apart - b.p);
  const double length = apart.norm();
  if (length >= kTouches)  // also from inside: turned round
    seen.direction =
        bodies_[entry.reference].pose.R.transpose() * apart / (distance < 0.0 ? -length : length);
  seen.mover = mover(entry);
  return seen;
}

// where the points that were nearest are now
GeomDistance::Near GeomDistance::now(const Seen& seen) const {
  const Pair& entry = pair(seen.pair);
  const Skeleton::Pose &a = body_of(entry.first).pose, &b = body_of(entry.second).pose;
  Near near{.pair = seen.pair, .kept = seen.kept, .distance = seen.distance};
  near.first = a.p + a.R * seen.first;
  near.second = b.p + b.R * seen.second;
  near.direction = bodies_[entry.reference].pose.R * seen.direction;
  if (seen.direction != Vector3::Zero())
    near.distance = near.direction.dot(near.second - near.first);
  return near;
}

// a pair that is reported no more; nothing is known about it
void GeomDistance::forget(Pair& pair) {
  pair.reported = false;
  pair.bound = -std::numeric_limits<double>::infinity();
}

// nearest points go with all that their pair has kept
void GeomDistance::leave(std::size_t place) {
  const Index index = seen_[place].pair;
  if (!seen_[place].kept) {
    forget(pair(index));
    for (std::size_t i = 0; i < seen_.size(); ++i)
      if (seen_[i].pair == index) seen_[i].pair = near_[i].pair = -1;
  }
  seen_[place].pair = near_[place].pair = -1;
}

// [m] a pair below it has a place
double GeomDistance::threshold() const {
  double farthest = 0.0;
  for (const Near& near : near_) {
    if (near.pair < 0) return most_;
    farthest = std::max(farthest, near.distance);
  }
  return farthest - kNearer;
}

std::size_t GeomDistance::free_place(double distance) {
  std::size_t place = 0;
  for (std::size_t i = 0; i < near_.size(); ++i) {
    if (near_[i].pair < 0) return i;
    if (near_[i].distance > near_[place].distance) place = i;
  }
  if (near_[place].distance - kNearer <= distance) return near_.size();
  leave(place);
  return place;
}

void GeomDistance::report(const Seen& seen) {
  const std::size_t place = free_place(seen.distance);
  if (place == near_.size()) return;
  pair(seen.pair).reported = true;
  seen_[place] = seen;
  near_[place] = now(seen);
}

void GeomDistance::place(Geom& geom) {
  if (geom.tick == tick_) return;
  geom.tick = tick_;
  using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  const Skeleton::Pose& body = bodies_[geom.body].pose;
  Eigen::Map<Vector3>(data_->geom_xpos + 3 * geom.id) = body.p + body.R * geom.mounted.p;
  Eigen::Map<RowMajor>(data_->geom_xmat + 9 * geom.id) = body.R * geom.mounted.R;
}

double GeomDistance::bound(Pair& pair, double enough) {
  const double way = moved(pair);
  const double known = pair.bound - (way - pair.moved);
  if (known >= enough) return known;
  Geom &first = geoms_[pair.first], &second = geoms_[pair.second];
  place(first);
  place(second);
  pair.moved = way;
  pair.bound = sphere_gap(model_.get(), data_, first.id, second.id);
  if (pair.bound < enough)
    pair.bound = std::max(pair.bound, box_gap(model_.get(), data_, {first.id, second.id}, enough));
  return pair.bound;
}

void GeomDistance::gradient(const Robot& robot, const Near& near,
                            Eigen::Ref<Eigen::RowVectorXd> row) const {
  const Pair& entry = pair(near.pair);
  robot.separation(moved_point(entry.first, near.first), moved_point(entry.second, near.second),
                   near.direction, row);
}

BodyPoint GeomDistance::moved_point(std::size_t geom, const Vector3& point) const {
  const Body& body = body_of(geom);
  return {body.own() ? 0 : body.id, point};
}

double GeomDistance::rate(const Near& near) const {
  const Pair& entry = pair(near.pair);
  return near.direction.dot(velocity(entry.second, near.second) -
                            velocity(entry.first, near.first));
}

Vector3 GeomDistance::velocity(std::size_t geom, const Vector3& point) const {
  const Body& body = body_of(geom);
  if (!body.own()) return Vector3::Zero();
  return body.linear + body.angular.cross(point - body.pose.p);
}

void GeomDistance::set_motion(int id, const BodyMotion& motion, Source source) {
  const mjModel& m = *model_;
  bool found = false;
  for (Body& body : bodies_) {
    // the body, or one that hangs on it without a joint
    int carrier = body.id;
    while (carrier != id && carrier != 0 && m.body_jntnum[carrier] == 0)
      carrier = m.body_parentid[carrier];
    if (carrier != id) continue;
    found = true;
    if (source == Source::Seen && body.source == Source::Told) continue;
    body.source = source;
    const Skeleton::Pose before = body.pose;
    body.pose = motion.pose * Skeleton::between(m, id, body.id, m.qpos0);
    body.moved += travel(before, body.pose, body.radius);
    body.linear = motion.linear + motion.angular.cross(body.pose.p - motion.pose.p);
    body.angular = motion.angular;
  }
  if (found) return;  // no text in a tick
  std::string text = "body ";
  text += name_or_number(m, mjOBJ_BODY, id);
  throw Error(text + " is in no pair");
}

std::vector<int> GeomDistance::bodies() const {
  std::vector<int> ids;
  for (const Body& body : bodies_) ids.push_back(body.id);
  return ids;
}

std::optional<BodyMotion> GeomDistance::motion(int id) const {
  for (const Body& body : bodies_)
    if (body.id == id && body.own()) return BodyMotion{body.pose, body.linear, body.angular};
  return {};
}

void GeomDistance::clear_motions() {
  for (Body& body : bodies_) body.source = Source::None;
}

void GeomDistance::reset() {
  clear_motions();
  for (Pair& entry : table_) forget(entry);
  std::fill(seen_.begin(), seen_.end(), Seen{});
  std::fill(near_.begin(), near_.end(), Near{});
  listed_ = false;
}

void GeomDistance::save(StateWriter& writer) const {
  for (const Body& body : bodies_) {
    writer.put(static_cast<double>(body.source));
    put(writer, body.own() ? body.pose : Skeleton::Pose{});
    writer.put(body.own() ? body.linear : Vector3::Zero());
    writer.put(body.own() ? body.angular : Vector3::Zero());
  }
  for (const Seen& seen : seen_) {
    writer.put(static_cast<double>(seen.pair));
    writer.put(seen.kept ? 1.0 : 0.0);
    writer.put(seen.distance);
    writer.put(seen.first);
    writer.put(seen.second);
    writer.put(seen.direction);
    put(writer, seen.mover);
  }
}

void GeomDistance::restore(StateReader& reader) {
  for (Body& body : bodies_) {
    body.source = static_cast<Source>(reader.get_count(2));
    Skeleton::Pose pose;
    get(reader, pose);
    if (body.own()) body.pose = pose;
    reader.get(body.linear);
    reader.get(body.angular);
  }
  for (Pair& entry : table_) forget(entry);
  for (Seen& seen : seen_) {
    const double index = reader.get();
    require(
        index >= -1.0 && index < static_cast<double>(table_.size()) && index == std::floor(index),
        "the snapshot belongs to another model");
    seen.pair = static_cast<Index>(index);
    seen.kept = reader.get_count(1) > 0;
    seen.distance = reader.get();
    reader.get(seen.first);
    reader.get(seen.second);
    reader.get(seen.direction);
    get(reader, seen.mover);
    if (seen.pair >= 0) pair(seen.pair).reported = true;
  }
  listed_ = false;
  for (std::size_t i = 0; i < seen_.size(); ++i)
    near_[i] = seen_[i].pair < 0 ? Near{} : now(seen_[i]);
}

}  // namespace hurcules
