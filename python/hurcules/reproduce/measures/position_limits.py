"""R25, R26: position limits as bounds on velocity and on acceleration.

Joints driven against their limits as hard as seeded tasks can, by the default method, with the
bounds as printed; then by the velocity controller, whose bounds also brake in time.
"""

from __future__ import annotations

import mujoco
import numpy as np

import hurcules
from hurcules import rhqp
from hurcules.reproduce.claim import Finding, Plot, line
from hurcules.reproduce.measures.marks import measures
from hurcules.reproduce.measures.problems import Array, point, unit_rows

N, DT, STEPS = 5, 1e-3, 2000
RANGE = 0.3  # [rad]

TWO_JOINTS = """
<mujoco>
  <default><joint type="hinge" axis="0 1 0" range="-0.3 0.3"/></default>
  <compiler angle="radian"/>
  <worldbody>
    <body><joint name="first"/><geom size="0.05" pos="0.5 0 0"/>
      <body pos="0.5 0 0"><joint name="second"/><geom size="0.05" pos="0.5 0 0"/></body></body>
  </worldbody>
</mujoco>
"""


def tasks(seed: int, size: float) -> list[rhqp.Level]:
    """Two levels of two unit rows."""
    rng = np.random.default_rng(seed)
    goals = [size * rng.uniform(-1, 1, 2) for _ in range(2)]
    return [point(unit_rows(2, N, rng), y, 0.1) for y in goals]


@measures("R25")
def velocity_bounds() -> Finding:
    """J q' <= T / dt (s_u - s) with T <= 1, and the controller's bounds."""
    excess, shares = 0.0, []
    ways: dict[float, Array] = {}
    for horizon in (1.0, 0.5):
        for seed in range(5):
            levels, solver = tasks(seed, 5.0), rhqp.Solver(N)
            q, at_limit, way = np.zeros(N), 0, []
            for _ in range(STEPS):
                scale = horizon / DT
                bounds = rhqp.Bounds(scale * (-RANGE - q), scale * (RANGE - q))
                q = q + DT * solver.solve([bounds, *levels]).x
                way.append(q)
                excess = max(excess, float(np.abs(q).max()) - RANGE)
                at_limit += bool(np.abs(q).max() > RANGE - 1e-6)
            shares.append(at_limit / STEPS)
            ways.setdefault(horizon, np.array(way))
    led, controller_excess, change = driven_by_controller()
    time = DT * np.arange(400)
    lines = [line(f"as printed, T = {T:g}", time, ways[T][:400, 0]) for T in (1.0, 0.5)]
    plots = [
        Plot("As printed", "time [s]", "q1 [rad]", lines, levels=(RANGE, -RANGE)),
        Plot(
            "The controller, two joints",
            "time [s]",
            "q [rad]",
            [line(f"q{i + 1}", time, led[:400, i]) for i in range(2)],
            levels=(RANGE, -RANGE),
        ),
    ]
    return Finding(
        {
            "excess": excess,
            "tested": min(shares),
            "controller_excess": controller_excess,
            "controller_change": change,
        },
        plots=plots,
        remark="With T = 1 a joint runs at full speed until one step before its limit, and stands "
        "in the next: the jumps of Figures 4.15 to 4.18. Bounds that brake in time have none.",
    )


def driven_by_controller() -> tuple[Array, float, float]:
    """The way of two joints, the excess [rad], and the change of velocity over the allowed one."""
    robot = hurcules.Robot(mujoco.MjModel.from_xml_string(TWO_JOINTS))
    limits, posture = hurcules.JointLimits("limits", robot), hurcules.PostureTask("pose", robot)
    posture.set_target([5.0, -5.0])
    options = hurcules.VelocityControllerOptions(law="thesis")  # no bound of a task's speed
    controller = hurcules.VelocityController(robot, options)
    controller.set_stack(hurcules.Stack([limits, posture]))
    q, velocity, change, way = robot.configuration, np.zeros(2), 0.0, []
    for _ in range(STEPS):
        robot.set_configuration(q)
        before, velocity = velocity, controller.compute(robot).copy()
        q = controller.integrate(q)
        change = max(change, float(np.abs(velocity - before).max()))
        way.append(q)
    options = controller.options
    reached = np.array(way)
    if np.abs(reached[-1]).min() < RANGE - 1e-3:
        raise RuntimeError("the controller was not driven against the limits")
    excess = float(np.abs(reached).max()) - RANGE
    return reached, excess, change / (options.max_acceleration * options.dt)


@measures("R26")
def acceleration_bounds() -> Finding:
    """Keeps q + q' dt + q'' dt^2 / 2 within the limits; as printed it brakes within one step."""
    peak, excess, short, shown = 0.0, 0.0, 0.0, []
    for seed in range(5):
        levels, solver = tasks(seed, 5.0), rhqp.Solver(N)
        q, velocity = np.zeros(N), np.zeros(N)
        for _ in range(STEPS):
            coming = q + DT * velocity
            bounds = rhqp.Bounds(2 / DT**2 * (-RANGE - coming), 2 / DT**2 * (RANGE - coming))
            acceleration = solver.solve([bounds, *levels]).x
            q = coming + 0.5 * DT**2 * acceleration
            velocity = velocity + DT * acceleration
            peak = max(peak, float(np.abs(acceleration).max()))
            excess = max(excess, float(np.abs(q).max()) - RANGE)
            if seed == 0:
                shown.append(q)
        short = max(short, RANGE - float(np.abs(q).max()))
    time = DT * np.arange(STEPS)
    lines = [line(f"q{i + 1}", time, np.array(shown)[:, i]) for i in range(N)]
    plot = Plot("As printed", "time [s]", "q [rad]", lines, levels=(RANGE, -RANGE))
    return Finding(
        {"excess": excess, "tested": short, "peak": peak},
        plots=[plot],
        remark="As printed it asks for tens of thousands of rad/s², which no joint has: a form for "
        "finite acceleration has to brake earlier.",
    )
