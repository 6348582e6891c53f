"""H10, H11, H12: over hurdles, trenches and rough ground."""

from __future__ import annotations

from dataclasses import dataclass, replace

import mujoco
import numpy as np

from hurcules import scenes
from hurcules_studies.field_tests import Variation, method, repeat
from hurcules_studies.thesis.claim import Finding, Note, Plot, line
from hurcules_studies.thesis.measures.problems import Array
from hurcules_studies.thesis.measures.registry import measures
from hurcules_studies.thesis.measures.rover import DRIVING_SPEED, Rover, laden

# every repetition alike: the ground's own friction, no payload, the start on the line
SAME = Variation(friction=(1.0, 1.0), payload=0.0, offset=0.0, yaw=0.0)
HURDLES = (0.04, 0.07, 0.10)  # [m]: small obstacles, up to 0.7 of the belts' radius
TRENCHES = (0.1, 0.2, 0.3, 0.4, 0.5)  # [m]
CASUALTY = 75.0  # [kg] on the bed
ROAD = 40.0  # [m] of a rough road; the first 10 m to come up to speed


@measures("H10")
def obstacles() -> Finding:
    """There and back over each, as the test methods do; one repetition each, nothing varied."""
    hurdles = {h: repeat(method("e2802"), h, "rescue", 0, variation=SAME) for h in HURDLES}
    trench = replace(method("e2801"), scene="trench")
    trenches = {w: repeat(trench, w, "rescue", 0, variation=SAME) for w in TRENCHES}
    faults = [
        Note(f"{kind} {size:g} m: {one.fault} at", one.x, "m")
        for kind, runs in (("hurdle", hurdles), ("trench", trenches))
        for size, one in runs.items()
        if one.fault
    ]
    return Finding(
        {
            "hurdles": sum(not one.fault for one in hurdles.values()),
            "trenches": sum(not one.fault for one in trenches.values()),
        },
        faults,
        [
            Plot(
                "Seconds there and back", "height, width [m]", "[s]",
                [line("hurdles", list(hurdles), [one.seconds for one in hurdles.values()], "dots"),
                 line("trenches", list(trenches), [one.seconds for one in trenches.values()],
                      "dots")],
            ),
        ],
    )  # fmt: skip


def lock_springs(model: mujoco.MjModel) -> None:
    """A rigid mount: no spring of the suspension or of the bed gives way."""
    for joint in range(model.njnt):
        if "_spring" in model.joint(joint).name:
            model.jnt_limited[joint] = 1
            model.jnt_range[joint] = -1e-5, 1e-5


@dataclass(frozen=True)
class Shaking:
    """Vertical accelerations [m/s^2] at speed, a step each: of the chassis, of the bed."""

    time: Array
    chassis: Array
    bed: Array


def shaken(rigid: bool) -> Shaking:
    """A rough road at 20 km/h with a casualty's weight on the bed."""
    values = {"roughness": "D", "length": ROAD + 20.0, "width": 4.0}
    spec = scenes.make("rough_road", robot="rescue", seed=1, **values)
    model = laden(spec, CASUALTY)
    if rigid:
        lock_springs(model)
    rover = Rover(model, raised=True)
    rover.controller.drive(DRIVING_SPEED)
    speeds: list[tuple[float, float, float]] = []
    twist, body = np.zeros(6), mujoco.mjtObj.mjOBJ_BODY
    ids = [model.body(name).id for name in ("upper_legs", "transfer_bed")]
    while rover.data.qpos[0] < ROAD and rover.data.time < 20.0:
        motion = rover.period()
        rising = [0.0, 0.0]
        for place, i in enumerate(ids):
            mujoco.mj_objectVelocity(model, rover.data, body, i, twist, 0)
            rising[place] = float(twist[5])
        if motion.speed > 0.95 * DRIVING_SPEED:
            speeds.append((float(rover.data.time), rising[0], rising[1]))
    log = np.array(speeds)
    up = np.diff(log[:, 1:], axis=0) / np.diff(log[:, 0])[:, None]
    return Shaking(log[1:, 0], up[:, 0], up[:, 1])


def rms(values: Array) -> float:
    """Root of the mean of the squares."""
    return float(np.sqrt(np.mean(values**2)))


@measures("H11")
def springs() -> Finding:
    """A road of class D of ISO 8608, 75 kg on the bed; springs of tracks and bed against none."""
    sprung, rigid = shaken(False), shaken(True)
    lines = [
        line(name, one.time - one.time[0], one.chassis, style)
        for name, one, style in (("rigid", rigid, "faint"), ("springs", sprung, "line"))
    ]
    bed = [
        line(name, one.time - one.time[0], one.bed, style)
        for name, one, style in (("rigid", rigid, "faint"), ("springs", sprung, "line"))
    ]
    return Finding(
        {
            "chassis": rms(sprung.chassis) / rms(rigid.chassis),
            "bed": rms(sprung.bed) / rms(rigid.bed),
            "peak": float(np.abs(sprung.bed).max() / np.abs(rigid.bed).max()),
        },
        [
            Note("rms of the chassis, springs", rms(sprung.chassis), "m/s²"),
            Note("rms of the chassis, rigid", rms(rigid.chassis), "m/s²"),
            Note("rms of the bed, springs", rms(sprung.bed), "m/s²"),
            Note("rms of the bed, rigid", rms(rigid.bed), "m/s²"),
        ],
        [
            Plot("Chassis", "time [s]", "up [m/s²]", lines),
            Plot("Bed with 75 kg", "time [s]", "up [m/s²]", bed),
        ],
    )


def boards() -> mujoco.MjModel:
    """Level ground with two boards of 4 cm across the way."""
    spec = scenes.make("flat", robot="rescue")
    terrain, box = spec.find_default("terrain"), mujoco.mjtGeom.mjGEOM_BOX
    for x in (2.0, 4.0):
        spec.worldbody.add_geom(terrain, type=box, size=[0.1, 1.0, 0.02], pos=[x, 0.0, 0.02])
    return spec.compile()


@measures("H12")
def brakes_hold() -> Finding:
    """All brakes shut but the belts': 20 s of standing, boards at 1 m/s, a road at 20 km/h."""
    still, over = Rover(boards()), Rover(boards())
    still.run(20.0)
    over.controller.drive(1.0)
    arms = [over.model.actuator(f"{s}{joint}").id for s in "LR" for joint in ("SP", "SR", "EB")]
    jolts, efforts = [0.0], [0.0]
    angles: list[tuple[float, ...]] = []
    kinds = ("SP", "SR", "SY", "EB")

    def look(_: object) -> None:
        jolts.append(float(over.data.qacc[2]))
        efforts.append(float(np.abs(over.data.actuator_force[arms]).max()))
        angles.append((over.data.time, *(over.moved(kind) for kind in kinds)))

    over.run(6.0, look)
    log = np.array(angles)
    lines = [line(kind, log[:, 0], 1e3 * log[:, i + 1]) for i, kind in enumerate(kinds)]
    return Finding(
        {
            "standing": still.moved(*kinds),
            "boards": over.moved(*kinds),
            "torque": max(efforts),
            "way": float(over.data.qpos[0]),
        },
        [Note("hardest jolt of the base, up", max(jolts), "m/s²")],
        [Plot("Arms over two boards", "time [s]", "moved [mrad]", lines)],
    )
