"""The rescue robot that presses its hands on the ground, in the physics.

  joint < {hpos, force} < hpitch < pel < gaze, rho = 0.1                          section 5.6.1

Velocities (section 5.7) or accelerations (section 5.6), as the law of the force asks for, in the
closed loop with the servos of the missions. The contact force is read from the deflection of the
elbow springs, from the contact itself where the elbows are rigid; f < 0 presses down.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

import mujoco
import numpy as np

import hurcules
from hurcules import Stack, StackLevel, _core
from hurcules_studies.thesis.measures.press_log import DT, Log, empty_log
from hurcules_studies.thesis.measures.press_scene import Surface, model_of
from hurcules_studies.thesis.measures.problems import Array

__all__ = ["DT", "GAZE", "SETTLED", "START", "Log", "PressRobot", "Setting", "Speed", "ramped"]

SUPPORT = "lower_leg_L"
SETTLED = 1.4  # [s]
GAZE = (2.1, 0.0, 0.1)  # [m]
# sought so that the reach of section 5.6.3 meets its limits when the thesis says; tips 0.05 m above
# the ground and 1.41 m from the knees, lower arms 0.60 rad below the horizontal
START: Mapping[str, float] = {
    "KN": 1.9946,
    "HIP": 0.2711,
    "NKP": -0.7302,
    "LSP": 1.2802,
    "RSP": 1.2802,
    "LEB": 1.0949,
    "REB": 1.0949,
}

Speed = Callable[[float], float]  # time [s] -> [m/s]


@dataclass(frozen=True)
class Setting:
    """What is pressed on, and how.

    Attributes:
        surface: what is under the hands.
        gains: of the force loop.
        environment: [N/m] that the force task is told; 0: it learns it.
        blend: [s] from motion to force.
        force: False: motion alone, readings are only watched.
        bandwidth: of the servos, over that of the missions.
        f_max: [N].
        method: of the solver; the default hands weak directions down smoothly.
        rest: [1/s] rate at which weak and free directions brake, by accelerations.
        max_lead: [m] of the hands across the force.
    """

    surface: Surface = field(default_factory=Surface)
    gains: hurcules.ForceGains = field(default_factory=hurcules.ForceGains)
    environment: float = 0.0
    blend: float = 0.1
    force: bool = True
    bandwidth: float = 1.0
    f_max: float = 150.0
    method: str = "lexicographic"
    rest: float = 0.0
    max_lead: float = math.inf


def ramped(speed: float, start: float, end: float, ramp: float = 0.3) -> Speed:
    """A speed from start to end [s], reached and left smoothly within `ramp`."""

    def at(time: float) -> float:
        u = min(max(min(time - start, end - time) / ramp, 0.0), 1.0)
        return speed * u * u * (3.0 - 2.0 * u)

    return at


class PressRobot:
    """The robot with its tasks in the closed loop.

    Attributes:
        model, data, simulation: the physics and its loop.
        controller: of the loop; its stack rules after the start.
        plan: the robot at its reference, as of the last tick of a log.
    """

    def __init__(
        self,
        setting: Setting,
        posture: Mapping[str, float] = START,
        keyframe: str = "stretch",
    ) -> None:
        """Stands at the origin.

        Args:
            setting: what is pressed on, and how.
            posture: coordinates [rad]; the others as in the keyframe.
            keyframe: of the model.
        """
        self.setting = setting
        self.model = model_of(setting.surface)
        self.data = mujoco.MjData(self.model)
        self.plan = plan = hurcules.Robot(self.model)
        plan.set_keyframe(keyframe)
        plan.stand_on(SUPPORT)
        plan.set_configuration(_configured(plan, posture))
        self._make_tasks()
        table = hurcules.servo_table(plan)
        smooth = "smooth" if setting.method == "lexicographic" else "strict"
        solver = hurcules.rhqp.SolverOptions(method=setting.method, handover=smooth)
        self.accelerates = setting.gains.loop != hurcules.ForceLoop.FirstOrder
        led = [*self.across, *self.forces]
        self.controller = hurcules.WholeBodyController(
            plan,
            self.stack(),
            {task.name: hurcules.Twist(task, math.inf) for task in led},
            control="acceleration" if self.accelerates else "velocity",
            servo={name: (J, setting.bandwidth * omega) for name, (J, omega) in table.items()},
            feed_forward=False,  # as the claims' servos: without a model
            velocity=hurcules.VelocityControllerOptions(law="thesis", solver=solver),
            acceleration=hurcules.AccelerationControllerOptions(
                rest=setting.rest, law="thesis", solver=solver
            ),
        )
        options = hurcules.SimulationOptions(
            record=False, monitors=hurcules.MonitorOptions(on=False)
        )
        self.simulation = _core.Simulation(self.model, self.data, self.controller, options)
        for side, task in zip("LR", self.forces, strict=True):
            if setting.surface.springs:
                spring = hurcules.SpringForce(plan, f"{side}EBS", f"{side}_tcp")
                self.controller.sense(task, spring)
            else:  # the sensor's rows: how many contacts, then their force
                self.controller.sense(task, f"{side}_press", row=3)
        self._press = [self.model.sensor(f"{s}_press").adr[0] + 1 for s in "LR"]
        self._servoed = sum(len(coordinate.joints) for coordinate in plan.coordinates)
        self.begin()

    def begin(self) -> None:
        """The stack rules from here: where the robot stands now all targets hold but the gaze."""
        self.controller.use("stack")
        self.gaze.set_target(GAZE)
        self.enable(self.setting.force)
        self.ticks = 0

    def _make_tasks(self) -> None:
        setting, plan = self.setting, self.plan
        self.joint = hurcules.JointLimits("joint", plan)
        for name, (lower, upper) in hurcules.mode_ranges("rescue_ready").items():
            self.joint.set_range(name, lower, upper)
        across = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]
        contact = hurcules.ContactOptions(f_max=setting.f_max)
        self.across = [
            hurcules.PositionTask(f"{s}hpos", plan, f"{s.upper()}_tcp", axes=across) for s in "lr"
        ]
        for task in self.across:
            task.max_lead = setting.max_lead
        self.forces = [
            hurcules.ForceTask(
                f"{s}force",
                plan,
                f"{s.upper()}_tcp",
                gains=setting.gains,
                environment=setting.environment,
                blend=setting.blend,
                contact=contact,
            )
            for s in "lr"
        ]
        self.pitch = [hurcules.AngleTask(f"{s}hpitch", plan, f"{s.upper()}_tcp") for s in "lr"]
        self.pelvis = hurcules.PositionTask("pel", plan, "pelvis", axes=[[1.0, 0.0, 0.0]])
        self.gaze = hurcules.GazeTask("gaze", plan, "gaze")
        # what the eleven rows leave free keeps its speed where accelerations are asked for
        self.rest = hurcules.PostureTask("rest", plan)

    def stack(self) -> Stack:
        """As the thesis orders it."""
        hands = StackLevel("hpos, force", [*self.across, *self.forces])
        pitch = StackLevel("hpitch", self.pitch)
        rest = [self.rest] if self.accelerates else []
        return Stack([self.joint, hands, pitch, self.pelvis, self.gaze, *rest])

    @property
    def time(self) -> float:
        """Since its start [s]."""
        return self.ticks * DT

    def enable(self, on: bool) -> None:
        """Force control of both hands on or off."""
        for task in self.forces:
            task.enable(on)

    def settle(self, end: float = SETTLED) -> None:
        """Stands still until `end` [s], then begins with the force control that it was set to.

        The robot takes its stand and the arms swing on their springs, which reads as contact.
        """
        self.enable(False)
        while self.ticks < round(end / DT):
            self.tick(0.0, 0.0)
        self.enable(self.setting.force)

    def tick(self, x: float, z: float) -> None:
        """One step: both hands are led by speeds [m/s] ahead and up."""
        self.simulation.step(1, [x, 0.0, x, 0.0, z, z])
        self.ticks += 1

    def press(self, side: int) -> Array:
        """What an arm presses on things with, (3,) [N], world axes."""
        at = self._press[side]
        return np.asarray(self.data.sensordata[at : at + 3])

    def follow(self, x: Speed, z: Speed, end: float) -> Log:
        """Moves both hands by speeds over time until `end` [s], and keeps every tick."""
        count = round(end / DT) - self.ticks
        controller, plan = self.controller, self.plan
        log = empty_log(plan.coordinate_names, count)
        tip = self.data.site("L_tcp")
        for i in range(count):
            time = self.time
            self.tick(x(time), z(time))
            plan.set_configuration(controller.q_des)
            log.time[i], log.q[i], log.qd[i] = time, controller.q_des, controller.qd_des
            log.force[i] = [task.force for task in self.forces]
            log.contact[i] = [self.press(side) for side in (0, 1)]
            log.hand[i], log.planned[i] = tip.xpos, plan.position("L_tcp")
            log.state[i] = [int(task.contact) for task in self.forces]
            log.active[i] = controller.active_limits
            log.changes[i] = controller.solution.changes
            log.errors[i] = self.errors()
            log.servo[i] = np.abs(controller.joint_error[: self._servoed]).max()
            log.base[i] = self.data.qpos[:3]
        return log

    def errors(self) -> list[float]:
        """Norms of the errors of hands across, pitches, pelvis, gaze."""
        groups: list[Sequence[hurcules.Task]] = [
            self.across,
            self.pitch,
            [self.pelvis],
            [self.gaze],
        ]
        return [float(np.sqrt(sum(float(t.error @ t.error) for t in group))) for group in groups]


def _configured(plan: hurcules.Robot, posture: Mapping[str, float]) -> Array:
    q, names = plan.configuration, plan.coordinate_names
    for name, angle in posture.items():
        q[names.index(name)] = angle
    return q
