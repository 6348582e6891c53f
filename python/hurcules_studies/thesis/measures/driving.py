"""H06 to H09: the rescue robot drives: 20 km/h, a slope of 30 degrees, gears, turns in place."""

from __future__ import annotations

import math
from functools import cache

import numpy as np

from hurcules import scenes
from hurcules._core import DriveState
from hurcules_studies.thesis.claim import Finding, Note, Plot, line
from hurcules_studies.thesis.measures.problems import Array
from hurcules_studies.thesis.measures.registry import measures
from hurcules_studies.thesis.measures.rover import BELTS, DRIVING_SPEED, Rover, flat, laden

SECONDS = 8.0  # of the run up to 20 km/h
POWER = 7950.0  # [W] of each drive, 1430 N at 20 km/h (models/README.md)
YAW_RATE = 0.6  # [rad/s]
SLOPE = math.radians(30.0)
CLIMB, HOLD = 0.5, 5.0  # [m/s] along the slope, [s]


@cache
def sprint() -> dict[str, Array]:
    """From rest to 20 km/h on level ground: time, speed, ratio, share of the torque, power."""
    rover = Rover(flat())
    rover.controller.drive(DRIVING_SPEED)
    rows: list[tuple[float, ...]] = []

    def look(motion: DriveState) -> None:
        # both belts give the same; the motors of the arms rest behind their brakes
        speeds = [float(rover.data.joint(belt).qvel[0]) for belt in BELTS]
        drives = [rover.model.actuator(f"{side}_drive").id for side in "LR"]
        torques = rover.data.actuator_force[drives]
        rows.append(
            (
                rover.data.time,
                motion.speed,
                rover.physics.ratio(BELTS[0]),
                rover.motor_share,
                float(np.max(torques * speeds)),
                rover.powered.meter.total,
            )
        )

    rover.run(SECONDS, look)
    names = ("time", "speed", "ratio", "share", "power", "battery")
    return dict(zip(names, np.array(rows).T, strict=True))


@measures("H06")
def twenty_km_per_hour() -> Finding:
    """Rolling resistance 6 % of the weight; torque against what motor and gear give."""
    log = sprint()
    late = log["time"] > SECONDS - 1.0
    reached = float(log["time"][np.argmax(log["speed"] > 0.99 * DRIVING_SPEED)])
    return Finding(
        {
            "speed": 3.6 * float(log["speed"][late].mean()),
            "torque": float(log["share"].max()),
            "power": float(log["power"].max()) / POWER,
        },
        [
            Note("the same at speed", float(log["share"][late].max())),
            Note("99 % of it after", reached, "s"),
            Note("most from the battery", float(log["battery"].max()), "W"),
            Note("from the battery at speed", float(log["battery"][late].mean()), "W"),
        ],
        [
            Plot("Speed", "time [s]", "[km/h]", [line("", log["time"], 3.6 * log["speed"])],
                 levels=(20.0,)),
            Plot("A drive", "time [s]", "of what it can",
                 [line("torque", log["time"], log["share"]),
                  line("power", log["time"], log["power"] / POWER)], levels=(1.0,)),
        ],
    )  # fmt: skip


@measures("H08")
def gears() -> Finding:
    """The transmission in the same run."""
    log = sprint()
    return Finding(
        {
            "launch": float(log["ratio"][0]),
            "speed": float(log["ratio"][-1]),
            "back": float(np.diff(log["ratio"]).max()),
        },
        plots=[
            Plot("Ratio", "speed [km/h]", "motor : belt",
                 [line("", 3.6 * log["speed"], log["ratio"])], levels=(1.0, 3.0)),
        ],
    )  # fmt: skip


def climb(payload: float) -> tuple[Array, dict[str, float]]:
    """Up a slope, a stop, and down in reverse: time and way up the slope [m]; what it took."""
    spec = scenes.make("slope", robot="rescue", direction="up", angle=SLOPE)
    rover = Rover(laden(spec, payload), raised=payload > 0.0)
    rows: list[tuple[float, float, float]] = []

    def look(motion: DriveState) -> None:
        rows.append((rover.data.time, rover.data.qpos[0] / math.cos(SLOPE), rover.motor_share))

    rover.run(0.5, look)
    rover.controller.drive(CLIMB)
    rover.run(5.0, look)
    top = len(rows)
    rover.controller.drive(0.0)
    rover.run(1.5, look)
    held = len(rows)
    rover.run(HOLD, look)
    free = len(rows)
    rover.controller.drive(-CLIMB)
    rover.run(4.0, look)
    log = np.array(rows)
    late = log[:top][log[:top, 0] > log[top - 1, 0] - 2.0]
    speed = float(np.polyfit(late[:, 0], late[:, 1], 1)[0])
    return log, {
        "climbed": float(log[top - 1, 1]),
        "speed": speed / CLIMB,
        "creep": float(abs(log[free - 1, 1] - log[held, 1])) / HOLD,
        "down": float(log[free - 1, 1] - log[-1, 1]),
        "torque": float(log[:, 2].max()),
    }


@measures("H07")
def slope() -> Finding:
    """Friction 0.9; the load lies on the raised transfer bed."""
    runs = {"without load": climb(0.0), "with 120 kg": climb(120.0)}
    (_, bare), (_, full) = runs.values()
    lines = [line(name, log[:, 0], log[:, 1]) for name, (log, _) in runs.items()]
    return Finding(
        {
            "climbed": min(bare["climbed"], full["climbed"]),
            "speed": min(bare["speed"], full["speed"]),
            "creep": max(bare["creep"], full["creep"]),
            "down": min(bare["down"], full["down"]),
            "torque": max(bare["torque"], full["torque"]),
        },
        [
            Note("speed over the command, without load", bare["speed"]),
            Note("the same with 120 kg", full["speed"]),
            Note("largest share of a drive's torque without load", bare["torque"]),
            Note("the same with 120 kg", full["torque"]),
        ],
        [Plot("Up, held, and down again", "time [s]", "way up the slope [m]", lines)],
    )


@measures("H09")
def turn_in_place() -> Finding:
    """Once round at 0.6 rad/s, counted from when it turns steadily."""
    rover = Rover(flat())
    rover.controller.drive(0.0, YAW_RATE)
    rover.run(1.0)
    start, turned = rover.centre, 0.0
    way: list[tuple[float, float, float]] = []
    last = rover.period().pose[2]
    while turned < 2.0 * math.pi and rover.data.time < 40.0:
        now = rover.period().pose[2]
        turned, last = turned + math.remainder(now - last, 2.0 * math.pi), now
        x, y, _ = rover.centre - start
        way.append((math.degrees(turned), float(x), float(y)))
    log = np.array(way)
    drift = np.hypot(log[:, 1], log[:, 2])
    return Finding(
        {"turned": float(log[-1, 0]), "drift": float(drift.max())},
        [Note("drift after the whole turn", float(drift[-1]), "m")],
        [Plot("Centre of mass", "turned [degrees]", "drift [m]", [line("", log[:, 0], drift)])],
    )
