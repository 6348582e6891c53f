"""M01 to M03 and M20: tasks one by one, still hands, one object in both hands, no drift."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

import hurcules
from hurcules_studies.thesis.claim import Finding, Plot, line
from hurcules_studies.thesis.measures.problems import Array
from hurcules_studies.thesis.measures.registry import measures
from hurcules_studies.thesis.measures.whole_body import DT, Body

Command = Callable[[float], Mapping[str, Array]]

START = {"KN": 2.017, "HIP": -0.91, "NKP": 0.21} | {
    side + joint: angle
    for side in "LR"
    for joint, angle in (("SP", 0.3), ("SR", 0.15), ("SY", 0.05), ("EB", 1.7), ("WP", 0.3))
}
# velocities of the references in figure 4.11's tasks, [m/s] and [rad/s]; in decreasing priority
MOVES: dict[str, list[float]] = {
    "lhpos": [0.03, 0.02, 0.03],
    "rhpos": [0.03, -0.02, 0.03],
    "lhor": [0.1, 0.1, 0.1],
    "rhor": [-0.1, 0.1, -0.1],
    "pelx": [0.03],
    "pelpitch": [0.05],
    "body": [0.05],
    "lswivel": [0.1],
    "rswivel": [0.1],
    "gaze": [0.1, 0.05],
}
LEVEL = {"pelpitch": "pelx", "body": "pelx", "rswivel": "lswivel"}  # tasks that share a level


def tick(body: Body, velocities: Mapping[str, Array]) -> None:
    """One control period."""
    for name, velocity in velocities.items():
        body.tasks[name].advance(velocity, DT)
    body.controller.compute(body.robot)
    body.robot.set_configuration(body.controller.integrate(body.robot.configuration))


def error(task: hurcules.Task) -> float:
    """Norm of a task's error."""
    return float(np.linalg.norm(task.error))


@measures("M01")
def each_alone() -> Finding:
    """Each task's reference moves for a second and rests for half of one."""
    own, above, shown = {}, 0.0, {}
    names = list(MOVES)
    for name, velocity in MOVES.items():
        body = Body(START)
        higher = names[: names.index(LEVEL.get(name, name))]
        errors = []
        for i in range(1500):
            tick(body, {name: np.array(velocity if i < 1000 else np.zeros(len(velocity)))})
            errors.append(error(body.tasks[name]))
            above = max([above, *(error(body.tasks[one]) for one in higher)])
        own[name], shown[name] = max(errors), np.array(errors)
    rows = sum(Body(START).tasks[name].rows for name in names)
    lines = [line(name, DT * np.arange(1500), 1e3 * values) for name, values in shown.items()]
    plot = Plot("Error of the task that moves", "time [s]", "[mm, mrad]", lines)
    return Finding({"rows": rows, "own": max(own.values()), "others": above}, plots=[plot])


@measures("M02")
def still_hands() -> Finding:
    """5 s forward and back, 9 s backward, which lowers the pelvis, and back; then the swivels."""
    body = Body(START)
    robot, hands = body.robot, ("lhpos", "rhpos", "lhor", "rhor")
    heights, ways, swivels, off = [], [], [], dict.fromkeys(hands, 0.0)
    angle = 0.0

    def go(seconds: float, velocities: Mapping[str, Array]) -> None:
        for _ in range(round(seconds / DT)):
            tick(body, velocities)
            place = robot.position("pelvis")
            ways.append(place[0])
            heights.append(place[2])
            swivels.append([float(body.tasks[name].value[0]) for name in ("lswivel", "rswivel")])
            for name in hands:
                off[name] = max(off[name], error(body.tasks[name]))

    go(0.5, {})
    go(5.0, {"pelx": np.array([0.03])})
    forward = ways[-1] - ways[499]
    go(5.0, {"pelx": np.array([-0.03])})
    before = heights[-1]
    go(9.0, {"pelx": np.array([-0.03])})
    down = before - heights[-1]
    go(9.0, {"pelx": np.array([0.03])})
    start = swivels[-1]
    go(3.0, {name: np.array([0.1]) for name in ("lswivel", "rswivel")})
    go(1.0, {})
    angle = float(np.mean(np.array(swivels[-1]) - start))
    time = DT * np.arange(len(ways))
    return Finding(
        {
            "forward": forward,
            "down": down,
            "swivel": angle,
            "hands": max(off["lhpos"], off["rhpos"]),
            "turned": max(off["lhor"], off["rhor"]),
        },
        plots=[
            Plot(
                "Pelvis",
                "time [s]",
                "[m]",
                [line("forward", time, np.array(ways) - ways[0]), line("height", time, heights)],
            ),
            Plot(
                "Swivel angles",
                "time [s]",
                "[rad]",
                [
                    line(name, time, np.array(swivels)[:, i])
                    for i, name in enumerate(("left", "right"))
                ],
            ),
        ],
    )


