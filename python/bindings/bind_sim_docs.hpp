// The doc texts of bind_sim.cpp.
#pragma once

namespace hurcules_bindings {

inline constexpr const char* kStepPhysics =
    R"(mj_step with the traction of the tracks; plain mj_step leaves the belts without any.

MuJoCo's sensors are read in the last step alone.

Args:
  model: mujoco.MjModel; its tracks are the tuples `track_NAME`.
  data: mujoco.MjData of this model.
  n: number of steps. Releases the interpreter lock.

Raises:
  Error: tracks without the elliptic cones that they want.
)";
inline constexpr const char* kMissions = "Names of the missions.";
inline constexpr const char* kMissionScene = "Scene file of a mission, under models/.";
inline constexpr const char* kServoTable =
    R"(What the model says that servos of its joints shall reckon with: its numerics `servo_JOINT`.

A WholeBodyController takes them where it is given no others.

Args:
  robot: whose model has them, as Hurcules has.

Returns:
  By joint: the inertia that it turns [kg m^2], of a slide [kg], and its bandwidth [rad/s].

Raises:
  Error: a servo_JOINT that is no two numbers above 0.
)";
inline constexpr const char* kModeRanges =
    R"(Ranges of the coordinates in a mode of work: narrower than the hardware's.

Args:
  mode: "rescue_ready" (the transfer bed is on) or "rescue_ready_without_bed".

Returns:
  By coordinate: lowest and highest angle [rad].

Raises:
  Error: an unknown mode.
)";
inline constexpr const char* kOptions = R"(Options of a simulation.

Args:
  seed: of the differences between runs.
  variation: scale of these: casualty +-3 cm and +-0.05 rad, start posture +-2 mrad.
  method: of the solver, one of rhqp.method_names().
  record: keep the time series.
  timed: keep the time of each stage of each tick.
  base: where the planner thinks that the robot stands: BaseSource.Held or BaseSource.Sensed.
  sensors: SensorOptions; ideal by default.
  monitors: MonitorOptions.
  adds_command: a command is added to what the mission commands, in place of taking its place.
  loaded_springs: sprung hinges without a motor start where they bear what hangs on them.
)";
inline constexpr const char* kSimulation =
    R"(The closed loop in C++, on a model and data that Python owns.

Args:
  model: mujoco.MjModel of the mission's scene.
  data: mujoco.MjData of this model; the simulation resets and steps it.
  mission: name of the mission that commands it.
  controller: WholeBodyController instead of a mission.
  options: SimulationOptions.

Raises:
  Error: the model lacks something that the mission asks for.
)";
inline constexpr const char* kStep = R"(Control ticks of dt. Releases the interpreter lock.

Args:
  n: how many.
  command: (k,) SI, in the order of command_names, held to command_scale; None: the mission's
    operator, and without a mission every target holds.

Returns:
  The ticks done: fewer when the mission ends.

Raises:
  Error: a command of another size, or not finite.
)";
inline constexpr const char* kFollow = R"(Leads joints along a motion, one tick a row.

No stack rules meanwhile; `controller.use` hands the robot back to one.

Args:
  joints: names of joints with an actuator; the others stay.
  positions: (ticks, joints) [rad] or [m].
  velocities: (ticks, joints) [rad/s] or [m/s].

Returns:
  The ticks done: fewer when the run ends.

Raises:
  Error: an unknown joint, a position beyond its range, or arrays that do not fit.
)";
inline constexpr const char* kReset =
    "Back to the start, of a mission varied by this seed; start (nq,): where that is this time.";
inline constexpr const char* kGo = R"(Begins a phase of the mission now, out of its order.

Args:
  phase: its name.

Raises:
  Error: no such phase, or no mission.
)";
inline constexpr const char* kPause =
    R"(The mission stands still, its clocks and time-outs too: to take over by hand.

The robot holds, or does what `step` is given. Nobody looks for the mission's troubles meanwhile; falls,
sensors and `max_seconds` count on.

