"""The rescue robot that drives: drive controller, brakes, drive trains and power in the physics."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import mujoco
import numpy as np

import hurcules
from hurcules import driving, scenes, transfer_bed
from hurcules._core import DriveState
from hurcules_studies.thesis.measures.problems import Array

__all__ = ["BELTS", "DRIVING_SPEED", "RADIUS", "Powered", "Rover", "Trip", "flat", "laden"]

DRIVING_SPEED = 20.0 / 3.6  # [m/s] Table 4.1
RADIUS = 0.14  # [m] of the belts
BELTS = ("L_lower_belt", "R_lower_belt")
ROLLING = 0.06  # resistance over weight, of a firm track (models/README.md)


def laden(spec: mujoco.MjSpec, payload: float) -> mujoco.MjModel:
    """The robot of a scene with a load on its raised transfer bed [kg]."""
    if payload > 0.0:
        bed = spec.body("transfer_bed")
        load = bed.add_body(name="payload", pos=[0.0, 0.0, 0.15])
        load.mass, load.inertia = payload, [payload * 0.2, payload * 0.02, payload * 0.2]
        load.ipos, load.explicitinertial = [0.0, 0.0, 0.0], True
    return spec.compile()


def flat(payload: float = 0.0) -> mujoco.MjModel:
    """Level ground on which the belts roll against a resistance."""
    return laden(scenes.make("flat", robot="rescue", rolling_resistance=ROLLING), payload)


@dataclass(frozen=True)
class Trip:
    """From a start to a stop.

    Attributes:
        seconds, metres: it took.
        energy: [J] from the battery.
        moved: [rad] or [m] of the braked joint that moved most.
        arms: [rad] the same of the arms' joints.
    """

    seconds: float
    metres: float
    energy: float
    moved: float
    arms: float


class Powered:
    """The energy that is taken from the battery.

    Args:
        model: of the plant.
        plant: whose drives take it.
        dt: [s] from one reading to the next; by default a step of the physics.

    Attributes:
        meter: of the last step.
        work, energy: [J] of the motors at their joints; from the battery.
    """

    def __init__(
        self, model: mujoco.MjModel, plant: hurcules.Plant, dt: float | None = None
    ) -> None:
        self.meter = hurcules.PowerMeter(model)
        self.work = self.energy = 0.0
        self._plant, self._dt = plant, dt or float(model.opt.timestep)

    def read(self) -> None:
        """Reads a step that was just taken."""
        self.meter.read(self._plant)
        self.work += self._dt * self.meter.mechanical
        self.energy += self._dt * self.meter.total


class Rover:
    """A robot in its driving pose; every brake is shut but those of the belts.

    Attributes:
        model, data, simulation: the closed loop.
        physics, powered: what is stepped.
        controller: of the drives.
    """

    def __init__(self, model: mujoco.MjModel, raised: bool = False) -> None:
        """Starts in the keyframe `drive`.

        Args:
            model: a scene with the rescue robot.
            raised: the transfer bed is up, as a casualty lies on it.
        """
        start = mujoco.MjData(model)
        mujoco.mj_resetDataKeyframe(model, start, model.key("drive").id)
        if raised:
            start.joint("bed_lift").qpos[0] = transfer_bed.LIFT
        self.simulation = driving.simulation(model, start.qpos)
        self.model, self.data = model, self.simulation.data
        self.physics = self.simulation.plant
        self.powered = Powered(model, self.physics, self.simulation.dt)
        drive = self.simulation.controller.drive
        assert drive is not None
        self.controller = drive
        self._gauge = hurcules.TrackDrive(hurcules.Robot(model))
        self._motors = [model.actuator(f"{side}_drive").id for side in "LR"]
        self._held = {
            joint: int(model.joint(joint).qposadr[0])
            for joint in self.physics.brakes.names
            if "belt" not in joint
        }
        self._start = self.data.qpos.copy()

    def period(self) -> DriveState:
        """One period of the drive controller: what its sensors tell after it."""
        self.simulation.step(1)
        self.powered.read()
        return self._gauge.measure(self.data.qpos, self.data.qvel)

    def run(self, seconds: float, look: Callable[[DriveState], object] | None = None) -> None:
        """Goes on for a time [s], and shows what was sensed."""
        for _ in range(round(seconds / self.simulation.dt)):
            motion = self.period()
            if look is not None:
                look(motion)

    @property
    def motor_share(self) -> float:
        """Torque that a drive is asked for over what motor and gear can give now; the larger."""
        shares = []
        for motor, belt in zip(self._motors, BELTS, strict=True):
            asked = float(self.data.ctrl[motor])
            speed = float(self.data.joint(belt).qvel[0])
            low, high = self.physics.effort_range(belt, speed)
            shares.append(asked / (high if asked > 0.0 else low))
        return max(shares)

    @property
    def centre(self) -> Array:
        """Of the robot's mass [m], (3,)."""
        return np.array(self.data.subtree_com[self.model.body("upper_legs").id])

    def moved(self, *kinds: str) -> float:
        """How far a braked joint has moved at most; those whose names end so, by default all."""
        far = [
            abs(float(self.data.qpos[place] - self._start[place]))
            for joint, place in self._held.items()
            if not kinds or joint[1:] in kinds
        ]
        return max(far)

    def drive(self, metres: float, speed: float = DRIVING_SPEED) -> Trip:
        """Straight on from rest to rest."""
        braking = speed**2 / 2.0 / self.controller.options.forward.acceleration
        began, x = float(self.data.time), float(self.data.qpos[0])
        self.controller.drive(speed)
        limit = began + 3.0 * metres / speed + 20.0
        while self.data.qpos[0] - x < metres - braking - 0.7 and self.data.time < limit:
            self.period()
        self.controller.drive(0.0)
        while not self.controller.braked and self.data.time < limit:
            self.period()
        return Trip(
            float(self.data.time) - began,
            float(self.data.qpos[0]) - x,
            self.powered.energy,
            self.moved(),
            self.moved("SP", "SR", "SY", "EB"),
        )
