#include "hurcules/mission/mission.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hurcules/base/error.hpp"
#include "hurcules/mission/variation.hpp"

namespace hurcules {

Mission::Mission(MissionSetup setup, MissionTable table, const WholeBodyController& controller,
                 double variation)
    : setup_(std::move(setup)),
      table_(std::move(table)),
      variation_(variation),
      limits_(controller.law(0).limits()),
      initial_qpos_(controller.plan().qpos()),
      dt_(controller.dt()),
      operated_(Vector::Zero(controller.scale().size())) {
  require(variation_ >= 0.0 && std::isfinite(variation_), "variation wants a number >= 0");
  check_table(table_, controller);
  for (const Measure& measure : table_.measures) {
    figures_.push_back({measure.name, 0.0, std::numeric_limits<double>::quiet_NaN()});
  }
  compile(controller);
}

// the table with places instead of names
void Mission::compile(const WholeBodyController& controller) {
  for (const Task* task : controller.tasks()) {
    if (dynamic_cast<const ForceTask*>(task)) force_names_.push_back(task->name());
  }
  forces_ = Vector::Zero(static_cast<Index>(force_names_.size()));
  const auto watch = [](const Condition& condition) {
    Watch made;
    made.condition = condition;
    return made;
  };
  std::string support = controller.options().support;
  for (const Phase& phase : table_.phases) {
    const std::string where = "phase '" + phase.name + "'";
    Row row;
    if (!phase.support.empty()) support = phase.support;
    row.support = support;
    for (const Lead& lead : phase.leads) {
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
      way.at = lead.at;
      way.span = lead.span;
      row.ways.push_back(std::move(way));
    }
    if (!phase.keys.empty()) {
      const ChannelPlace place = find_channel(controller, phase.posture, where);
      const std::vector<std::string>& joints = place.channel->joint_names();
      row.posture_row = place.row;
      row.posture_size = place.channel->size();
      row.places = Vector::Zero(static_cast<Index>(joints.size()));
      for (const std::string& joint : joints) row.joints.push_back(controller.servo().find(joint));
      row.posture.emplace(phase.keys,
                          joints.empty() ? controller.plan().coordinate_names() : joints,
                          phase.seconds, !joints.empty());
    }
    for (const Condition& condition : phase.done) row.done.push_back(watch(condition));
    for (const Reaction& reaction : phase.late) row.late_left.push_back(reaction.times);
    for (const Trouble& trouble : phase.troubles) {
      row.troubles.push_back(watch(trouble.when));
      row.troubles_left.emplace_back();
      for (const Reaction& reaction : trouble.reactions) {
        row.troubles_left.back().push_back(reaction.times);
      }
    }
    rows_.push_back(std::move(row));
  }
}

std::unique_ptr<Supervisor> Mission::clone(WholeBodyController& controller) const {
  auto copy = std::make_unique<Mission>(setup_, table_, controller, variation_);
  copy->initial_qpos_ = initial_qpos_;
  return copy;
}

void Mission::attach(const Plant& plant, Recorder& log) {
  model_ = plant.model();
  data_ = plant.data();
  log.add("mission/elapsed_s", &elapsed_);
  log.add("mission/progress", &progress_);
  log.add("mission/waiting", &waiting_);
  log.add("mission/force", force_names_, forces_);
  if (!setup_.casualty.empty()) {
    casualty_ = std::make_unique<CasualtyWatch>(plant.model(), setup_.casualty, setup_.stand_off);
    casualty_->add_log_channels(log);
  }
  if (!setup_.load.empty()) {
    load_ = std::make_unique<LoadWatch>(plant.model(), setup_.load, setup_.container);
    load_->add_log_channels(log, "load");
    places_.reserve(2);  // the log reads where they are
    places_.emplace_back("load", PlaceWatch(plant.model(), setup_.load, setup_.stand_off));
    if (!setup_.container.empty()) {
      places_.emplace_back("container",
                           PlaceWatch(plant.model(), setup_.container, setup_.container_stand));
    }
    for (const auto& [prefix, place] : places_) place.add_log_channels(log, prefix);
    errors_.assign(places_.size(), Vector::Zero(4));
  }
  find_brakes(plant.brakes());
  const auto find = [&log](const std::string& where, const std::string& quantity) {
    const double* const source = log.source(quantity);
    if (!source) throw Error(where + ": " + unknown_name("quantity", quantity, log.channels()));
    return source;
  };
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const std::string where = "phase '" + table_.phases[i].name + "'";
    for (std::vector<Watch>* watches : {&rows_[i].done, &rows_[i].troubles}) {
      for (Watch& watch : *watches) watch.source = find(where, watch.condition.quantity);
    }
    const std::vector<Lead>& leads = table_.phases[i].leads;
    for (std::size_t k = 0; k < leads.size(); ++k) {
      if (!leads[k].hold.empty()) rows_[i].ways[k].held = find(where, leads[k].hold);
      for (const std::string& quantity : leads[k].to) {
        rows_[i].ways[k].seen.push_back(quantity.empty() ? nullptr : find(where, quantity));
      }
    }
  }
  gauges_.clear();
  for (const Measure& measure : table_.measures) {
    const std::string where = "figure '" + measure.name + "'";
    Gauge gauge;
    gauge.source = find(where, measure.quantity);
    gauge.counts.assign(rows_.size(), measure.phases.empty());
    for (const std::string& phase : measure.phases) {
      gauge.counts[find_phase(table_.phases, phase, where)] = true;
    }
    gauges_.push_back(std::move(gauge));
  }
  attached_ = true;
}

