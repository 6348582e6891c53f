#include "hurcules/mission/phase_row.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hurcules/base/error.hpp"

namespace hurcules {

PhaseRow::PhaseRow(const Phase& phase, std::string support, const WholeBodyController& controller)
    : phase_(&phase), support_(std::move(support)) {
  const std::string where = "phase '" + phase.name + "'";
  for (const Lead& lead : phase.leads) ways_.push_back(way_of(lead, controller, where));
  if (!phase.keys.empty()) {
    const ChannelPlace place = find_channel(controller, phase.posture, where);
    const std::vector<std::string>& joints = place.channel->joint_names();
    posture_row_ = place.row;
    posture_size_ = place.channel->size();
    places_ = Vector::Zero(static_cast<Index>(joints.size()));
    for (const std::string& joint : joints) joints_.push_back(controller.servo().find(joint));
    posture_.emplace(phase.keys, joints.empty() ? controller.plan().coordinate_names() : joints,
                     phase.seconds, !joints.empty());
  }
  if (phase.park) park_.emplace(*phase.park, find_tracks(controller, where), controller.dt());
  const auto timed = [](const Condition& condition) {
    TimedCondition made;
    made.condition = condition;
    return made;
  };
  for (const Condition& condition : phase.done) done_.push_back(timed(condition));
  left_.emplace_back(phase.late.size());
  for (const Trouble& trouble : phase.troubles) {
    troubles_.push_back(timed(trouble.when));
    left_.emplace_back(trouble.reactions.size());
  }
  reset();
}

PhaseRow::Way PhaseRow::way_of(const Lead& lead, const WholeBodyController& controller,
                               const std::string& where) {
  const ChannelPlace place = find_channel(controller, lead.channel, where);
  Way way;
  way.row = place.row;
  way.size = place.channel->size();
  way.along = lead.by;
  if (lead.rate.size() > 0) {
    way.speed = lead.rate.norm();
    way.along = way.speed > 0.0 ? Vector(lead.rate / way.speed) : lead.rate;
    way.length = lead.way;
  }
  if (!lead.to.empty()) way.by = lead.by;
  if (lead.value.size() > 0) {
    way.set = true;
    way.follow = lead.follow;
    way.along = way.by = lead.value;
  }
  way.at = lead.at;
  way.span = lead.span;
  if (lead.brake) way.braked = place.channel->joint_names();
  return way;
}

void PhaseRow::find_quantities(SceneQuantities& scene) {
  const std::string where = "phase '" + phase_->name + "'";
  for (std::vector<TimedCondition>* conditions : {&done_, &troubles_}) {
    for (TimedCondition& timed : *conditions) {
      timed.source = scene.find(timed.condition.quantity, where);
    }
  }
  for (std::size_t k = 0; k < ways_.size(); ++k) {
    const Lead& lead = phase_->leads[k];
    if (!lead.hold.empty()) ways_[k].held = scene.find(lead.hold, where);
    for (const std::string& quantity : lead.to) {
      ways_[k].seen.push_back(quantity.empty() ? nullptr : scene.find(quantity, where));
    }
  }
}

std::vector<int> PhaseRow::find_brakes(const Brakes& brakes) {
  const std::vector<std::string> joints = brakes.names();
  const std::string where = "phase '" + phase_->name + "'";
  const auto find = [&](const std::string& name, std::vector<int>& actuators) {
    const std::vector<Index> found = coordinates_of(name, joints);
    if (found.empty()) throw Error(where + ": " + unknown_name("brake", name, joints));
    for (const Index at : found) {
      actuators.push_back(brakes.find(joints[static_cast<std::size_t>(at)]));
    }
  };
  for (const std::string& name : phase_->brakes) find(name, brakes_);
  std::vector<int> all = brakes_;
  for (Way& way : ways_) {
    for (const std::string& joint : way.braked) find(joint, way.brakes);
    all.insert(all.end(), way.brakes.begin(), way.brakes.end());
  }
  return all;
}

void PhaseRow::look_at_brakes(double dt) {
  constexpr double kFallen = 0.1;  // [s]: a knock opens no brake
  for (Way& way : ways_) {
    if (way.brakes.empty() || !std::isfinite(*way.held)) continue;
    way.fallen = *way.held < way.at - way.span ? way.fallen + dt : 0.0;
    way.borne = way.borne ? way.fallen < kFallen : *way.held >= way.at;
  }
}

bool PhaseRow::shuts(int actuator, bool still) const {
  const auto in = [&](const std::vector<int>& brakes) {
    return std::find(brakes.begin(), brakes.end(), actuator) != brakes.end();
  };
  for (const Way& way : ways_) {
    if (in(way.brakes)) return way.borne || (still && !way.operated);
  }
  return in(brakes_);
}

void PhaseRow::go_on_bearing(const PhaseRow& before) {
  for (Way& way : ways_) {
    for (const Way& last : before.ways_) {
      if (way.brakes != last.brakes || way.at != last.at || way.span != last.span) continue;
      way.borne = last.borne;
      way.fallen = last.fallen;
    }
  }
}

void PhaseRow::find_places(const Plant& plant, int robot) {
  if (park_) park_->attach(plant, robot, "phase '" + phase_->name + "'");
}

bool PhaseRow::needs_log() const {
  return park_ || !done_.empty() || !troubles_.empty() ||
         std::any_of(phase_->leads.begin(), phase_->leads.end(),
                     [](const Lead& lead) { return !lead.to.empty() || !lead.hold.empty(); });
}

void PhaseRow::reset() {
  for (std::size_t cause = 0; cause < left_.size(); ++cause) {
    const std::vector<Reaction>& row =
        reactions(cause == 0 ? std::nullopt : std::optional(cause - 1));
    for (std::size_t k = 0; k < row.size(); ++k) left_[cause][k] = row[k].times;
  }
  forget();
  if (posture_) posture_->start(Vector::Zero(posture_size_));
  if (park_) park_->reset();
}

void PhaseRow::forget() {
  for (std::vector<TimedCondition>* conditions : {&done_, &troubles_}) {
    for (TimedCondition& timed : *conditions) timed.since = 0.0;
  }
  for (Way& way : ways_) {
    way.given = way.fallen = 0.0;
    way.borne = way.operated = false;
  }
}

void PhaseRow::enter(const WholeBodyController& controller) {
  forget();
  seconds_ = phase_->seconds;
  blind_way_ = blind_entry_ = -1;
  for (Way& way : ways_) {
    const Index blind = look(way);
    if (blind >= 0 && blind_way_ < 0) {
      blind_way_ = &way - ways_.data();
      blind_entry_ = blind;
    }
    if (way.seen.empty() || way.set) continue;
    for (Index i = 0; i < way.size; ++i) {
      const double scale = controller.scale()[way.row + i];
      seconds_ = std::max(seconds_, kSmoothPeak * std::abs(way.along[i]) / scale);
    }
  }
  if (park_) park_->enter();
  if (!posture_) return;
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    places_[static_cast<Index>(i)] = controller.servo().position()[joints_[i]];
  }
  posture_->start(joints_.empty() ? controller.q_des() : places_);
}

