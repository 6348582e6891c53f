#include "hurcules/mission/table.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "hurcules/base/error.hpp"
#include "hurcules/base/number_text.hpp"
#include "hurcules/control/tasks.hpp"
#include "hurcules/mission/posture_way.hpp"
#include "hurcules/sim/monitors.hpp"

namespace hurcules {

namespace {

std::vector<std::string> names_of(const std::vector<Phase>& phases) {
  std::vector<std::string> names;
  for (const Phase& phase : phases) names.push_back(phase.name);
  return names;
}

std::string where_of(const Phase& phase) {
  return "phase '" + phase.name + "'";
}

bool ends(const Lead& lead) {
  return lead.by.size() > 0 || std::isfinite(lead.way);
}

// what it gives to its channel, in one of three ways
const Vector& numbers_of(const Lead& lead) {
  return lead.rate.size() > 0 ? lead.rate : lead.by.size() > 0 ? lead.by : lead.value;
}

constexpr double kRounding = 1e-4;  // [rad] or [m] beyond a range: tables have four decimals

void check_lead(const Lead& lead, const Phase& phase, const std::string& where) {
  const bool led_by_rate = lead.rate.size() > 0;
  const bool has_way = lead.by.size() > 0, has_value = lead.value.size() > 0;
  require(led_by_rate + has_way + has_value == 1,
          where + " wants `rate`, `by` (a way) or `value`, one of them");
  require(numbers_of(lead).allFinite(), where + " wants finite numbers");
  require(lead.to.empty() ||
              (!led_by_rate && lead.to.size() == static_cast<std::size_t>(numbers_of(lead).size())),
          where + " wants a way or a value of as many numbers as it has quantities to go to, " +
              std::to_string(lead.to.size()) + " came");
  require(!lead.follow || (has_value && !lead.to.empty()),
          where + ": follow wants a value, and quantities `to` follow");
  require(lead.hold.empty() ? lead.span == 0.0
                            : led_by_rate && lead.span > 0.0 && std::isfinite(lead.at + lead.span),
          where + " wants a rate, a finite value and a span above 0 to hold a quantity by");
  require(!lead.brake || !lead.hold.empty(),
          where + ": brake wants a quantity to hold: `hold`, `at` and `span`");
  require(lead.way > 0.0,
          where + ": its way wants a number above 0, " + to_text(lead.way) + " came");
  require(!led_by_rate || !std::isfinite(lead.way) || lead.rate.norm() > 0.0,
          where + " never gives its way: its rate is 0");
  require(!has_way || phase.seconds > 0.0, where + ": a way that is led wants seconds above 0");
}

void check_leads(const Phase& phase, const std::string& where) {
  std::set<std::string> seen;
  if (!phase.posture.empty()) seen.insert(phase.posture);
  for (const Lead& lead : phase.leads) {
    const std::string channel = where + ": channel '" + lead.channel + "'";
    require(seen.insert(lead.channel).second, channel + " is led twice");
    check_lead(lead, phase, channel);
  }
}

void check_keys(const Phase& phase, const std::string& where) {
  require(phase.posture.empty() == phase.keys.empty(),
          where + ": a posture wants a channel and keys, both or none");
  if (phase.keys.empty()) return;
  require(phase.seconds > 0.0, where + ": a posture wants seconds above 0");
  double before = 0.0;
  for (const PostureKey& key : phase.keys) {
    require(key.share > before && key.share <= 1.0,
            where + ": the shares of a posture want to rise to 1, " + to_text(key.share) + " came");
    before = key.share;
    for (const auto& [name, angle] : key.angles) {
      require(std::isfinite(angle), where + ": the angle of '" + name + "' is no finite number");
    }
  }
  require(before == 1.0, where + ": the last share of a posture wants to be 1");
}

void check_pose(const Phase& phase, const std::string& where) {
  if (!phase.park) return;
  const Park& park = *phase.park;
  require(std::isfinite(park.ahead) && std::isfinite(park.left) && std::isfinite(park.heading),
          where + ": a pose to park at wants finite numbers");
  for (const double most : {park.speed, park.yaw_rate}) {
    require(most > 0.0 && std::isfinite(most),
            where + ": parking wants a speed and a yaw rate above 0, " + to_text(most) + " came");
  }
  require(std::isfinite(phase.within),
          where + ": parking may fail: it wants `within`, and what is done when it takes longer");
}

void check_reactions(const std::vector<Reaction>& row, const MissionTable& table,
                     const std::string& where) {
  require(!row.empty(), where + ": trouble wants at least one reaction");
  for (const Reaction& reaction : row) {
    require(reaction.times > 0, where + ": reaction '" + to_string(reaction.kind) +
                                    "' wants a count above 0, else it goes round for ever");
    if (reaction.kind == ReactionKind::Back) (void)find_phase(table.phases, reaction.phase, where);
    if (reaction.kind == ReactionKind::Hold || reaction.kind == ReactionKind::Ask) {
      require(reaction.seconds > 0.0,
              where + ": reaction '" + to_string(reaction.kind) + "' wants seconds above 0");
    }
    if (reaction.kind == ReactionKind::Lower) {
      require(!table.safety.empty(), where + ": lower wants the table to name the way to safety");
    }
  }
  const ReactionKind last = row.back().kind;
  require(last == ReactionKind::Lower || last == ReactionKind::Abort,
          where + ": the last reaction wants to be a way to safety, lower or abort; it is '" +
              to_string(last) + "'");
}

void check_condition(const Condition& condition, const std::string& where) {
  require(!condition.quantity.empty() && std::isfinite(condition.value) && condition.seconds >= 0.0,
          where + ": a condition wants a quantity, a finite value and seconds >= 0");
}

void check_times(const Phase& phase, const std::string& where) {
  require(phase.seconds >= 0.0 && std::isfinite(phase.seconds),
          where + ": seconds want a finite number >= 0, " + to_text(phase.seconds) + " came");
  require(phase.within > 0.0,
          where + ": within wants a time above 0, " + to_text(phase.within) + " s came");
  require(phase.within >= phase.seconds, where + " is always late: it takes " +
                                             to_text(phase.seconds) + " s, within wants as much, " +
                                             to_text(phase.within) + " s came");
  require(phase.late.empty() || std::isfinite(phase.within),
          where + ", late: it wants `within`, after which that is done");
  require(!phase.late.empty() || std::isinf(phase.within),
          where + ": within wants `late`, what is done when it takes longer");
  for (const Condition& condition : phase.done) {
    require(condition.seconds < phase.within, where + " is always late: '" + to_string(condition) +
                                                  "' cannot be true within " +
                                                  to_text(phase.within) + " s");
  }
}

void check_row(const Phase& phase, const MissionTable& table) {
  const std::string where = where_of(phase);
  for (const Condition& condition : phase.done) check_condition(condition, where);
  check_times(phase, where);
  check_leads(phase, where);
  check_keys(phase, where);
  check_pose(phase, where);
  const bool led = std::any_of(phase.leads.begin(), phase.leads.end(), ends);
  require(phase.seconds > 0.0 || led || phase.park || !phase.done.empty() || phase.leads.empty(),
          where + " never ends: it wants seconds, a way, or a condition");
  if (std::isfinite(phase.within)) check_reactions(phase.late, table, where + ", late");
  for (const Trouble& trouble : phase.troubles) {
    check_condition(trouble.when, where);
    check_reactions(trouble.reactions, table, where + ", " + to_string(trouble.when));
  }
}

// whoever goes on from row to row comes to an end: going round wants the count of a reaction
void check_order(const std::vector<Phase>& phases) {
  for (const Phase& phase : phases) {
    if (phase.next.empty()) continue;
    const std::string where = where_of(phase) + ", next";
    require(!phase.last, where + ": the run is over after it, it does not go on");
    (void)find_phase(phases, phase.next, where);
  }
  for (std::size_t i = 0; i < phases.size(); ++i) {
    std::optional<std::size_t> at = i;
    for (std::size_t steps = 0; at && steps < phases.size(); ++steps) at = phase_after(phases, *at);
    require(!at, where_of(phases[i]) + ", next: the rows behind it go round for ever; a way back " +
                     "wants a reaction with a count, 'back to PHASE, 3 times'");
  }
}

void check_lead(const Lead& lead, const Phase& phase, const WholeBodyController& controller,
                const std::string& phase_name) {
  const Channel& channel = *find_channel(controller, lead.channel, phase_name).channel;
  const std::string where = phase_name + ": channel '" + lead.channel + "'";
  const Index size = channel.size();
  require(!channel.task() || phase.stack != kJoints, where + " moves a task, but no stack rules");
  require(channel.kind() != ChannelKind::Joints || phase.stack == kJoints,
          where + " moves joints, which wants the stack '" + kJoints + "'");
  require(channel.kind() != ChannelKind::Delta,
          where + " counts from what is measured once a call: a mission wants a Twist or a Target");
  require(channel.sets() == (lead.value.size() > 0),
          where + (channel.sets() ? " sets something: it wants `value`"
                                  : " moves something: it wants `rate` or `by`"));
  if (const auto* const press = dynamic_cast<const ForceTask*>(channel.task());
      press && channel.kind() == ChannelKind::Force && lead.value.size() == 1) {
    const double most = press->options().contact.f_max;
    require(std::abs(lead.value[0]) < most, where + " wants a force below f_max, " + to_text(most) +
                                                " N, " + to_text(lead.value[0]) + " came");
  }
  require(!lead.brake || !channel.joint_names().empty(),
          where + " leads no joints whose brakes could bear what it holds");
  const Vector& given = numbers_of(lead);
  require(given.size() == size, where + " wants " + std::to_string(size) + " finite numbers, " +
                                    std::to_string(given.size()) + " came");
  for (Index i = 0; i < lead.rate.size(); ++i) {
    require(std::abs(given[i]) <= (1.0 + 1e-9) * channel.scale()[i],
            where + " gives at most " + to_text(channel.scale()[i]) + " a second, a rate of " +
                to_text(given[i]) + " came");
  }
  if (lead.by.size() == 0 || !lead.to.empty()) return;
  for (Index i = 0; i < size; ++i) {
    const double seconds = kSmoothPeak * std::abs(given[i]) / channel.scale()[i];
    require(phase.seconds >= (1.0 - 1e-9) * seconds,
            where + " gives at most " + to_text(channel.scale()[i]) + " a second: its way of " +
                to_text(given[i]) + " wants " + to_text(seconds) + " s, seconds are " +
                to_text(phase.seconds));
  }
}

void require_within(const std::string& what, double place, double lower, double upper,
                    double rounding, const std::string& where) {
  require(place >= lower - rounding && place <= upper + rounding,
          where + ": " + what + " goes from " + to_text(lower) + " to " + to_text(upper) + ", " +
              to_text(place) + " came (angles are in rad)");
}

// the keys of a posture are within the ranges of what they name
void check_posture(const Phase& phase, const WholeBodyController& controller,
                   const std::string& where) {
  if (phase.keys.empty()) return;
  const Channel& channel = *find_channel(controller, phase.posture, where).channel;
  const bool of_joints = phase.stack == kJoints;
  const Robot& plan = controller.plan();
  const auto& names = of_joints ? channel.joint_names() : plan.coordinate_names();
  if (of_joints) {
    require(channel.kind() == ChannelKind::Joints,
            where + ": channel '" + phase.posture + "' wants to be one of joints: no stack rules");
  } else {
    require(dynamic_cast<const PostureTask*>(channel.task()) &&
                channel.size() == static_cast<Index>(names.size()),
            where + ": channel '" + phase.posture +
                "' wants a PostureTask of all coordinates to lead a posture by");
  }
  const JointServo& servo = controller.servo();
  for (const PostureKey& key : phase.keys) {
    for (const auto& [name, angle] : key.angles) {
      const std::vector<Index> places = coordinates_of(name, names);
      if (places.empty()) throw Error(where + ": " + unknown_name("coordinate", name, names));
      for (const Index at : places) {
        const auto i = static_cast<std::size_t>(at);
        if (of_joints) {  // what no stack keeps within the range of its joint
          const JointActuator& joint = servo.actuator(servo.find(names[i]));
          require_within("joint '" + names[i] + "'", angle, joint.lower, joint.upper, 1e-6, where);
          continue;
        }
        const Coordinate& one = plan.coordinates()[i];
        if (one.joints.front().part >= 0) continue;  // the range of a ball joint is of its turn
        require_within("coordinate '" + names[i] + "'", angle, one.lower, one.upper, kRounding,
                       where);
      }
    }
  }
}

void check_park(const Phase& phase, const WholeBodyController& controller,
                const std::string& where) {
  if (!phase.park) return;
  (void)find_tracks(controller, where);
  for (const Lead& lead : phase.leads) {
    require(find_channel(controller, lead.channel, where).channel->kind() != ChannelKind::Drive,
            where + ": it parks, and channel '" + lead.channel + "' drives the tracks elsewhere");
  }
}

void check_phase(const Phase& phase, const WholeBodyController& controller) {
  const std::string where = where_of(phase);
  check_support(phase.support, controller.plan(), where);
  std::vector<std::string> stacks;
  for (const NamedStack& stack : controller.stacks()) stacks.push_back(stack.name);
  stacks.emplace_back(kJoints);
  if (std::find(stacks.begin(), stacks.end(), phase.stack) == stacks.end()) {
    throw Error(where + ": " + unknown_name("stack", phase.stack, stacks));
  }
  for (const Lead& lead : phase.leads) check_lead(lead, phase, controller, where);
  check_posture(phase, controller, where);
  check_park(phase, controller, where);
}

// appended piece by piece: GCC 12 takes "..." + std::string for an overlap
void add(std::string& text, const std::vector<std::string>& pieces) {
  for (const std::string& piece : pieces) text += piece;
}

std::string reactions_text(const std::vector<Reaction>& row) {
  std::string text;
  for (const Reaction& reaction : row) {
    if (!text.empty()) text += ", then ";
    text += to_string(reaction.kind);
    if (reaction.kind == ReactionKind::Back) add(text, {" to '", reaction.phase, "'"});
    if (reaction.seconds > 0.0) add(text, {" ", to_text(reaction.seconds), " s"});
    if (reaction.times > 1) add(text, {", ", std::to_string(reaction.times), " times"});
  }
  return text;
}

std::string numbers(const Vector& values) {
  std::string text;
  for (const double value : values) {
    if (!text.empty()) text += " ";
    text += to_text(value);
  }
  return text;
}

}  // namespace

std::string to_text(double number) {
  return number_text(number, 6);
}

std::string to_string(ReactionKind kind) {
  switch (kind) {
    case ReactionKind::Back:
      return "back";
    case ReactionKind::Hold:
      return "hold";
    case ReactionKind::Ask:
      return "ask";
    case ReactionKind::Lower:
      return "lower";
    case ReactionKind::Abort:
      return "abort";
  }
  return "";
}

std::string to_string(const Condition& condition, std::string (*number)(double)) {
  std::string text = condition.quantity;
  add(text, {condition.above ? " >= " : " <= ", number(condition.value)});
  if (condition.seconds > 0.0) add(text, {" for ", number(condition.seconds), " s"});
  return text;
}

std::size_t find_phase(const std::vector<Phase>& phases, const std::string& name,
                       const std::string& where) {
  for (std::size_t i = 0; i < phases.size(); ++i) {
    if (phases[i].name == name) return i;
  }
  throw Error(where + ": " + unknown_name("phase", name, names_of(phases)));
}

std::optional<std::size_t> phase_after(const std::vector<Phase>& phases, std::size_t phase) {
  const Phase& row = phases[phase];
  if (!row.next.empty()) return find_phase(phases, row.next, "");
  return row.last || phase + 1 == phases.size() ? std::nullopt : std::optional(phase + 1);
}

std::vector<std::string> supports_of(const std::vector<Phase>& phases, std::string first) {
  std::vector<std::string> supports;
  for (const Phase& phase : phases) {
    if (!phase.support.empty()) first = phase.support;
    supports.push_back(first);
  }
  return supports;
}

ChannelPlace find_channel(const WholeBodyController& controller, const std::string& name,
                          const std::string& where) {
  ChannelPlace place;
  std::vector<std::string> names;
  for (const Channel& channel : controller.channels()) {
    place.channel = &channel;
    if (channel.name() == name) return place;
    place.row += channel.size();
    names.push_back(channel.name());
  }
  throw Error(where + ": " + unknown_name("channel", name, names));
}

Index find_tracks(const WholeBodyController& controller, const std::string& where) {
  Index row = 0;
  for (const Channel& channel : controller.channels()) {
    if (channel.kind() == ChannelKind::Drive) return row;
    row += channel.size();
  }
  throw Error(where + ": parking wants a channel that drives the tracks; the controller has none");
}

void check_support(const std::string& support, const Robot& plan, const std::string& where) {
  if (support.empty()) return;
  try {
    require(plan.is_body(plan.frame(support)),
            "the robot stands on a body; '" + support + "' is none");
  } catch (const Error& error) {
    throw Error(where + ": " + error.what());
  }
}

void check_rows(const MissionTable& table) {
  require(!table.phases.empty(), "a mission wants at least one phase");
  for (std::size_t i = 0; i < table.phases.size(); ++i) {
    const std::string& name = table.phases[i].name;
    require(!name.empty(), "phase " + std::to_string(i + 1) + " wants a name");
    require(find_phase(table.phases, name, "") == i, "two phases are called '" + name + "'");
  }
  for (const Phase& phase : table.phases) check_row(phase, table);
  check_order(table.phases);
  if (!table.safety.empty()) (void)find_phase(table.phases, table.safety, "safety");
  std::vector<std::string> measures;
  for (const Measure& measure : table.measures) {
    const std::string where = "figure '" + measure.name + "'";
    require(!measure.name.empty(), "a figure wants a name");
    measures.push_back(measure.name);
    const auto& every = Monitors::names();
    require(std::find(every.begin(), every.end(), measure.name) == every.end(),
            where + ": every run has one of this name");
    require(measure.least <= measure.most, where + ": least wants to be below most");
    for (const std::string& phase : measure.phases) (void)find_phase(table.phases, phase, where);
  }
  require_distinct(measures, "figures");
}

void check_table(const MissionTable& table, const WholeBodyController& controller) {
  check_rows(table);
  for (const NamedStack& stack : controller.stacks()) {
    require(stack.name != kJoints, std::string("a mission wants no stack called '") + kJoints +
                                       "': phases in which none rules say so");
  }
  for (const Phase& phase : table.phases) check_phase(phase, controller);
}

std::string table_text(const MissionTable& table) {
  std::string text;
  for (std::size_t i = 0; i < table.phases.size(); ++i) {
    const Phase& phase = table.phases[i];
    add(text, {std::to_string(i + 1), "  ", phase.name, "  [", phase.stack, "]"});
    if (phase.seconds > 0.0) add(text, {"  ", to_text(phase.seconds), " s"});
    if (!phase.support.empty()) add(text, {"  on ", phase.support});
    if (!phase.next.empty()) add(text, {"  (then '", phase.next, "')"});
    if (phase.last) text += "  (the last)";
    text += "\n";
    if (!phase.note.empty()) add(text, {"     ", phase.note, "\n"});
    if (!phase.brakes.empty()) {
      text += "     brakes shut:";
      for (const std::string& name : phase.brakes) add(text, {" ", name});
      text += "\n";
    }
    for (const Lead& lead : phase.leads) {
      const char* const how = lead.rate.size() > 0 ? " at "
                              : lead.by.size() > 0 ? " by "
                                                   : " set to ";
      add(text, {"     ", lead.channel, how, numbers(numbers_of(lead))});
      for (const std::string& quantity : lead.to)
        add(text, {" + ", quantity.empty() ? "0" : quantity});
      if (lead.follow) text += ", followed";
      if (!lead.hold.empty()) add(text, {" to hold ", lead.hold, " at ", to_text(lead.at)});
      if (lead.brake) text += ", borne by the brake";
      if (std::isfinite(lead.way)) add(text, {" until ", to_text(lead.way)});
      text += "\n";
    }
    if (phase.park) {
      add(text, {"     parks at ", to_text(phase.park->ahead), " ", to_text(phase.park->left),
                 ", heading ", to_text(phase.park->heading), ", from ",
                 phase.park->body.empty() ? "its start" : phase.park->body, "\n"});
    }
    for (const PostureKey& key : phase.keys) {
      add(text, {"     at ", to_text(key.share), ":"});
      for (const auto& [name, angle] : key.angles) add(text, {" ", name, " ", to_text(angle)});
      text += "\n";
    }
    for (const Condition& condition : phase.done) {
      add(text, {"     done: ", to_string(condition), "\n"});
    }
    if (std::isfinite(phase.within)) {
      add(text, {"     within ", to_text(phase.within), " s: ", reactions_text(phase.late), "\n"});
    }
    for (const Trouble& trouble : phase.troubles) {
      add(text,
          {"     if ", to_string(trouble.when), ": ", reactions_text(trouble.reactions), "\n"});
    }
  }
  if (!table.safety.empty()) add(text, {"lower goes to '", table.safety, "'\n"});
  return text;
}

}  // namespace hurcules