void Mission::find_brakes(const Brakes& brakes) {
  const std::vector<std::string> joints = brakes.names();
  std::vector<std::vector<int>> named;
  for (const Phase& phase : table_.phases) {
    named.emplace_back();
    for (const std::string& name : phase.brakes) {
      const std::vector<Index> found = coordinates_of(name, joints);
      if (found.empty()) {
        throw Error("phase '" + phase.name + "': " + unknown_name("brake", name, joints));
      }
      for (const Index at : found) {
        named.back().push_back(brakes.find(joints[static_cast<std::size_t>(at)]));
      }
    }
    for (const int actuator : named.back()) {
      if (std::find(brakes_.begin(), brakes_.end(), actuator) == brakes_.end()) {
        brakes_.push_back(actuator);
      }
    }
  }
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    for (const int actuator : brakes_) {
      rows_[i].shut.push_back(std::find(named[i].begin(), named[i].end(), actuator) !=
                              named[i].end());
    }
  }
}

void Mission::brake(Brakes& brakes) {
  for (std::size_t i = 0; i < brakes_.size(); ++i) {
    brakes.set_closed(brakes_[i], rows_[phase_].shut[i]);
  }
}

bool Mission::needs_log() const {
  return !table_.measures.empty() || !setup_.casualty.empty() ||
         std::any_of(rows_.begin(), rows_.end(),
                     [](const Row& row) { return !row.done.empty() || !row.troubles.empty(); }) ||
         std::any_of(table_.phases.begin(), table_.phases.end(), [](const Phase& phase) {
           return std::any_of(phase.leads.begin(), phase.leads.end(), [](const Lead& lead) {
             return !lead.to.empty() || !lead.hold.empty();
           });
         });
}

Vector Mission::start(const Plant& plant, Robot& robot, std::uint64_t seed) {
  Vector qpos = setup_.keyframe.empty() ? initial_qpos_
                                        : plant.keyframe_qpos(plant.find_keyframe(setup_.keyframe));
  Random random(seed);
  Variation variation;
  variation.scale = variation_;
  const int casualty = plant.other_free_joint(robot.root_body());
  if (casualty >= 0) vary_place(variation, random, qpos.segment<7>(casualty));
  for (Vector& error : errors_) {  // of what is seen, at most two standard deviations
    for (double& part : error) part = variation_ * std::clamp(random.normal(), -2.0, 2.0);
  }
  // the posture varies, the support stays: the root of the robot follows
  robot.set_qpos(qpos);
  Vector q = robot.configuration();
  if (limits_) vary_posture(variation, random, {limits_->lower(), limits_->upper()}, q);
  robot.set_configuration(q);
  return robot.qpos();
}

void Mission::reset(WholeBodyController& controller, const Robot& world) {
  require(attached_ || !needs_log(), "a mission with conditions wants a simulation");
  for (Figure& figure : figures_) figure.value = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < rows_.size(); ++i) start_anew(table_.phases[i], rows_[i]);
  for (Gauge& gauge : gauges_) {
    gauge.seen_least = gauge.seen_most = std::numeric_limits<double>::quiet_NaN();
  }
  why_ = {};
  cause_ = 0;
  wait_until_ = 0.0;
  forces_.setZero();
  verdict_.clear();
  answer_.reset();
  paused_ = ended_ = false;
  if (casualty_) casualty_->reset();
  if (load_) load_->reset();
  for (std::size_t i = 0; i < places_.size(); ++i) places_[i].second.set_error(errors_[i]);
  begin(controller, world);
  enter(0, controller, 0.0);
}

