"""Plays moves in the physics: a servo at every motor, and a watch over what it takes."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from functools import partial

import mujoco
import numpy as np
from numpy.typing import ArrayLike, NDArray

from hurcules import _core
from hurcules._core import Error
from hurcules.postures.balance import static_margin
from hurcules.postures.moves import Move

__all__ = ["Player", "Result"]

_LOOK = 50  # steps between two looks


@dataclass
class Result:
    """What a move took, at its worst."""

    name: str
    margin: float = np.inf  # [m] centre of mass to the edge of the support; negative: it tips over
    collisions: set[tuple[str, str]] = field(default_factory=set)  # geoms of the robot that met
    torque: dict[str, float] = field(default_factory=dict)  # by joint, share of the peak
    speed: float = 0.0  # share of the peak speed
    power: float = 0.0  # share of the peak power
    error: dict[str, float] = field(default_factory=dict)  # by joint [rad] or [m]

    @property
    def worst_torque(self) -> float:
        """Share of the peak torque, of the joint that came closest to it."""
        return max(self.torque.values(), default=0.0)

    @property
    def worst_error(self) -> float:
        """Of all joints [rad] or [m]."""
        return max(self.error.values(), default=0.0)


class Player:
    """Holds a robot at its joint angles and moves it.

    Args:
        model: a scene with the robot; its actuators are motors at joints.
        data: of this model, in the posture to begin with; the player steps it.
        robot: "rescue" or "manipulation": whose servo table is taken.
        carried: bodies that count to the robot's centre of mass when they are above the ground.
        step: one step of the physics; by default `hurcules.step`, without brakes and gears.

    Attributes:
        reference: (motors,) [rad] or [m], where the motors are held.
        watch: called after every step.

    Raises:
        Error: an unknown robot, or a motor that the table does not know.
    """

    def __init__(
        self,
        model: mujoco.MjModel,
        data: mujoco.MjData,
        robot: str,
        carried: Sequence[str] = (),
        step: Callable[[], None] | None = None,
    ) -> None:
        table = _core.servo_table(robot)
        self.model, self.data, self.carried = model, data, list(carried)
        self._step = step or partial(_core.step, model, data)
        self.watch: Callable[[], None] | None = None
        self.joints = [model.joint(int(j)).name for j in model.actuator_trnid[: model.nu, 0]]
        missing = [joint for joint in self.joints if joint not in table]
        if missing:
            raise Error(f"the servo table of '{robot}' lacks the joints {', '.join(missing)}")
        ids = [model.joint(joint).id for joint in self.joints]
        self._qpos, self._dof = model.jnt_qposadr[ids], model.jnt_dofadr[ids]
        self._peak = model.actuator_forcerange[:, 1].copy()
        inertia, bandwidth = np.array([table[joint] for joint in self.joints]).T
        self._pid = _core.JointPid(
            _core.JointPidOptions(
                K=3 * bandwidth * inertia - 1.0,  # K + 1 / gamma^2 = 3 omega J, as triple_pole
                K_P=bandwidth,
                K_I=bandwidth**2 / 3,
                max_torque=self._peak,
                dt=model.opt.timestep,
            )
        )
        self._speed = np.array([self._number("velocity_limit", joint) for joint in self.joints])
        self._power = np.array([self._number("power_limit", joint) for joint in self.joints])
        self._root = int(model.body("upper_legs").id)
        self._mine = model.body_rootid[model.geom_bodyid] == self._root
        self.reference = data.qpos[self._qpos].copy()

    def _number(self, kind: str, joint: str) -> float:
        return float(self.model.numeric(f"{kind}_{joint}").data[0])

    def play(
        self, moves: Iterable[Move], after: Callable[[Move], None] | None = None
    ) -> list[Result]:
        """Plays moves one after the other.

        Args:
            moves: what to do.
            after: called after each move, to tie a load to the hands, say.

        Raises:
            Error: a move names a joint without motor.
        """
        results = []
        for each in moves:
            results.append(self._play(each))
            if after is not None:
                after(each)
        return results

    def wait(self, seconds: float, name: str = "wait") -> Result:
        """Stays where it is for a time [s]."""
        return self._play(Move(name, seconds, (), 0.0))

    def track(self, qpos: ArrayLike) -> None:
        """Takes one step of the physics towards a configuration that somebody else plans.

        Args:
            qpos: (nq,), `Robot.qpos` say: where the joints with a motor shall be. How fast they
                move there follows from the call before.
        """
        before = self.reference
        self.reference = np.asarray(qpos, dtype=np.float64)[self._qpos]
        speed = (self.reference - before) / self.model.opt.timestep
        self._tick(speed, np.zeros((2, len(self.joints))), Result("track"))

    def _play(self, each: Move) -> Result:
        moving = self._motors(each.name, each.joints())
        start, speed = self.reference.copy(), np.zeros(len(self.joints))
        dt = self.model.opt.timestep

        def lead(i: int) -> None:
            for j in moving:
                self.reference[j], speed[j] = each.target(self.joints[j], start[j], (i + 1) * dt)

        return self._lead(each.name, round((each.seconds + each.hold) / dt), lead, speed)

    def follow(
        self, name: str, joints: Sequence[str], q: NDArray[np.float64], qd: NDArray[np.float64]
    ) -> Result:
        """Follows a planned motion.

        Args:
            name: what happens.
            joints: that it moves, by name; the others stay.
            q: (ticks, joints) [rad] or [m], one row a step.
            qd: (ticks, joints) [rad/s] or [m/s].

        Raises:
            Error: a joint without motor, or arrays that do not fit.
        """
        moving = self._motors(name, joints)
        if q.shape != qd.shape or q.shape[1:] != (len(moving),):
            wanted = f"q and qd (ticks, {len(moving)}) are wanted"
            raise Error(f"motion '{name}': {wanted}, {q.shape} and {qd.shape} came")
        speed = np.zeros(len(self.joints))

        def lead(i: int) -> None:
            self.reference[moving], speed[moving] = q[i], qd[i]

        return self._lead(name, len(q), lead, speed)

    def _motors(self, name: str, joints: Sequence[str]) -> list[int]:
        unknown = [joint for joint in joints if joint not in self.joints]
        if unknown:
            raise Error(f"move '{name}': no motor at {', '.join(unknown)}")
        return [self.joints.index(joint) for joint in joints]

    def _lead(
        self, name: str, ticks: int, lead: Callable[[int], None], speed: NDArray[np.float64]
    ) -> Result:
        """Ticks, each after `lead` has set the reference and the speed of it."""
        result = Result(name)
        worst = np.zeros((2, len(self.joints)))  # torque share, error
        for i in range(ticks):
            lead(i)
            self._tick(speed, worst, result)
            if i % _LOOK == 0:
                self._look(result)
        result.torque = dict(zip(self.joints, worst[0].tolist(), strict=True))
        result.error = dict(zip(self.joints, worst[1].tolist(), strict=True))
        return result

    def _tick(self, speed: NDArray[np.float64], worst: NDArray[np.float64], result: Result) -> None:
        velocity = self.data.qvel[self._dof]
        error = self.reference - self.data.qpos[self._qpos]
        self.data.ctrl[:] = torque = self._pid.compute(error, speed - velocity)
        self._step()
        if self.watch is not None:
            self.watch()
        np.maximum(worst[0], np.abs(torque) / self._peak, out=worst[0])
        np.maximum(worst[1], np.abs(error), out=worst[1])
        result.speed = max(result.speed, float((np.abs(velocity) / self._speed).max()))
        result.power = max(result.power, float((torque * velocity / self._power).max()))

    def _look(self, result: Result) -> None:
        geoms = self.data.contact.geom
        for pair in geoms[self._mine[geoms].all(axis=1)]:
            first, second = sorted(self.model.geom(int(g)).name for g in pair)
            result.collisions.add((first, second))
        margin = static_margin(self.model, self.data, "upper_legs", self.carried)
        result.margin = min(result.margin, margin)