Index PhaseRow::look(Way& way) {
  Index blind = -1;
  for (std::size_t i = 0; i < way.seen.size(); ++i) {
    const auto k = static_cast<Index>(i);
    const double seen = way.seen[i] ? *way.seen[i] : 0.0;
    if (std::isfinite(seen)) {
      way.along[k] = way.by[k] + seen;
    } else {
      blind = k;
    }
  }
  return blind;
}

const std::string* PhaseRow::blind() const {
  if (blind_way_ < 0) return nullptr;
  const Lead& lead = phase_->leads[static_cast<std::size_t>(blind_way_)];
  return &lead.to[static_cast<std::size_t>(blind_entry_)];
}

void PhaseRow::command(double time, double dt, Vector& out) {
  for (Way& way : ways_) {
    auto part = out.segment(way.row, way.size);
    if (way.set) {
      if (way.follow) look(way);
      part = way.along;
    } else if (way.length > 0.0) {  // by a rate; the last tick gives what is left
      part = way.along * std::min(way.speed, (way.length - way.given) / dt);
      if (!way.brakes.empty()) {
        part *= way.borne || !std::isfinite(*way.held) ? 0.0 : 1.0;
      } else if (way.held) {
        part *= std::clamp((way.at - *way.held) / way.span, -1.0, 1.0);
      }
    } else {
      part =
          way.along * ((smooth_step((time + dt) / seconds_) - smooth_step(time / seconds_)) / dt);
    }
  }
  if (park_) park_->command(out);
  if (posture_) posture_->velocity(time, dt, out.segment(posture_row_, posture_size_));
}

void PhaseRow::note(const WholeBodyController& controller, const Vector& own) {
  const Vector& command = controller.command();
  const double dt = controller.dt();
  for (Way& way : ways_) {
    const auto given = command.segment(way.row, way.size);
    if (way.length > 0.0) way.given += way.along.dot(given) * dt;
    way.operated = !given.isZero(0.0) && given != own.segment(way.row, way.size);
    if (way.operated) way.borne = false;
  }
  if (park_) park_->note(controller.drive()->controller().braked());
}