void Mission::start_anew(const Phase& phase, Row& row) {
  for (std::size_t i = 0; i < phase.late.size(); ++i) row.late_left[i] = phase.late[i].times;
  for (std::size_t i = 0; i < phase.troubles.size(); ++i) {
    const std::vector<Reaction>& reactions = phase.troubles[i].reactions;
    for (std::size_t k = 0; k < reactions.size(); ++k) {
      row.troubles_left[i][k] = reactions[k].times;
    }
  }
  for (std::vector<Watch>* watches : {&row.done, &row.troubles}) {
    for (Watch& watch : *watches) watch.since = 0.0;
  }
  for (Way& way : row.ways) way.given = 0.0;
  if (row.posture) row.posture->start(Vector::Zero(row.posture_size));
}

void Mission::enter(std::size_t phase, WholeBodyController& controller, double time) {
  phase_ = phase;
  phase_start_ = now_ = time;
  doing_ = Doing::Leading;
  elapsed_ = progress_ = waiting_ = extra_ = 0.0;
  Row& row = rows_[phase_];
  for (std::vector<Watch>* watches : {&row.done, &row.troubles}) {
    for (Watch& watch : *watches) watch.since = 0.0;
  }
  for (Way& way : row.ways) {
    way.given = 0.0;
    for (std::size_t i = 0; i < way.seen.size(); ++i) {
      const auto k = static_cast<Index>(i);
      way.along[k] = way.by[k] + (way.seen[i] ? *way.seen[i] : 0.0);
    }
  }
  const std::string& stack = table_.phases[phase_].stack;
  if (stack == kJoints) {
    controller.move_joints();
  } else if (controller.moves_joints() || controller.stacks()[controller.active()].name != stack) {
    controller.use(stack);
    controller.hold_targets();  // where the plan is: nothing jumps
  }
  if (!row.support.empty() && controller.plan().support_name() != row.support) {
    controller.stand_on(row.support);
  }
  if (row.posture) {
    for (std::size_t i = 0; i < row.joints.size(); ++i) {
      row.places[static_cast<Index>(i)] = controller.servo().position()[row.joints[i]];
    }
    row.posture->start(row.joints.empty() ? controller.q_des() : row.places);
  }
  entered(time);
}

const Vector& Mission::command(double dt) {
  operated_.setZero();
  if (doing_ != Doing::Leading || paused_) return operated_;
  const double time = now_ - phase_start_, seconds = table_.phases[phase_].seconds;
  Row& row = rows_[phase_];
  for (const Way& way : row.ways) {
    auto part = operated_.segment(way.row, way.size);
    if (way.length > 0.0) {  // by a rate; the last tick gives what is left
      part = way.along * std::min(way.speed, (way.length - way.given) / dt);
      if (way.held) part *= std::clamp((way.at - *way.held) / way.span, -1.0, 1.0);
    } else {
      part = way.along * ((smooth_step((time + dt) / seconds) - smooth_step(time / seconds)) / dt);
    }
  }
  if (row.posture) {
    row.posture->velocity(time, dt, operated_.segment(row.posture_row, row.posture_size));
  }
  return operated_;
}

double Mission::given() const {
  double sum = 0.0;
  int count = 0;
  for (const Way& way : rows_[phase_].ways) {
    if (way.length <= 0.0 || !std::isfinite(way.length)) continue;
    sum += way.given / way.length;
    ++count;
  }
  return count > 0 ? sum / count : 1.0;
}

double Mission::progress(double elapsed) const {
  const double seconds = table_.phases[phase_].seconds;
  return std::min(seconds > 0.0 ? elapsed / seconds : 1.0, given());
}

void Mission::note_commanded(const WholeBodyController& controller, const TickReport& report) {
  const Vector& command = controller.command();
  for (Way& way : rows_[phase_].ways) {
    if (way.length > 0.0) {
      way.given += way.along.dot(command.segment(way.row, way.size)) * controller.dt();
    }
  }
  Index force = 0;
  for (const Task* task : controller.tasks()) {
    if (const auto* const one = dynamic_cast<const ForceTask*>(task))
      forces_[force++] = one->force();
  }
  commanded(controller, report);
}

