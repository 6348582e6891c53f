// Docstrings of bind_force.cpp.
#pragma once

inline constexpr const char* kForceGains =
    R"(Law and gains of a force loop; f = G (s - r) is what the robot exerts along the axis.

FirstOrder        ds/dt = C (f_d - f)                                    [T 5.7.62]
Velocity          M s'' = -L s' + K delta, delta = C (f_d - f)           [T 5.4.35]
Position          M s'' = -L s' + K (delta - s)                          [T 5.4.28-29]
PositionIntegral  the same, delta with N times the integral of f_d - f   [T 5.4.34]

Position ends at f = (C G f_d - G r) / (1 + C G), the others at f_d. FirstOrder is for both
controllers, the others for AccelerationController.

Args:
  loop: ForceLoop.
  compliance: C > 0, [m/s/N] of FirstOrder, [m/N] of the others.
  integral: N > 0 [m/s/N], of PositionIntegral alone.
  mass: M > 0 [kg], as damping L [kg/s] and stiffness K [kg/s^2] not of FirstOrder.
  damping: see mass.
  stiffness: see mass.
  dt: [s] control period.
)";
inline constexpr const char* kLargestStiffness =
    R"(Largest stiffness G [N/m] of an environment that the gains keep stable in steps of dt.

The reading is one step old and the robot follows exactly; a real servo asks for less: C G well
below its bandwidth. C G dt < 1 for FirstOrder.

Args:
  gains: ForceGains.

Raises:
  Error: gains that cannot be.
)";
inline constexpr const char* kContactOptions =
    R"(When there is contact, too much of it, or no sensor.

Args:
  f_min: [N] > 0 at which contact begins; it ends below half of it for release_time.
  f_max: [N] > f_min beyond which the row stops until reset.
  release_time: [s].
  patience: [s] for which the last reading stands for missing ones (NaN); then the sensor is lost.
  frozen_move: [m] along the axis with the same reading in contact: the sensor is lost; 0: not
    looked for.
)";
inline constexpr const char* kStiffnessOptions =
    R"(How the stiffness of an environment is learnt: least squares on increments, with forgetting.

Args:
  lower: [N/m] bounds of the estimate.
  upper: [N/m], and what it starts from.
  forgetting: of an increment, 0 to 1.
  step: [m] shortest increment.
)";
inline constexpr const char* kForceTask =
    R"(The contact force along one axis as a row: in the air a position, in contact a force law.

Pressing down with 5 N along z is -5 N. Each tick: sense(robot, f), then the controller. From motion
to force and back the row goes over within `blend`; with 0 it jumps [T Fig. 5.17].

Args:
  name: shown in plots and messages.
  robot: Robot.
  frame: name of a site, body, camera or geom.
  reference: frame that the axis belongs to, '' for the world; `frame` itself: the axis turns with it,
    over a curved surface.
  axis: (3,), made a unit vector.
  force_des: f_d [N].
  blend: [s].
  environment: G [N/m] where it is known; 0: learnt in contact.
  max_rate: [1/s] where G is learnt, the compliance is held so low that an error vanishes no faster.
  gains: ForceGains.
  contact: ContactOptions.
  stiffness: StiffnessOptions of the estimate.

Raises:
  Error: a name that does not exist, gains that are unstable with this environment.
)";
inline constexpr const char* kSense = R"(One tick: the reading.

Args:
  robot: Robot where the controller will see it.
  force: f [N], NaN for none.
)";
inline constexpr const char* kTare =
    R"(The mean of what is read next is zero from then on: the weight of a tool behind the sensor, say.

Until then readings count as none and nothing leads the task: a contact ends, at rest. A reset of the
simulation forgets it, but for one that is asked for before the simulation is made: that is taken
anew at each start.

Args:
  seconds: for how long it is read; 0 takes one reading.

Raises:
  Error: a time below 0 or not finite.
)";
inline constexpr const char* kSetFilter =
    R"(A low-pass of what the force law is told; contact is judged by the reading itself.

Args:
  seconds: its time constant, 0 for none. `WholeBodyController.sense` sets 3 ms for a sensor.

Raises:
  Error: below 0 or not finite.
)";
inline constexpr const char* kEnable =
    "False: motion alone, whatever is read; readings are still watched.";
inline constexpr const char* kReset = "Out of Stopped and SensorLost, at rest where the frame is.";
