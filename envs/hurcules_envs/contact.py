"""What the environments of contact share: fidelity, models that differ between episodes, marks."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Any, ClassVar

import mujoco
import numpy as np
from numpy.typing import NDArray

import hurcules
from hurcules import mjcf
from hurcules.validation import require_known
from hurcules_envs.commands import TWINS, by_joints
from hurcules_envs.environment import Array, Environment, Numbers, tick_of
from hurcules_envs.robots import load_robot
from hurcules_envs.safety import STANDS, TIPS
from hurcules_envs.standing import SUPPORT

__all__ = [
    "ContactEnvironment",
    "add_force_sensor",
    "box_mark",
    "contact_tick",
    "euler_quat",
    "resize_box",
    "stiffen_fingers",
    "view",
]

PHYSICS = ("exact", "fast")  # fidelities
TILT = 0.35  # [rad] of what it stands on: it falls
STOP = 0.008  # [s] time constant of a finger's stops, two ticks of "fast"


def contact_tick(fidelity: str, rate: float) -> float:
    """Control tick [s] of an environment that lives from forces.

    Args:
        fidelity: "exact" (1 ms) or "fast" (about 4 ms).
        rate: steps of the policy a second [Hz].

    Raises:
        hurcules.Error: "kinematic", which has no forces; an unknown fidelity; a bad rate.
    """
    if fidelity == "kinematic":
        raise hurcules.Error(
            "fidelity 'kinematic' has no physics, so nothing would be touched here: "
            "wanted 'exact' or 'fast'"
        )
    return tick_of(fidelity, rate, PHYSICS)


class ContactEnvironment(Environment):
    """An environment whose scene is built from parts and differs between episodes.

    With the action "joint", for comparison, a policy commands the velocity of each coordinate's
    reference, under the same limits, in place of hands and forces; fingers and tracks, which are no
    coordinates, as before. It sees the coordinates in place of the references' lead.

    Attributes:
        action: "twist" or "joint".
        beside: by channel the scale of what is commanded with the joints too.
        body: the robot, "rescue" or "manipulation".
        support: what it stands on, "" for a fixed base.
        clear: by body what it keeps from the ground [m] in place of what is usual, 0: nothing.
        hanging: [m] that its parts in springs keep from its tracks, None: what is usual.
        within: [m] that centre of mass and zero moment point keep within its contacts.
    """

    fidelities = PHYSICS
    body: ClassVar[str] = "manipulation"
    support: str = SUPPORT
    clear: ClassVar[Mapping[str, float]] = MappingProxyType({})
    hanging: ClassVar[float | None] = None
    within: ClassVar[tuple[float, float]] = (STANDS, TIPS)
    action: str = "twist"
    beside: Mapping[str, float | Array] = MappingProxyType({})

    def __init__(
        self,
        fidelity: str = "exact",
        sparse: bool = False,
        rate: float = 20.0,
        action: str = "twist",
        safe: bool = True,
    ) -> None:
        """Builds scene, controller and loop.

        Args:
            fidelity: "exact" or "fast".
            sparse: no shaped reward: success alone, in Carry with the time at the goal, in Press
                the path.
            rate: steps a second [Hz].
            action: "twist" (what the class says), or "joint" for comparison.
            safe: before the hands come the robot's balance and distances of its parts from each
                other and from the ground; False leaves only the limits.

        Raises:
            hurcules.Error: a value that does not exist or is out of range.
        """
        tick = contact_tick(fidelity, rate)
        self.sparse, self.rate, self.action, self.safe = sparse, rate, action, safe
        self._model = self.compiled(tick)
        self._build(self._model, tick)

    @abstractmethod
    def _build(self, model: mujoco.MjModel, tick: float) -> None:
        """Sets `actions`, then `simulation` at its start."""

    def controller(
        self,
        plan: hurcules.Robot,
        levels: Sequence[Any],
        channels: Mapping[str, Any],
        *,
        safe: bool,
        **options: Any,
    ) -> hurcules.WholeBodyController:
        """The controller of these levels; for "joint" limits and guards come before the joints.

        Args:
            plan: the robot.
            levels: of tasks, as `hurcules.WholeBodyController` takes them.
            channels: by name, the same.
            safe: the levels of `guards` come after the limits.
            options: the same.

        Raises:
            hurcules.Error: another action than "twist" and "joint".
        """
        require_known("action", self.action, TWINS)
        limits = [level for level in levels if isinstance(level, hurcules.JointLimits)]
        rest = [level for level in levels if level not in limits]
        first = [*limits, *(self.guards(plan) if safe else [])]
        if self.action == "joint":
            joints, channels = by_joints(self, plan, channels, self.beside)
            first = [*first, joints]
        return hurcules.WholeBodyController(plan, [*first, *rest], dict(channels), **options)

    def guards(self, plan: hurcules.Robot) -> list[Any]:
        """The safe levels of the robot where it stands in the scene."""
        return load_robot(self.body).safety.levels_in_scene(
            self._model, plan, self.clear, self.hanging, self.within
        )

    def loop(self, controller: hurcules.WholeBodyController) -> hurcules.Simulation:
        """The simulation of a controller, over where the robot falls."""
        fall = hurcules.FallOptions(self.support, max_tilt=TILT) if self.support else None
        return hurcules.Simulation(
            model=self._model, controller=controller, record=False, fall=fall
        )

    @abstractmethod
    def scene(self) -> mujoco.MjSpec:
        """Robot and things, with all that is only seen."""

    def compiled(self, tick: float) -> mujoco.MjModel:
        """The scene as it is simulated: without visuals, steps of the physics of `tick` [s]."""
        model = mjcf.compile(mjcf.without_visuals(self.scene()))
        model.opt.timestep = tick
        return model

    def visual_model(self) -> mujoco.MjModel:
        """The scene as it is drawn."""
        return mjcf.compile(self.scene())

    def pictured(self, episodes: Any, i: int) -> tuple[mujoco.MjModel, mujoco.MjData]:
        """The scene with the parameters of episode i."""
        if self._drawn is None:
            model = self.visual_model()
            self._drawn = model, mujoco.MjData(model)
        memory = episodes.memory
        self.configure(self._drawn[0], {name: memory[name][i] for name in self.parameters})
        return super().pictured(episodes, i)

    def ended(self, numbers: Numbers) -> NDArray[np.bool_]:
        """Success ends an episode."""
        return self.succeeded(numbers)

    @abstractmethod
    def expert(self, numbers: Numbers) -> Array:
        """The action (n, k) of a script that knows what the observation says, and no more."""


def add_force_sensor(spec: mujoco.MjSpec, name: str, body: str) -> None:
    """Feels all contacts of a body and of what hangs on it.

    Its rows: how many, then the force (3) [N] on what is touched, world axes.
    """
    sensor = spec.add_sensor(
        name=name,
        type=mujoco.mjtSensor.mjSENS_CONTACT,
        objtype=mujoco.mjtObj.mjOBJ_XBODY,
        objname=body,
    )
    found, force = mujoco.mjtConDataField.mjCONDATA_FOUND, mujoco.mjtConDataField.mjCONDATA_FORCE
    sensor.intprm[:3] = [(1 << int(found)) | (1 << int(force)), 3, 1]  # data, net force, one of it


def stiffen_fingers(spec: mujoco.MjSpec) -> None:
    """Stops of fingers and their pads hold: as MuJoCo has them they give, and fingers meet.

    A side load of 600 N on one of two closed fingers took up the 10 mm between them.
    """
    for joint in spec.joints:
        if "_grip_" in joint.name or "_pad_" in joint.name:
            joint.solref_limit = [STOP, 1.0]


def euler_quat(roll: float, pitch: float, yaw: float) -> Array:
    """(4) of turns about the fixed axes x, then y, then z [rad]."""
    quat = np.zeros(4)
    mujoco.mju_euler2Quat(quat, np.array([roll, pitch, yaw]), "XYZ")
    return quat


def view(
    lookat: tuple[float, float, float], distance: float, azimuth: float, elevation: float
) -> mujoco.MjvCamera:
    """A free camera: [m], [m], [degrees], [degrees]."""
    camera = mujoco.MjvCamera()
    camera.type = mujoco.mjtCamera.mjCAMERA_FREE
    camera.lookat[:] = lookat
    camera.distance, camera.azimuth, camera.elevation = distance, azimuth, elevation
    return camera


def resize_box(model: mujoco.MjModel, name: str, half: Sequence[float] | Array) -> None:
    """Gives a box, alone on its body, other half sizes (3) [m], and MuJoCo's bounds with them."""
    geom = model.geom(name)
    geom.size[:] = half
    model.geom_rbound[geom.id], model.geom_aabb[geom.id, 3:] = np.linalg.norm(half), half
    model.bvh_aabb[model.body_bvhadr[int(geom.bodyid[0])], 3:] = half


def box_mark(
    scene: mujoco.MjvScene,
    place: Array,
    half: Array,
    rotation: Array,
    color: tuple[float, float, float, float],
) -> None:
    """Draws a box: centre [m], half sizes [m], rotation (3, 3); nothing where the scene is full."""
    if scene.ngeom >= scene.maxgeom:
        return
    mujoco.mjv_initGeom(
        scene.geoms[scene.ngeom],
        mujoco.mjtGeom.mjGEOM_BOX,
        np.asarray(half, float),
        np.asarray(place, float),
        np.asarray(rotation, float).ravel(),
        np.array(color, np.float32),
    )
    scene.ngeom += 1