double PhaseRow::given() const {
  double sum = 0.0;
  int count = 0;
  for (const Way& way : ways_) {
    if (way.length <= 0.0 || !std::isfinite(way.length)) continue;
    sum += way.given / way.length;
    ++count;
  }
  return count > 0 ? sum / count : 1.0;
}

double PhaseRow::progress(double elapsed) const {
  if (park_ && !park_->done()) return 0.0;
  const auto sets = [](const Way& way) { return way.set; };
  if (elapsed <= 0.0 && std::any_of(ways_.begin(), ways_.end(), sets)) return 0.0;
  return std::min(seconds_ > 0.0 ? elapsed / seconds_ : 1.0, given());
}

bool PhaseRow::done(double dt) {
  bool all = true;
  for (TimedCondition& timed : done_) all = timed.look(dt) && all;
  return all;
}

std::optional<std::size_t> PhaseRow::trouble(double dt) {
  std::optional<std::size_t> first;
  for (std::size_t i = 0; i < troubles_.size(); ++i) {
    if (troubles_[i].look(dt) && !first) first = i;
  }
  return first;
}

bool PhaseRow::TimedCondition::look(double dt) {
  const bool is = now();
  const bool long_enough = since >= condition.seconds;  // so far
  if (is && since < 0.0) return false;
  since = is ? since + dt : 0.0;
  return is && long_enough;
}

bool PhaseRow::TimedCondition::now() const {
  return condition.above ? *source >= condition.value : *source <= condition.value;
}

std::optional<std::size_t> PhaseRow::unmet() const {
  for (std::size_t i = 0; i < done_.size(); ++i) {
    if (!done_[i].now() || done_[i].since < done_[i].condition.seconds) return i;
  }
  return std::nullopt;
}

const std::vector<Reaction>& PhaseRow::reactions(std::optional<std::size_t> trouble) const {
  return trouble ? phase_->troubles[*trouble].reactions : phase_->late;
}

std::optional<std::size_t> PhaseRow::react(std::optional<std::size_t> trouble) {
  const std::vector<Reaction>& row = reactions(trouble);
  std::vector<int>& left = left_[trouble ? *trouble + 1 : 0];
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (left[i] == 0) continue;
    --left[i];
    return i;
  }
  return std::nullopt;
}

void PhaseRow::excuse(std::size_t trouble) {
  troubles_[trouble].since = -1.0;
}

void PhaseRow::refuse(std::optional<std::size_t> trouble) {
  const std::vector<Reaction>& row = reactions(trouble);
  std::vector<int>& left = left_[trouble ? *trouble + 1 : 0];
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (row[i].kind == ReactionKind::Ask && left[i] < row[i].times) left[i] = 0;
  }
}

void PhaseRow::save(StateWriter& writer) const {
  for (const std::vector<int>& times : left_) {
    for (const int left : times) writer.put(left);
  }
  writer.put(seconds_);
  writer.put(static_cast<double>(blind_way_ + 1));
  writer.put(static_cast<double>(blind_entry_ + 1));
  for (const TimedCondition& timed : done_) writer.put(timed.since);
  for (const TimedCondition& timed : troubles_) writer.put(timed.since);
  for (const Way& way : ways_) {
    writer.put(way.given);
    writer.put(way.borne ? 1.0 : 0.0);
    writer.put(way.fallen);
    writer.put(way.operated ? 1.0 : 0.0);
    if (way.by.size() > 0) writer.put(way.along);
  }
  if (posture_) posture_->save(writer);
  if (park_) park_->save(writer);
}

void PhaseRow::restore(StateReader& reader) {
  constexpr Index kMost = 1'000'000;
  for (std::vector<int>& times : left_) {
    for (int& left : times) left = static_cast<int>(reader.get_count(kMost));
  }
  seconds_ = reader.get();
  blind_way_ = reader.get_count(static_cast<Index>(ways_.size())) - 1;
  const auto blind = static_cast<std::size_t>(std::max<Index>(blind_way_, 0));
  const std::size_t entries = ways_.empty() ? 0 : phase_->leads[blind].to.size();
  blind_entry_ = reader.get_count(static_cast<Index>(entries)) - 1;
  for (TimedCondition& timed : done_) timed.since = reader.get();
  for (TimedCondition& timed : troubles_) timed.since = reader.get();
  for (Way& way : ways_) {
    way.given = reader.get();
    way.borne = reader.get_count(1) > 0;
    way.fallen = reader.get();
    way.operated = reader.get_count(1) > 0;
    if (way.by.size() > 0) reader.get(way.along);
  }
  if (posture_) posture_->restore(reader);
  if (park_) park_->restore(reader);
}

}  // namespace hurcules
