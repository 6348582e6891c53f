"""A robot that carries a box between its hands: what is added to its file, how it stands."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import mujoco
import numpy as np
from numpy.typing import NDArray

import hurcules
from hurcules_envs.contact import add_force_sensor
from hurcules_envs.robots import RobotSetup

__all__ = ["BOARD", "FEELS", "HANDS", "PALMS", "Carrier", "Place", "add_things", "with_palms"]

Array = NDArray[np.float64]
Place = tuple[float, float, float]

# by the axis of a frame that looks out of the palm: the rotation (w, x, y, z) of its x to there
PALMS: Mapping[str, tuple[float, float, float, float]] = {
    "x": (1.0, 0.0, 0.0, 0.0),
    "y": (0.5**0.5, 0.0, 0.0, 0.5**0.5),
    "z": (0.5**0.5, 0.0, -(0.5**0.5), 0.0),
    "-x": (0.0, 0.0, 0.0, 1.0),
    "-y": (0.5**0.5, 0.0, 0.0, -(0.5**0.5)),
    "-z": (0.5**0.5, 0.0, 0.5**0.5, 0.0),
}
HANDS = ("left_palm", "right_palm")  # sites in the middle of the palms, x out of them
FEELS = ("left_feel", "right_feel")  # sensors
PAD, THICK = 0.04, 0.04  # [m] half of a pad across, and how far it stands before the frame
BOARD = 0.02  # [m] half of the table's board
PUSH, PUSHED = 100.0, 0.2  # [N] by which the arm's stiffness is measured, [s] for which


@dataclass(frozen=True, eq=False)
class Carrier:
    """A robot that carries.

    Attributes:
        setup: the robot alone.
        palm: axis of its frames that looks out of the palms.
        pads: flat pads stand before the frames.
        place: (3) [m] middle of the table's top.
        share: of the loads of the manipulation robot that its motors bear, at most 1.
        configuration: (n,) where it starts.
    """

    setup: RobotSetup
    palm: str
    pads: bool
    place: Place
    share: float
    configuration: Array

    def scene(self) -> mujoco.MjSpec:
        """Robot, pads, sensors, table and box."""
        spec = with_palms(self.setup, self.palm, self.pads)
        add_things(spec, self.place)
        return spec

    def plan(self, model: mujoco.MjModel) -> hurcules.Robot:
        """The robot in the scene, at its start."""
        robot = hurcules.Robot(model, list(self.setup.joints))
        robot.set_configuration(self.configuration)
        return robot

    def stiffness(self, simulation: hurcules.Simulation) -> float:
        """[N/m] of the right hand across, in the loop: by a push, before servos undo it."""
        batch = hurcules.SimulationBatch(simulation, 1, 1)
        reading = hurcules.Quantities(simulation, [f"position/{HANDS[1]}"])
        rest = np.zeros((1, len(simulation.command_names)))
        before, yields = batch.read(reading)[0, 1], 1e-6
        force = PUSH * self.share
        body = int(simulation.model.site(HANDS[1]).bodyid[0])
        batch.push(body, [[0.0, -force, 0.0]])
        for _ in range(round(PUSHED / simulation.dt)):
            batch.step(1, rest)
            yields = max(yields, before - batch.read(reading)[0, 1])
        return force / yields


def with_palms(setup: RobotSetup, palm: str, pads: bool) -> mujoco.MjSpec:
    """The robot as it was written, with sites, sensors and pads at its hands."""
    try:
        spec = mujoco.MjSpec.from_file(setup.name)
    except ValueError as error:
        raise hurcules.Error(f"{setup.name}: {error}") from error
    spec.option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC  # what is squeezed does not creep
    spec.option.impratio = 100.0
    for frame, hand, feel in zip(setup.hands, HANDS, FEELS, strict=True):
        body, pos, quat = _frame(setup, spec, frame)
        turn, out = np.zeros(4), np.zeros(3)
        mujoco.mju_mulQuat(turn, quat, np.array(PALMS[palm]))
        mujoco.mju_rotVecQuat(out, np.array([1.0, 0.0, 0.0]), turn)
        face = pos + (THICK * out if pads else 0.0)
        body.add_site(name=hand, pos=face, quat=turn, group=4)
        if pads:
            body.add_geom(
                name=f"{hand}_pad", type=mujoco.mjtGeom.mjGEOM_BOX, size=[THICK / 2, PAD, PAD],
                pos=face - 0.5 * THICK * out, quat=turn, contype=1, conaffinity=1, condim=4,
                friction=[0.6, 0.02, 0.001], solref=[0.004, 1.0],
                solimp=[0.99, 0.998, 0.001, 0.5, 2.0], mass=0.0, rgba=[0.15, 0.15, 0.15, 1.0],
            )  # fmt: skip
        add_force_sensor(spec, feel, body.name)
    return spec


def _frame(
    setup: RobotSetup, spec: mujoco.MjSpec, frame: str
) -> tuple[mujoco.MjsBody, Array, Array]:
    """The body of a frame, and where it is in it."""
    model = setup.model
    if mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_SITE, frame) >= 0:
        site = model.site(frame)
        name = model.body(int(site.bodyid[0])).name
        body, pos, quat = spec.body(name) if name else None, site.pos.copy(), site.quat.copy()
    else:
        body = spec.body(frame)
        pos, quat = np.zeros(3), np.array([1.0, 0.0, 0.0, 0.0])
    if body is None:
        raise hurcules.Error(
            f"robot {setup.name}: hands of Carry are bodies with a name or sites on them, got "
            f"'{frame}'"
        )
    return body, pos, quat


def add_things(spec: mujoco.MjSpec, place: Sequence[float]) -> None:
    """Table and box, in the middle of the table's top."""
    x, y, z = place
    things = {"conaffinity": 2**31 - 1, "contype": 1}
    table = spec.worldbody.add_body(name="table", pos=[x, y, z])
    table.add_geom(
        name="table", type=mujoco.mjtGeom.mjGEOM_BOX, size=[0.10, 0.14, BOARD],
        pos=[0.0, 0.0, -BOARD], friction=[0.9, 0.005, 0.0001], rgba=[0.4, 0.4, 0.42, 1.0], **things,
    )  # fmt: skip
    box = spec.worldbody.add_body(name="box", pos=[x, y, z + 0.11])
    box.add_freejoint(name="box")
    box.add_geom(
        name="box", type=mujoco.mjtGeom.mjGEOM_BOX, size=[0.06, 0.21, 0.11], mass=20.0, condim=4,
        friction=[0.9, 0.02, 0.001], rgba=[0.62, 0.45, 0.25, 1.0], **things,
    )  # fmt: skip