@measures("M03")
def one_object() -> Finding:
    """An object between the hands; each hand's reference moves with it as a rigid body."""
    body = Body(START)
    left, right = body.tasks["lhpos"], body.tasks["rhpos"]
    lor, ror = body.tasks["lhor"], body.tasks["rhor"]
    centre = 0.5 * (left.value + right.value)
    distance = float(np.linalg.norm(left.value - right.value))
    relative = lor.orientation.T @ ror.orientation
    centres, turns, apart, turned = [], [], [], []
    first = left.value - right.value

    def go(seconds: float, velocity: Array, turn: Array) -> None:
        nonlocal centre
        for _ in range(round(seconds / DT)):
            commands = {"lhor": turn, "rhor": turn}
            for name, task in (("lhpos", left), ("rhpos", right)):
                commands[name] = velocity + np.cross(turn, task.target - centre)
            centre = centre + DT * velocity
            tick(body, commands)
            between = left.value - right.value
            centres.append(0.5 * (left.value + right.value))
            turns.append(np.arctan2(between[2], between[1]) - np.arctan2(first[2], first[1]))
            apart.append(abs(float(np.linalg.norm(between)) - distance))
            now = lor.orientation.T @ ror.orientation
            angle = 0.5 * np.linalg.norm(_vee(relative.T @ now))
            turned.append(float(angle))

    zero = np.zeros(3)
    go(2.0, np.array([0.0, 0.05, 0.0]), zero)
    sideways = float(centres[-1][1] - centres[0][1])
    go(3.0, zero, np.array([0.1, 0.0, 0.0]))
    roll = float(turns[-1])
    go(2.0, zero, np.array([-0.1, 0.0, 0.1]))
    go(0.5, zero, zero)
    time = DT * np.arange(len(apart))
    return Finding(
        {
            "sideways": sideways,
            "roll": roll,
            "apart": max(apart),
            "turned": max(turned),
        },
        plots=[
            Plot("Object", "time [s]", "roll [rad]", [line("", time, turns)]),
            Plot(
                "From hand to hand",
                "time [s]",
                "[mm, mrad]",
                [
                    line("distance", time, 1e3 * np.array(apart)),
                    line("orientation", time, 1e3 * np.array(turned)),
                ],
            ),
        ],
    )


def _vee(R: Array) -> Array:
    return np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]])


@measures("M20")
def no_drift() -> Finding:
    """The left hand draws a circle of 0.1 m radius three times; then without the gain K."""
    body = Body(START)
    left = body.tasks["lhpos"]
    start, summed, errors = left.target.copy(), np.zeros(3), []

    def velocity(i: int) -> Array:
        phase = 2 * np.pi * i / 3000
        return np.array([0.0, -np.sin(phase), np.cos(phase)]) * 0.1 * 2 * np.pi / 3.0

    for i in range(9000):
        summed = summed + DT * velocity(i)
        tick(body, {"lhpos": velocity(i)})
        errors.append(error(left))
    off = float(np.abs(left.target - start - summed).max())
    options = body.setting.options
    options.gain = 0.0
    free = Body(START)
    open_loop = hurcules.VelocityController(free.robot, options)
    open_loop.set_stack(free.stack())
    free.controller = open_loop
    drift = []
    for i in range(9000):
        tick(free, {"lhpos": velocity(i)})
        drift.append(error(free.tasks["lhpos"]))
    time = DT * np.arange(9000)
    return Finding(
        {
            "reference": off,
            "closed": max(errors[-100:]),
            "growth": max(errors[6000:]) / max(errors[:3000]),
            "open": drift[-1] / max(errors[-100:]),
        },
        plots=[
            Plot(
                "Error of the left hand",
                "time [s]",
                "[mm]",
                [
                    line("closed loop, K = 5", time, 1e3 * np.array(errors)),
                    line("open loop", time, 1e3 * np.array(drift)),
                ],
            )
        ],
    )