void Mission::note_measured(const TickReport& report) {
  if (casualty_) casualty_->look(model_, data_);
  if (load_) load_->look(model_, data_);
  for (auto& [prefix, place] : places_) place.look(model_, data_);
  for (std::size_t i = 0; i < gauges_.size(); ++i) {
    if (!gauges_[i].counts[phase_]) continue;
    gauges_[i].look(table_.measures[i].take, figures_[i].value);
  }
  measured(report);
}

bool Mission::advance(WholeBodyController& controller, double time) {
  now_ = time;
  if (paused_ || doing_ != Doing::Leading) return wait(time, controller);
  elapsed_ = time - phase_start_;
  progress_ = progress(elapsed_);
  std::optional<std::size_t> cause;
  for (std::size_t i = 0; i < rows_[phase_].troubles.size(); ++i) {
    if (rows_[phase_].troubles[i].look(dt_) && !cause) cause = i + 1;
  }
  if (!cause && elapsed_ > table_.phases[phase_].within + extra_) cause = 0;
  if (cause) return react(*cause, controller, time);
  while (over(time)) {
    if (phase_ + 1 == rows_.size() || table_.phases[phase_].last) {
      ended_ = true;
      tell();
      return false;
    }
    enter(phase_ + 1, controller, time);
  }
  return true;
}

bool Mission::over(double time) {
  bool done = progress(time - phase_start_) >= 1.0;
  for (Watch& watch : rows_[phase_].done) done = watch.look(dt_) && done;
  return done;
}

bool Mission::Watch::look(double dt) {
  const bool now = condition.above ? *source >= condition.value : *source <= condition.value;
  const bool long_enough = since >= condition.seconds;  // so far
  since = now ? since + dt : 0.0;
  return now && long_enough;
}

void Mission::Gauge::look(Measure::Take take, double& value) {
  const double now = *source;
  if (!(seen_least <= now)) seen_least = now;
  if (!(seen_most >= now)) seen_most = now;
  switch (take) {
    case Measure::Take::Largest:
      value = seen_most;
      break;
    case Measure::Take::Smallest:
      value = seen_least;
      break;
    case Measure::Take::Span:
      value = seen_most - seen_least;
      break;
    case Measure::Take::Last:
      value = now;
      break;
  }
}

// the first reaction that is left; none: abort
bool Mission::react(std::size_t cause, WholeBodyController& controller, double time) {
  const Phase& phase = table_.phases[phase_];
  const std::vector<Reaction>& reactions =
      cause == 0 ? phase.late : phase.troubles[cause - 1].reactions;
  std::vector<int>& left =
      cause == 0 ? rows_[phase_].late_left : rows_[phase_].troubles_left[cause - 1];
  for (std::size_t i = 0; i < reactions.size(); ++i) {
    if (left[i] == 0) continue;
    --left[i];
    switch (reactions[i].kind) {
      case ReactionKind::Back:
        if (!why_.final) why_ = {phase_ + 1, cause, false};
        enter(find_phase(table_.phases, reactions[i].phase, ""), controller, time);
        return true;
      case ReactionKind::Hold:
      case ReactionKind::Ask:
        doing_ = reactions[i].kind == ReactionKind::Hold ? Doing::Holding : Doing::Asking;
        wait_until_ = time + reactions[i].seconds;
        cause_ = cause;
        answer_.reset();
        waiting_ = 1.0;
        return true;
      case ReactionKind::Lower:
        why_ = {phase_ + 1, cause, true};
        tell();
        enter(find_phase(table_.phases, table_.safety, ""), controller, time);
        return true;
      case ReactionKind::Abort:
        break;
    }
  }
  why_ = {phase_ + 1, cause, true};
  ended_ = true;
  tell();
  return false;
}

// holds, asks or is paused: the clock of the phase stands
bool Mission::wait(double time, WholeBodyController& controller) {
  phase_start_ += dt_;
  if (paused_ || doing_ == Doing::Leading) return true;
  const bool silent = time >= wait_until_;
  const bool asks = doing_ == Doing::Asking;
  if (!silent && !(asks && answer_)) return true;
  const bool go_on = asks ? answer_.value_or(false) : true;
  answer_.reset();
  waiting_ = 0.0;
  doing_ = Doing::Leading;
  if (!go_on) return react(cause_, controller, time);
  if (asks && cause_ == 0) extra_ = elapsed_;  // as much time once more
  return true;
}