Raises:
  Error: no mission.
)";
inline constexpr const char* kResume = R"(The mission goes on after `pause`.

Where it was; where a command moved something meanwhile, its phase begins anew from where the robot is,
as by `go`.

Raises:
  Error: no mission.
)";
inline constexpr const char* kAnswer = R"(Answers what the mission asks: `question`.

Args:
  yes: the phase goes on, with as much time once more where it was late; False: the next reaction.

Raises:
  Error: nothing is asked.
)";
inline constexpr const char* kHeartbeat =
    R"(The operator's link is alive: the column `link_age` [s] counts from now on.

Before the first heartbeat of a run it is 0: who has no link cannot lose it. It is part of `state`.
)";
inline constexpr const char* kQuestion =
    "What the mission asks (reaction `ask 30 s`) and waits for in `answer`; '' for nothing.";
inline constexpr const char* kState =
    "All that decides how the run goes on, as one array; the log and the events are not in it.";
inline constexpr const char* kRestore =
    R"(Goes on from what state() gave, bit for bit, in any simulation of the same mission and model.

The log keeps what it recorded before that time. Masses, sizes and friction are the model's, not the
state's: where they differ, what follows does.

Raises:
  Error: the state belongs to a model of other parts, or another mission.
)";
inline constexpr const char* kReason =
    "'' while running, else why it ended: 'completed', 'fell over at ...'";
inline constexpr const char* kObservation = "What a policy sees now (m,), see observation_names.";
inline constexpr const char* kOperatorCommand =
    "What the mission's own operator commands next (k,).";
inline constexpr const char* kLevelErrors =
    "Norm of what each level is outside its intervals in the physics now, in the unit of its "
    "tasks; "
    "rows of weight 0, or without a side, are left out.";
inline constexpr const char* kCommandedErrors =
    "The same of the commanded motion, at the last tick.";
inline constexpr const char* kSolver =
    "How the last solve went: status (number of rhqp.Status), factorizations, changes, optimality.";
inline constexpr const char* kLog = "Every recorded channel over time: dict of name to (ticks,).";
inline constexpr const char* kTimings =
    "Seconds that each stage of each tick took: dict of (ticks,).";
inline constexpr const char* kFigures =
    "The mission's own figures and the worst that the monitors saw; NaN: has not happened.";
inline constexpr const char* kThesisFigures =
    "What the thesis reports for those figures that it gives.";
inline constexpr const char* kWantedFigures =
    "(least, most) that those figures must be for success whose mission says so.";
inline constexpr const char* kEvents = "(time [s], text) of phases, and of limits met and left.";
inline constexpr const char* kFall = R"(When a run ends because the robot fell.

Args:
  frame: whose height is watched; "": none is.
  min_height: of the frame above the controller's support, of a robot that floats above z = 0 [m].
  max_tilt: of the support (of a robot that floats: its root) against its start [rad].
)";
inline constexpr const char* kQuantities =
    R"(Named numbers of a simulation, found once and read together.

Names: position/FRAME, rotation/FRAME (rotation vector), velocity/FRAME, spin/FRAME (3 each, in the
world), matrix/FRAME (9); value/TASK, target/TASK; force/TASK (what a force task read);
distance/OBJECT/OBJECT; joint/JOINT, joint_velocity/JOINT; sensor/SENSOR; monitor/NAME; excess/KIND, commanded_excess/KIND
(position, velocity, torque: the worst so far), excess_now/KIND (of the last period); contact_force/BODY; self_contacts; scaled; finished
(1 where it is over); ending (the number of its Ending, 0 until then); and each channel of the observation and the log, alone ("q/KN") or as a group
("q").

Args:
  simulation: Simulation that they are of; they can be read from any copy of it.
  names: list of names.

Raises:
  Error: a name that does not exist, with those that do.
)";
inline constexpr const char* kViolation =
    "Worst excess over any limit of the model (not of a stack's JointLimits): position_rad, "
    "velocity, torque in the physics, 0 for none; commanded: the same of the commanded motion.";

}  // namespace hurcules_bindings
