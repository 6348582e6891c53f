"""Plays moves in the closed loop, with a watch over what they take."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import mujoco
import numpy as np
from numpy.typing import ArrayLike, NDArray

from hurcules import _core
from hurcules._core import Error, static_margin
from hurcules.postures.moves import Move

__all__ = ["Player", "Result", "joint_controller", "joint_loop", "look"]

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
    """Holds a robot at its joint angles and moves it: a client of the closed loop.

    Args:
        model: a scene with the robot; its actuators are motors at joints.
        data: of this model, in the posture to begin with; the player steps it. It begins at rest,
            at time 0, no brake shut.
        carried: bodies that count to the robot's centre of mass when they are above the ground.
        simulation: of this model and data that goes on instead of one of the player's own; its
            controller's stacks may rule between two moves.

    Attributes:
        simulation, controller: the loop.
        joints: (motors,) names, as `controller.joints`.
        peak: (motors,) [N m] or [N] their largest torques.
        reference: (motors,) [rad] or [m], where the motors are held.
        watch: called after every step.

    Raises:
        Error: a motor for which the model has no numeric `servo_JOINT`. Every move raises it, too,
            when the run is over: the physics diverged, say.
    """

    def __init__(
        self,
        model: mujoco.MjModel,
        data: mujoco.MjData,
        carried: Sequence[str] = (),
        simulation: _core.Simulation | None = None,
    ) -> None:
        self.model, self.data, self.carried = model, data, list(carried)
        self.watch: Callable[[], None] | None = None
        self.simulation = simulation or joint_loop(model, data)
        self.controller = self.simulation.controller
        self.joints = self.controller.joints
        ids = [model.joint(joint).id for joint in self.joints]
        self._qpos, self._dof = model.jnt_qposadr[ids], model.jnt_dofadr[ids]
        motors = [model.actuator_trnid[: model.nu, 0].tolist().index(joint) for joint in ids]
        self.peak = model.actuator_forcerange[motors, 1].copy()
        self._speed = np.array([self._number("velocity_limit", joint) for joint in self.joints])
        self._power = np.array([self._number("power_limit", joint) for joint in self.joints])
        self.reference = self.controller.joint_places

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
        self.controller.move_all(self.reference, speed)
        self._checked(self.simulation.step(1))

    def rule(self, name: str, ticks: int, command: Callable[[int], ArrayLike]) -> Result:
        """Lets the first stack of the loop's controller rule, then holds where it has led.

        Args:
            name: what happens.
            ticks: how many.
            command: of a tick, counted from 0, as `Simulation.step` takes it.
        """
        self.controller.use(self.controller.stacks[0])
        result = self._run(
            name, ticks, lambda i: self.simulation.step(1, np.asarray(command(i), np.float64))
        )
        self.reference = self.controller.joint_places
        return result

    def _play(self, each: Move) -> Result:
        moving = each.joints()
        columns = self._motors(each.name, moving)
        dt = self.model.opt.timestep
        ticks = round((each.seconds + each.hold) / dt)
        times = dt * np.arange(1, ticks + 1)
        ways = [
            each.targets(joint, self.reference[column], times)
            for joint, column in zip(moving, columns, strict=True)
        ]
        q, qd = np.array(ways).reshape(len(moving), 2, ticks).transpose(1, 2, 0)
        return self._lead(each.name, columns, q, qd)

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
        return self._lead(name, moving, q, qd)

    def _motors(self, name: str, joints: Sequence[str]) -> list[int]:
        unknown = [joint for joint in joints if joint not in self.joints]
        if unknown:
            raise Error(f"move '{name}': no motor at {', '.join(unknown)}")
        return [self.joints.index(joint) for joint in joints]

    def _lead(
        self, name: str, moving: list[int], q: NDArray[np.float64], qd: NDArray[np.float64]
    ) -> Result:
        """Ticks, a row of places and speeds of the moving motors each; the others stay."""
        speed = np.zeros(len(self.joints))

        def step(i: int) -> int:
            self.reference[moving], speed[moving] = q[i], qd[i]
            self.controller.move_all(self.reference, speed)
            return self.simulation.step(1)

        return self._run(name, len(q), step)

    def _run(self, name: str, ticks: int, step: Callable[[int], int]) -> Result:
        """Ticks, watched."""
        result = Result(name)
        peaks = np.zeros((4, len(self.joints)))  # torque, error, speed, power
        seen = np.zeros((3, _LOOK, len(self.joints)))
        qvel = self.data.qvel
        for i in range(ticks):
            k = i % _LOOK
            torque, error, velocity = seen[:, k]
            velocity[:] = qvel[self._dof]
            self._checked(step(i))
            torque[:], error[:] = self.controller.torque, self.controller.joint_error
            if k == 0:
                look(self.model, self.data, result, self.carried)
            if k == _LOOK - 1 or i == ticks - 1:
                torque, error, velocity = seen[:, : k + 1]
                taken = np.abs([torque, error, velocity]).max(axis=1)
                power = (torque * velocity).max(axis=0)
                peaks = np.maximum(peaks, [*taken, power])
        share = peaks[0] / self.peak
        result.torque = dict(zip(self.joints, share.tolist(), strict=True))
        result.error = dict(zip(self.joints, peaks[1].tolist(), strict=True))
        result.speed = float((peaks[2] / self._speed).max(initial=0.0))
        result.power = float((peaks[3] / self._power).max(initial=0.0))
        return result

    def _checked(self, ticks: int) -> None:
        if not ticks:
            raise Error(f"the run is over: {self.simulation.reason}")
        if self.watch is not None:
            self.watch()


def look(
    model: mujoco.MjModel, data: mujoco.MjData, result: Result, carried: Sequence[str] = ()
) -> None:
    """Adds to a result how the robot stands now, and which of its geoms meet.

    Args:
        model: a scene with the robot.
        data: after a step.
        result: what was seen before.
        carried: bodies that count to the robot's centre of mass when they are above the ground.
    """
    mine = model.body_rootid[model.geom_bodyid] == model.body("upper_legs").rootid
    geoms = data.contact.geom
    for pair in geoms[mine[geoms].all(axis=1)]:
        first, second = sorted(model.geom(int(g)).name for g in pair)
        result.collisions.add((first, second))
    margin = static_margin(model, data, "upper_legs", list(carried))
    result.margin = min(result.margin, margin)


def joint_controller(
    model: mujoco.MjModel,
    qpos: ArrayLike,
    servo: Mapping[str, tuple[float, float]] | None = None,
    **options: Any,
) -> _core.WholeBodyController:
    """A controller that moves joints one by one.

    Args:
        model: of a robot whose actuators are motors at joints.
        qpos: (nq,) where it starts, at rest.
        servo: by joint with a motor the inertia that it turns [kg m^2] and its bandwidth [rad/s];
            None: the model's numerics `servo_JOINT`.
        **options: further ones of `WholeBodyController`.

    Raises:
        Error: a motor without a row in `servo`.
    """
    table = _table_of(model) if servo is None else dict(servo)
    plan = _core.Robot(model)
    plan.set_qpos(np.asarray(qpos, np.float64))
    # no feed-forward: whatever the robot carries is a disturbance that the gains are made for
    posture = _core.PostureTask("posture", plan)
    return _core.WholeBodyController(plan, [posture], servo=table, feed_forward=False, **options)


def joint_loop(
    model: mujoco.MjModel,
    data: mujoco.MjData,
    servo: Mapping[str, tuple[float, float]] | None = None,
) -> _core.Simulation:
    """A closed loop that moves joints one by one, from where the data stand, at rest.

    Args:
        model: of a robot whose actuators are motors at joints.
        data: of this model; the loop steps it.
        servo: as `joint_controller` takes it.

    Raises:
        Error: a motor without a row in `servo`.
    """
    controller = joint_controller(model, data.qpos, servo)
    options = _core.SimulationOptions(record=False, monitors=_core.MonitorOptions(on=False))
    return _core.Simulation(model, data, controller, options)


def _table_of(model: mujoco.MjModel) -> dict[str, tuple[float, float]]:
    table = _core.servo_table(_core.Robot(model))
    joints = [model.joint(int(j)).name for j in model.actuator_trnid[: model.nu, 0]]
    missing = [joint for joint in joints if joint not in table]
    if missing:
        raise Error(f"the model has no servo_JOINT for the joints {', '.join(missing)}")
    return table
