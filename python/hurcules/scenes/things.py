"""Things to handle: ordnance, debris, a sled to tow, a door, a valve."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import mujoco
import numpy as np
from numpy.typing import NDArray

from hurcules.scenes.ground import Ground, turn
from hurcules.scenes.parameters import choice, count, flag, number
from hurcules.scenes.scene import Scene

__all__ = ["Debris", "Door", "Ordnance", "Sled", "Valve"]

PIECES = {"timber_2x4": 0.019, "timber_4x4": 0.0445, "concrete_block": 0.095}  # half heights [m]
HANDLE = 1.54  # [m] of the sled's bar before its middle
EYE = (-0.62, 0.0, 0.02)  # [m] the towing eye in the frame of the upper legs
CHAIN = 0.40  # [m] of coupling between eye and handle: clear of the lower legs' ends
FALL = 4.0  # [s] in which a heap lies, however high
LOOK, LIES = 0.1, 1e-3  # [s] between two looks, [m] that no piece moves between them once it lies
CASE_RADIUS, BOX_HALF = 0.067, 0.14  # [m] of the shell (with its band) and the box


@dataclass(frozen=True)
class Ordnance(Scene):
    """A shell and a box of 30 kg each, before the left and the right hand."""

    distance: float = number(1.7, 1.5, 10.0, "m", "from the start")
    apart: float = number(1.0, 0.6, 4.0, "m", "between the middles")
    height: float = number(0.0, 0.0, 1.2, "m", "of the tables they lie on; 0: on the ground")

    def build(self, ground: Ground) -> None:
        """Tables if wanted, then both things."""
        half = self.apart / 2
        if self.height > 0.0:
            reach = min(0.45, half - 0.01)
            for name, y in (("left", half), ("right", -half)):
                low = (self.distance - 0.3, y - reach, 0.0)
                high = (self.distance + 0.3, y + reach, self.height)
                ground.box(f"table_{name}", low, high, material="timber")
        left = (self.distance, half, self.height + CASE_RADIUS)
        ground.attach("shell_30kg", "shell_", left, turn("z", math.pi))
        ground.attach("ordnance_box_30kg", "box_", (self.distance, -half, self.height + BOX_HALF))


@dataclass(frozen=True)
class Debris(Scene):
    """Timber and concrete blocks in layers before the robot, drawn by the seed."""

    source: ClassVar[str] = "DARPA Robotics Challenge (debris)"
    timber: int = count(10, 0, 60, "pieces of wood, half of each size")
    blocks: int = count(4, 0, 60, "hollow concrete blocks")
    length: float = number(2.0, 0.5, 10.0, "m", "of the heap along the way")
    width: float = number(1.6, 0.5, 10.0, "m", "of the heap across")
    distance: float = number(2.5, 1.5, 20.0, "m", "from the start to its near side")

    def build(self, ground: Ground) -> None:
        """Each piece falls from above those before it; the scene begins when all lie."""
        names = ["concrete_block"] * self.blocks
        names += ["timber_4x4", "timber_2x4"] * (self.timber // 2) + ["timber_2x4"] * (
            self.timber % 2
        )
        poses, height = [], 0.0
        for name in names:
            low = np.array([self.distance + 0.5, -self.width / 2])
            place = low + ground.rng.random(2) * (self.length, self.width)
            yaw = turn("z", ground.rng.uniform(-math.pi, math.pi))
            thick = PIECES[name]
            poses.append(np.array([*place, height + thick + 0.002, *yaw]))
            height += 2 * thick + 0.004
        fallen = _fallen(names, poses, ground)
        for index, (name, pose) in enumerate(zip(names, fallen, strict=True), start=1):
            ground.attach(name, f"piece_{index}_", pose[:3], pose[3:])


def _fallen(
    names: list[str], poses: list[NDArray[np.float64]], ground: Ground
) -> NDArray[np.float64]:
    """Where pieces come to rest on level ground, (n, 7): position [m], quaternion."""
    if not names:
        return np.zeros((0, 7))
    alone = Ground(None, ground.friction, 0)
    for index, (name, pose) in enumerate(zip(names, poses, strict=True)):
        alone.attach(name, f"{index}_", pose[:3], pose[3:])
    # the settings of models/common/options.xml are for tracks and brakes: 60 pieces took 38 s
    option = alone.spec.option
    option.timestep, option.tolerance, option.impratio = 0.002, 1e-8, 10.0
    model = alone.spec.compile()
    data = mujoco.MjData(model)
    pieces, moved = data.qpos.reshape(-1, 7), np.inf
    while data.time < FALL and moved > LIES:
        before = pieces[:, :3].copy()
        mujoco.mj_step(model, data, nstep=round(LOOK / model.opt.timestep))
        moved = np.abs(pieces[:, :3] - before).max()
    return pieces.copy()


@dataclass(frozen=True)
class Sled(Scene):
    """The sled to tow: its handle lies before the robot, or hangs at its towing eye behind."""

    source: ClassVar[str] = "ASTM E2830, E2831 (towing, grasped and hitched sleds)"
    mass: float = number(75.0, 25.0, 3000.0, "kg", "of sled and load")
    sled_friction: float = number(0.5, 0.05, 1.5, "", "sliding friction of the runners")
    distance: float = number(1.7, 1.5, 10.0, "m", "from the start to the handle")
    hitched: bool = flag(
        False, "coupled behind the robot, drive pose; `distance` then says nothing"
    )

    def build(self, ground: Ground) -> None:
        """The load makes up the mass."""
        if self.hitched:
            self._hitch(ground)
        else:
            ground.attach("sled", "sled_", (self.distance + HANDLE, 0.0, 0.0))
        for name in ("runner_left", "runner_right", "nose_left", "nose_right"):
            ground.spec.geom(f"sled_{name}").friction[0] = self.sled_friction
        ground.spec.geom("sled_load").mass = self.mass - 20.0

    def _hitch(self, ground: Ground) -> None:
        """A rope of no mass from the towing eye to the middle of the handle, tight."""
        ground.attach("sled", "sled_", (EYE[0] - CHAIN - HANDLE, 0.0, 0.0), turn("z", math.pi))
        robot = ground.spec.body("upper_legs")
        if robot is None:  # the ground alone
            return
        robot.add_site(name="towing_eye", pos=EYE, group=4)
        rope = ground.spec.add_tendon(name="rope", limited=True, range=(0.0, CHAIN + 0.01))
        rope.wrap_site("towing_eye")
        rope.wrap_site("sled_handle")


@dataclass(frozen=True)
class Door(Scene):
    """A door of 0.851 m in a wall across the way, with lever, latch and closer."""

    source: ClassVar[str] = "DARPA Robotics Challenge (door)"
    opens: str = choice("away", ("away", "towards"), "from or to the robot")
    closer: bool = flag(True, "a spring shuts it")
    distance: float = number(2.5, 1.5, 20.0, "m", "from the start")

    def build(self, ground: Ground) -> None:
        """Seen from behind, the same door opens towards the robot."""
        quat = turn("z", math.pi if self.opens == "towards" else 0.0)
        ground.attach("door", "door_", (self.distance, 0.0, 0.0), quat)
        if not self.closer:
            ground.spec.joint("door_hinge").stiffness = np.zeros(3)


@dataclass(frozen=True)
class Valve(Scene):
    """A round valve at a wall; to be opened by one turn."""

    source: ClassVar[str] = "DARPA Robotics Challenge (valve)"
    torque: float = number(5.0, 0.0, 200.0, "N m", "friction at the axle")
    height: float = number(1.05, 0.4, 1.7, "m", "of the axle")
    distance: float = number(1.7, 1.5, 10.0, "m", "from the start to the wheel")

    def build(self, ground: Ground) -> None:
        """The whole wall is raised or sunk with the axle."""
        rise = self.height - 1.05
        ground.attach("valve", "valve_", (self.distance, 0.0, rise))
        ground.spec.joint("valve_wheel").frictionloss = self.torque