// what is missing, in words: why it was lowered or aborted, else the first figure out of its bounds,
// and what it went back for
void Mission::tell() {
  verdict_.clear();
  std::string cause;
  if (why_.phase > 0) {
    const Phase& phase = table_.phases[why_.phase - 1];
    cause = "phase '" + phase.name + "': ";
    cause += why_.cause == 0 ? std::string("took too long")
                             : to_string(phase.troubles[why_.cause - 1].when);
  }
  if (why_.final) verdict_ = cause;
  if (why_.final || !ended_) return;
  for (std::size_t i = 0; i < table_.measures.size(); ++i) {
    const Measure& measure = table_.measures[i];
    const double value = figures_[i].value;
    if (value >= measure.least && value <= measure.most) continue;
    const bool high = value > measure.most;
    verdict_ = measure.name + " is " + to_text(value) + ", wanted at ";
    verdict_ += high ? "most " : "least ";
    verdict_ += to_text(high ? measure.most : measure.least);
    if (!cause.empty()) verdict_ += "; " + cause;
    return;
  }
}

std::vector<std::string> Mission::phase_names() const {
  std::vector<std::string> names;
  for (const Phase& phase : table_.phases) names.push_back(phase.name);
  return names;
}

void Mission::save(StateWriter& writer) const {
  for (const std::size_t number : {phase_, cause_, why_.phase, why_.cause}) {
    writer.put(static_cast<double>(number));
  }
  for (const bool flag : {paused_, ended_, why_.final}) writer.put(flag ? 1.0 : 0.0);
  writer.put(static_cast<double>(static_cast<int>(doing_)));
  for (const double value :
       {phase_start_, now_, wait_until_, extra_, elapsed_, progress_, waiting_}) {
    writer.put(value);
  }
  for (const Figure& figure : figures_) writer.put(figure.value);
  for (const Gauge& gauge : gauges_) {
    writer.put(gauge.seen_least);
    writer.put(gauge.seen_most);
  }
  for (const Row& row : rows_) {
    for (const int left : row.late_left) writer.put(left);
    for (const std::vector<int>& lefts : row.troubles_left) {
      for (const int left : lefts) writer.put(left);
    }
    for (const Watch& watch : row.done) writer.put(watch.since);
    for (const Watch& watch : row.troubles) writer.put(watch.since);
    for (const Way& way : row.ways) {
      writer.put(way.given);
      if (way.by.size() > 0) writer.put(way.along);
    }
    if (row.posture) row.posture->save(writer);
  }
  if (casualty_) casualty_->save(writer);
  if (load_) load_->save(writer);
  for (const auto& [prefix, place] : places_) place.save(writer);
  save_memory(writer);
}

void Mission::restore(StateReader& reader) {
  const auto phases = static_cast<Index>(rows_.size());
  phase_ = static_cast<std::size_t>(reader.get_count(phases - 1));
  const auto causes = static_cast<Index>(rows_[phase_].troubles.size());
  cause_ = static_cast<std::size_t>(reader.get_count(causes));
  why_.phase = static_cast<std::size_t>(reader.get_count(phases));
  const std::size_t most = why_.phase > 0 ? rows_[why_.phase - 1].troubles.size() : 0;
  why_.cause = static_cast<std::size_t>(reader.get_count(static_cast<Index>(most)));
  paused_ = reader.get_count(1) > 0;
  ended_ = reader.get_count(1) > 0;
  why_.final = reader.get_count(1) > 0;
  doing_ = static_cast<Doing>(reader.get_count(static_cast<Index>(Doing::Asking)));
  for (double* value :
       {&phase_start_, &now_, &wait_until_, &extra_, &elapsed_, &progress_, &waiting_}) {
    *value = reader.get();
  }
  for (Figure& figure : figures_) figure.value = reader.get_any();
  for (Gauge& gauge : gauges_) {
    gauge.seen_least = reader.get_any();
    gauge.seen_most = reader.get_any();
  }
  constexpr Index kMost = 1'000'000;
  for (Row& row : rows_) {
    for (int& left : row.late_left) left = static_cast<int>(reader.get_count(kMost));
    for (std::vector<int>& lefts : row.troubles_left) {
      for (int& left : lefts) left = static_cast<int>(reader.get_count(kMost));
    }
    for (Watch& watch : row.done) watch.since = reader.get();
    for (Watch& watch : row.troubles) watch.since = reader.get();
    for (Way& way : row.ways) {
      way.given = reader.get();
      if (way.by.size() > 0) reader.get(way.along);
    }
    if (row.posture) row.posture->restore(reader);
  }
  if (casualty_) casualty_->restore(reader);
  if (load_) load_->restore(reader);
  for (auto& [prefix, place] : places_) place.restore(reader);
  answer_.reset();
  tell();
  restore_memory(reader);
}

}  // namespace hurcules
