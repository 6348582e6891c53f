#include "hurcules/mission/mission.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "hurcules/base/error.hpp"
#include "hurcules/mission/support_check.hpp"
#include "hurcules/mission/table_words.hpp"
#include "hurcules/mission/variation.hpp"

namespace hurcules {

namespace {

void check_setup(const MissionSetup& setup, const Robot& plan) {
  const auto want = [](bool right, const char* name, const char* wanted, double came) {
    require(right, "[mission]: " + std::string(name) + " wants " + wanted + ", " + to_text(came) +
                       " came");
  };
  want(setup.max_seconds > 0.0, "max_seconds", "a time above 0 [s]", setup.max_seconds);
  want(setup.max_tilt >= 0.0 && setup.max_tilt <= std::numbers::pi, "max_tilt",
       "an angle from 0 (nobody looks) to pi [rad]", setup.max_tilt);
  want(std::isfinite(setup.min_height), "min_height", "a finite height [m]", setup.min_height);
  want(setup.min_height == 0.0 || setup.max_tilt > 0.0, "min_height",
       "a max_tilt above 0 beside it, or nobody looks", setup.min_height);
  want(setup.min_height == 0.0 || !setup.fall_frame.empty(), "min_height",
       "a fall_frame whose height it is", setup.min_height);
  require(setup.fall_frame.empty() || setup.max_tilt > 0.0,
          "[mission]: fall_frame wants a max_tilt above 0 beside it, or nobody looks");
  want(std::isfinite(setup.stand_off), "stand_off", "a finite distance [m]", setup.stand_off);
  want(std::isfinite(setup.container_stand), "container_stand", "a finite distance [m]",
       setup.container_stand);
  check_support(setup.support, plan, "[mission]");
}

bool contains(const std::vector<int>& all, int one) {
  return std::find(all.begin(), all.end(), one) != all.end();
}

}  // namespace

Mission::Mission(MissionSetup setup, MissionTable table, const WholeBodyController& controller,
                 double variation)
    : setup_(std::move(setup)),
      table_(std::move(table)),
      variation_(variation),
      limits_(controller.law(0).limits()),
      initial_qpos_(controller.plan().qpos()),
      root_body_(controller.plan().root_body()),
      dt_(controller.dt()),
      idle_(Vector::Zero(controller.scale().size())),
      operated_(idle_) {
  require(variation_ >= 0.0 && std::isfinite(variation_), "variation wants a number >= 0");
  check_setup(setup_, controller.plan());
  check_table(table_, controller);
  figures_ = Gauges::figures_of(table_);
  for (const Task* task : controller.tasks()) {
    if (dynamic_cast<const ForceTask*>(task)) force_names_.push_back(task->name());
  }
  Index row = 0;
  for (const Channel& channel : controller.channels()) {
    if (channel.sets())
      idle_.segment(row, channel.size()).setConstant(std::numeric_limits<double>::quiet_NaN());
    row += channel.size();
  }
  forces_ = Vector::Zero(static_cast<Index>(force_names_.size()));
  const std::vector<std::string> supports = supports_of(
      table_.phases, setup_.support.empty() ? controller.options().support : setup_.support);
  rows_.reserve(table_.phases.size());
  const bool stands = controller.plan().root_qpos() >= 0 && !controller.plan().floating();
  for (std::size_t i = 0; i < supports.size(); ++i) {
    const std::string& support = supports[i];
    rows_.emplace_back(table_.phases[i], support, controller);
    if (stands && !support.empty()) parts_.try_emplace(support, controller.plan(), support);
  }
}

std::unique_ptr<Supervisor> Mission::clone(WholeBodyController& controller) const {
  auto copy = std::make_unique<Mission>(setup_, table_, controller, variation_);
  copy->initial_qpos_ = initial_qpos_;
  copy->supports_checked_ = supports_checked_;
  return copy;
}

void Mission::attach(const Plant& plant, Recorder& log) {
  log.add("mission/elapsed_s", &elapsed_);
  log.add("mission/progress", &progress_);
  log.add("mission/waiting", &waiting_);
  log.add("mission/force", force_names_, forces_);
  scene_.attach(setup_, plant, log);
  find_brakes(plant.brakes());
  for (PhaseRow& row : rows_) row.find_places(plant, root_body_);
  quantities_.attach(plant, log);
  for (PhaseRow& row : rows_) row.find_quantities(quantities_);
  gauges_.attach(table_, quantities_);
  plant_ = &plant;
}

void Mission::find_brakes(const Brakes& brakes) {
  for (PhaseRow& row : rows_) {
    for (const int actuator : row.find_brakes(brakes)) {
      if (!contains(brakes_, actuator)) brakes_.push_back(actuator);
    }
  }
}

void Mission::brake(Brakes& brakes) {
  PhaseRow& row = rows_[phase_];
  const bool still = doing_ != Doing::Leading || paused_;
  if (!still) row.look_at_brakes(dt_);
  for (const int actuator : brakes_) brakes.set_closed(actuator, row.shuts(actuator, still));
}

bool Mission::needs_log() const {
  return !table_.measures.empty() || !setup_.casualty.empty() ||
         std::any_of(rows_.begin(), rows_.end(),
                     [](const PhaseRow& row) { return row.needs_log(); });
}

Vector Mission::start(const Plant& plant, Robot& robot, std::uint64_t seed) {
  Vector qpos = setup_.keyframe.empty() ? initial_qpos_
                                        : plant.keyframe_qpos(plant.find_keyframe(setup_.keyframe));
  Random random(seed);
  Variation variation;
  variation.scale = variation_;
  const int casualty = plant.other_free_joint(robot.root_body());
  if (casualty >= 0) vary_place(variation, random, qpos.segment<7>(casualty));
  scene_.draw_errors(random, variation_);
  // the posture varies, the support stays: the root of the robot follows
  robot.set_qpos(qpos);
  Vector q = robot.configuration();
  if (limits_) vary_posture(variation, random, {limits_->lower(), limits_->upper()}, q);
  robot.set_configuration(q);
  return robot.qpos();
}

void Mission::reset(WholeBodyController& controller, const Robot& world) {
  require(plant_ || !needs_log(), "a mission with conditions wants a simulation");
  if (plant_ && !supports_checked_)
    check_supports(table_, controller, {world, *plant_, setup_.support});
  supports_checked_ = true;
  for (Figure& figure : figures_) figure.value = std::numeric_limits<double>::quiet_NaN();
  for (PhaseRow& row : rows_) row.reset();
  gauges_.reset();
  why_ = {};
  wait_until_ = 0.0;
  forces_.setZero();
  verdict_.clear();
  answer_.reset();
  paused_ = moved_ = ended_ = false;
  scene_.reset();
  quantities_.look();
  begin(controller, world);
  enter(0, controller, 0.0);
}

void Mission::enter(std::size_t phase, WholeBodyController& controller, double time) {
  const PhaseRow& before = rows_[phase_];
  phase_ = phase;
  phase_start_ = now_ = time;
  doing_ = Doing::Leading;
  cause_ = 0;
  elapsed_ = progress_ = extra_ = unborne_for_ = 0.0;
  unborne_ = false;
  waiting_ = paused_ ? 1.0 : 0.0;
  const std::string& stack = table_.phases[phase_].stack;
  if (stack == kJoints) {
    controller.move_joints();
  } else if (!rules(controller)) {
    controller.use(stack);
    controller.hold_targets();  // where the plan is: nothing jumps
  }
  PhaseRow& row = rows_[phase_];
  if (!row.support().empty() && controller.plan().support_name() != row.support()) {
    controller.stand_on(row.support());
  }
  row.enter(controller);
  row.go_on_bearing(before);
  entered(time);
}

const Vector& Mission::command(double dt) {
  operated_ = idle_;
  if (doing_ != Doing::Leading || paused_) return operated_;
  rows_[phase_].command(now_ - phase_start_, dt, operated_);
  return operated_;
}

void Mission::note_commanded(const WholeBodyController& controller, const TickReport& report) {
  rows_[phase_].note(controller, operated_);
  const auto commanded_now = [&] {  // NaN: nothing is set
    const Vector& command = controller.command();
    for (Index i = 0; i < command.size(); ++i)
      if (std::isnan(idle_[i]) ? !std::isnan(command[i]) : command[i] != 0.0) return true;
    return false;
  };
  moved_ = moved_ || (paused_ && commanded_now());
  Index force = 0;
  for (const Task* task : controller.tasks()) {
    if (const auto* const one = dynamic_cast<const ForceTask*>(task))
      forces_[force++] = one->force();
  }
  commanded(controller, report);
}

void Mission::note_measured(const TickReport& report) {
  scene_.look();
  quantities_.look();
  look_at_support();
  gauges_.look(phase_, figures_);
  for (std::size_t i = 0; i < rows_.size(); ++i) rows_[i].look(i == phase_);
  measured(report);
}

void Mission::look_at_support() {
  constexpr double kPatience = 1.0;  // [s] on bumps tracks hang in the air for a moment
  const auto part = parts_.find(rows_[phase_].support());
  const bool told = unborne_for_ >= kPatience;
  const bool bears = part == parts_.end() || part->second.bears(plant_->model(), plant_->data());
  if (!told) unborne_for_ = bears ? 0.0 : unborne_for_ + dt_;
  unborne_ = !told && unborne_for_ >= kPatience;
}

bool Mission::advance(WholeBodyController& controller, double time) {
  now_ = time;
  reacted_.reset();
  if (paused_ || doing_ != Doing::Leading) return wait(time, controller);
  elapsed_ = time - phase_start_;
  progress_ = rows_[phase_].progress(elapsed_);
  const std::optional<std::size_t> trouble = rows_[phase_].trouble(dt_);
  const bool late = elapsed_ > table_.phases[phase_].within + extra_ + rows_[phase_].longer();
  if (trouble || late || rows_[phase_].failed()) {
    return react(trouble, controller, time);
  }
  while (over(time)) {
    const std::optional<std::size_t> after = phase_after(table_.phases, phase_);
    if (!after) {
      ended_ = true;
      tell();
      return false;
    }
    enter(*after, controller, time);
  }
  return true;
}

bool Mission::over(double time) {
  const bool done = rows_[phase_].done(dt_);
  return done && rows_[phase_].progress(time - phase_start_) >= 1.0;
}

// the first reaction that is left; none: abort
bool Mission::react(std::optional<std::size_t> trouble, WholeBodyController& controller,
                    double time) {
  const std::size_t cause = trouble ? *trouble + 1 : 0;
  const std::optional<std::size_t> number = rows_[phase_].react(trouble);
  reacted_ = {phase_, cause, number ? *number + 1 : 0};
  const Reaction* const reaction = number ? &rows_[phase_].reactions(trouble)[*number] : nullptr;
  switch (reaction ? reaction->kind : ReactionKind::Abort) {
    case ReactionKind::Back:
      if (!why_.final) why_ = why(cause);
      enter(find_phase(table_.phases, reaction->phase, ""), controller, time);
      return true;
    case ReactionKind::Hold:
    case ReactionKind::Ask:
      doing_ = reaction->kind == ReactionKind::Hold ? Doing::Holding : Doing::Asking;
      wait_until_ = time + reaction->seconds;
      cause_ = cause;
      answer_.reset();
      waiting_ = 1.0;
      return true;
    case ReactionKind::Lower:
      why_ = why(cause, true);
      tell();
      enter(find_phase(table_.phases, table_.safety, ""), controller, time);
      return true;
    case ReactionKind::Abort:
      break;
  }
  why_ = why(cause, true);
  ended_ = true;
  tell();
  return false;
}

// holds, asks or is paused: the clock of the phase stands
bool Mission::wait(double time, WholeBodyController& controller) {
  phase_start_ += dt_;
  if (paused_) {
    wait_until_ += dt_;
    return true;
  }
  const bool silent = time >= wait_until_;
  const bool asks = doing_ == Doing::Asking;
  if (!silent && !(asks && answer_)) return true;
  const bool go_on = asks ? answer_.value_or(false) : true;
  answer_.reset();
  waiting_ = 0.0;
  doing_ = Doing::Leading;
  const auto trouble = cause_ > 0 ? std::optional(cause_ - 1) : std::nullopt;
  if (!go_on) {
    rows_[phase_].refuse(trouble);
    return react(trouble, controller, time);
  }
  if (asks && trouble) rows_[phase_].excuse(*trouble);
  if (asks && !trouble) extra_ = elapsed_;  // as much time once more
  return true;
}

void Mission::pause() {
  if (!paused_) moved_ = false;
  paused_ = true;
  waiting_ = 1.0;
}

void Mission::resume(WholeBodyController& controller, double time) {
  paused_ = false;
  waiting_ = doing_ == Doing::Leading ? 0.0 : 1.0;
  if (moved_ || !rules(controller)) enter(phase_, controller, time);
}

// the stack of the phase does
bool Mission::rules(const WholeBodyController& controller) const {
  const std::string& stack = table_.phases[phase_].stack;
  if (stack == kJoints) return controller.moves_joints();
  return !controller.moves_joints() && controller.stacks()[controller.active()].name == stack;
}

std::optional<double> Mission::asks_until() const {
  if (doing_ != Doing::Asking || paused_) return std::nullopt;
  return wait_until_;
}

std::string Mission::question() const {
  return asks_until() ? words(why(cause_)) + "; go on?" : "";
}

Mission::Why Mission::why(std::size_t cause, bool final) const {
  Why why{phase_ + 1, cause, 0, 0.0, final};
  const std::optional<std::size_t> unmet = rows_[phase_].unmet();
  if (cause > 0 || !unmet) return why;
  why.unmet = *unmet + 1;
  why.value = rows_[phase_].value_of(*unmet);
  return why;
}

std::string Mission::text(const Cause& cause) const {
  const Phase& row = table_.phases[cause.phase];
  std::string text = "phase '" + row.name + "': ";
  text += cause.trouble == 0 ? std::string("took too long")
                             : to_string(row.troubles[cause.trouble - 1].when);
  if (cause.reaction == 0) return text;
  const auto trouble = cause.trouble > 0 ? std::optional(cause.trouble - 1) : std::nullopt;
  Reaction once = rows_[cause.phase].reactions(trouble)[cause.reaction - 1];
  once.times = 1;
  return text + "; " + exact_text(once);
}

std::string Mission::unmet_words(const Why& why) const {
  const std::string* const blind = rows_[why.phase - 1].blind();
  if (why.cause == 0 && blind) return *blind + " is no number";
  if (why.unmet == 0) return "";
  const Condition& condition = table_.phases[why.phase - 1].done[why.unmet - 1];
  const bool now = condition.above ? why.value >= condition.value : why.value <= condition.value;
  if (now) return to_string(condition) + " has not been true for so long";
  return to_string(condition) + " is not true, it is " + to_text(why.value);
}

std::string Mission::words(const Why& why) const {
  const std::string unmet = unmet_words(why);
  return text({why.phase - 1, why.cause}) + (unmet.empty() ? "" : ": " + unmet);
}

std::string Mission::waits_for() const {
  const std::string unmet = unmet_words(why(0));
  return "phase '" + table_.phases[phase_].name + "'" + (unmet.empty() ? "" : ": " + unmet);
}

// what is missing, in words: why it was lowered or aborted, else the first figure out of its bounds,
// and what it went back for
void Mission::tell() {
  verdict_.clear();
  const std::string cause = why_.phase > 0 ? words(why_) : "";
  if (why_.final) verdict_ = cause;
  if (why_.final || !ended_) return;
  verdict_ = out_of_bounds(figures_);
  if (!verdict_.empty() && !cause.empty()) verdict_ += "; " + cause;
}

std::vector<std::string> Mission::phase_names() const {
  std::vector<std::string> names;
  for (const Phase& phase : table_.phases) names.push_back(phase.name);
  return names;
}

void Mission::save(StateWriter& writer) const {
  for (const std::size_t number : {phase_, cause_, why_.phase, why_.cause, why_.unmet}) {
    writer.put(static_cast<double>(number));
  }
  for (const bool flag : {paused_, moved_, ended_, why_.final}) writer.put(flag ? 1.0 : 0.0);
  writer.put(why_.value);
  writer.put(static_cast<double>(static_cast<int>(doing_)));
  writer.put(answer_ ? (*answer_ ? 2.0 : 1.0) : 0.0);
  for (const double value :
       {phase_start_, now_, wait_until_, extra_, elapsed_, progress_, waiting_, unborne_for_}) {
    writer.put(value);
  }
  writer.put(forces_);
  for (const Figure& figure : figures_) writer.put(figure.value);
  gauges_.save(writer);
  for (const PhaseRow& row : rows_) row.save(writer);
  scene_.save(writer);
  quantities_.save(writer);
  save_memory(writer);
}

void Mission::restore(StateReader& reader) {
  const auto phases = static_cast<Index>(rows_.size());
  phase_ = static_cast<std::size_t>(reader.get_count(phases - 1));
  const auto causes = static_cast<Index>(table_.phases[phase_].troubles.size());
  cause_ = static_cast<std::size_t>(reader.get_count(causes));
  why_.phase = static_cast<std::size_t>(reader.get_count(phases));
  const std::size_t most = why_.phase > 0 ? table_.phases[why_.phase - 1].troubles.size() : 0;
  why_.cause = static_cast<std::size_t>(reader.get_count(static_cast<Index>(most)));
  const std::size_t asked = why_.phase > 0 ? table_.phases[why_.phase - 1].done.size() : 0;
  why_.unmet = static_cast<std::size_t>(reader.get_count(static_cast<Index>(asked)));
  paused_ = reader.get_count(1) > 0;
  moved_ = reader.get_count(1) > 0;
  ended_ = reader.get_count(1) > 0;
  why_.final = reader.get_count(1) > 0;
  why_.value = reader.get_any();
  doing_ = static_cast<Doing>(reader.get_count(static_cast<Index>(Doing::Asking)));
  const Index answered = reader.get_count(2);
  answer_ = answered > 0 ? std::optional(answered == 2) : std::nullopt;
  for (double* value : {&phase_start_, &now_, &wait_until_, &extra_, &elapsed_, &progress_,
                        &waiting_, &unborne_for_}) {
    *value = reader.get();
  }
  reader.get(forces_);
  for (Figure& figure : figures_) figure.value = reader.get_any();
  gauges_.restore(reader);
  for (PhaseRow& row : rows_) row.restore(reader);
  scene_.restore(reader);
  quantities_.restore(reader);
  tell();
  restore_memory(reader);
}

}  // namespace hurcules
