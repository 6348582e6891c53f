"""What comes before the hands: the robot stands, and keeps away from itself and from the ground.

The levels are the same in all environments. Their pairs of parts are found once a robot, alone on
flat ground; in a scene the same pairs keep their distances, as the robot stands there.
"""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Mapping, Sequence
from copy import copy
from dataclasses import dataclass, replace
from functools import cached_property
from types import MappingProxyType
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

import hurcules

__all__ = ["FIRM", "STANDS", "TIPS", "Safety", "on_tracks", "support_polygon"]

Array = NDArray[np.float64]

TRACK = 1  # contype of the tracks' geoms
STANDS = 0.10  # [m] of the centre of mass within the contacts
TIPS = 0.08  # [m] of the zero moment point within them
# [m] kept between parts, and from the ground: the lower arms of the rescue robot hang in springs
# that give by 0.13 rad where they swing (0.2 at most), which no encoder of a motor sees
APART = {"rescue": 0.12, "manipulation": 0.03}
# [m] the same of its parts that hang in none; less than half of that is left where rows of trunk
# and legs cannot all be kept at once
FIRM = {"rescue": 0.06}
# [m] beyond that, pairs do not count: hands come at 1.6 m/s, firm parts more slowly
LOOK, FIRM_LOOK = 0.20, 0.10
# points of pairs that count at a time. Firm parts have their own: a dozen are always near, and
# among them a hand was seen when it could stop no more
ROWS, FIRM_ROWS, HANGING_ROWS, GROUND_ROWS = 24, 12, 16, 6
NO_OTHERS: Mapping[str, float] = MappingProxyType({})
SWINGS = " in springs"  # ends the names of such distances


@dataclass(frozen=True)
class _Kept:
    """Pairs of one kind, and what they keep."""

    name: str
    pairs: Sequence[tuple[str, str]]
    margin: float
    look: float
    rows: int

    def task(self, robot: hurcules.Robot) -> hurcules.DistanceTask:
        """The distances of a robot as it stands."""
        most = self.margin + self.look
        return hurcules.DistanceTask(
            self.name, robot, self.pairs, self.margin, most, self.rows, as_it_stands=True
        )


class Safety:
    """The levels of one robot, after its limits.

    Attributes:
        apart_by: [m] that its parts keep from each other and from the ground; less where FIRM says
            so.
    """

    def __init__(
        self, name: str, model: mujoco.MjModel, robot: hurcules.Robot, support: str
    ) -> None:
        """Takes a robot as it stands, alone on its ground.

        Args:
            name: "rescue", "manipulation" or another.
            model: of the robot.
            robot: where it stands.
            support: body that it stands on, "" for a fixed base.
        """
        self._name, self._model, self._robot, self._support = name, model, robot, support
        self.apart_by = APART.get(name, 0.02)

    def levels(self, robot: hurcules.Robot) -> list[Any]:
        """Within its support, away from itself and the ground; for a robot of the same model."""
        kept = [copy(task) for task in self._tasks]
        if not self._support:
            return [kept]
        polygon, height = support_polygon(self._model, self._robot, self._support)
        return [*_standing(robot, polygon, self._support, height, STANDS, TIPS), kept]

    def levels_in_scene(
        self,
        model: mujoco.MjModel,
        plan: hurcules.Robot,
        clear: Mapping[str, float] = NO_OTHERS,
        hanging: float | None = None,
        within: tuple[float, float] = (STANDS, TIPS),
    ) -> list[Any]:
        """The same in a scene. What is nearer than its margin there keeps half of what it has.

        Args:
            model: the scene.
            plan: the robot in it, where it stands.
            clear: by body what it and all that hangs on it keep from the ground [m], but for what
                hangs on another one of these; 0: nothing.
            hanging: [m] that parts in springs keep from the tracks, where they swing less; None:
                `apart_by`.
            within: [m] that centre of mass and zero moment point keep within the contacts.
        """
        polygon, height = support_polygon(model, plan, self._support)
        room = 0.5 * _room(plan, polygon, self._support)
        margins = (min(margin, room) for margin in within)
        standing = _standing(plan, polygon, self._support, height, *margins)
        return [*standing, self.distances_in_scene(model, plan, clear, hanging)]

    def distances_in_scene(
        self,
        model: mujoco.MjModel,
        plan: hurcules.Robot,
        clear: Mapping[str, float] = NO_OTHERS,
        hanging: float | None = None,
        of: tuple[str, ...] = (),
    ) -> list[hurcules.DistanceTask]:
        """The last of these levels, see `levels_in_scene`.

        Args:
            model: the scene.
            plan: the robot in it, where it stands.
            clear: as there.
            hanging: as there.
            of: bodies; only pairs with a part of them, or of what hangs on them, count. Empty: all.
        """
        kept: list[_Kept] = []
        moved = {int(model.body(name).id) for name in of}
        for one in self._kept if hanging is None else self._beside_tracks(hanging):
            # parts that are not mounted here are left out
            ids = {pair: [_geom(model, name) for name in pair] for pair in one.pairs}
            if moved:
                ids = {p: both for p, both in ids.items() if _on(model, both) & moved}
            bodies = {pair: _grounded(model, both) for pair, both in ids.items() if min(both) >= 0}
            by_id = {int(model.body(name).id): name for name in clear}
            # of a pair the named body that is nearest to its part
            owner = {p: max(chain & by_id.keys(), default=0) for p, chain in bodies.items()}
            own = {
                name: [p for p, body in owner.items() if by_id.get(body) == name] for name in clear
            }
            others = [p for p, body in owner.items() if not body]
            kept.append(replace(one, pairs=others))
            kept += [
                replace(one, name=f"{one.name} of {name}", pairs=pairs, margin=clear[name])
                for name, pairs in own.items()
                if clear[name] > 0.0
            ]
        return [one.task(plan) for one in kept if one.pairs]

    def _beside_tracks(self, margin: float) -> Iterator[_Kept]:
        """What is kept, where parts in springs keep another margin [m] from the tracks."""
        model = self._model
        tracks = {model.geom(i).name for i in np.flatnonzero(model.geom_contype == TRACK)}
        for one in self._kept:
            if not one.name.endswith(SWINGS):
                yield one
                continue
            beside = [pair for pair in one.pairs if tracks & set(pair)]
            yield replace(one, pairs=[pair for pair in one.pairs if pair not in beside])
            yield replace(one, name=f"{one.name} beside tracks", pairs=beside, margin=margin)

    def apart(self) -> hurcules.DistanceTask:
        """Parts of the robot keep away from each other, all by `apart_by`."""
        return copy(self._found[0])

    @cached_property
    def _found(self) -> tuple[hurcules.DistanceTask, hurcules.DistanceTask]:
        """From itself, and from the ground; their pairs are found once."""
        robot, margin = self._robot, self.apart_by
        apart = hurcules.self_collision(
            robot, margin=margin, most=margin + LOOK, rows=ROWS, postures=2000
        )
        with warnings.catch_warnings():  # it stands on its tracks
            warnings.filterwarnings("ignore", "obstacles leaves out what touches now")
            return apart, hurcules.obstacles(robot, margin=margin, most=margin + LOOK)

    @cached_property
    def _tasks(self) -> list[hurcules.DistanceTask]:
        """What is kept where it stands."""
        if self._name not in FIRM:
            return list(self._found)
        return [one.task(self._robot) for one in self._kept]

    @cached_property
    def _kept(self) -> list[_Kept]:
        """The same; of parts that hang in springs and of firm ones, each with rows of its own."""
        robot = self._robot
        apart, clear = self._found
        if self._name not in FIRM:
            return [
                _Kept(one.name, one.pairs(robot), self.apart_by, LOOK, rows)
                for one, rows in ((apart, ROWS), (clear, HANGING_ROWS))
            ]
        model, firm = self._model, FIRM[self._name]
        # firm parts that ever come near
        few = hurcules.self_collision(robot, margin=0.0, most=firm, postures=2000)
        hang = {i for i in range(model.ngeom) if _hangs(model, model.geom_bodyid[i])}

        def kept(found: hurcules.DistanceTask, hangs: bool, rows: int) -> _Kept:
            ids = {pair: {model.geom(name).id for name in pair} for pair in found.pairs(robot)}
            pairs = [pair for pair, both in ids.items() if bool(both & hang) == hangs]
            name = found.name + SWINGS if hangs else found.name
            margin, look = (self.apart_by, LOOK) if hangs else (firm, FIRM_LOOK)
            return _Kept(name, pairs, margin, look, rows)

        return [
            kept(few, False, FIRM_ROWS),
            kept(apart, True, HANGING_ROWS),
            kept(clear, False, GROUND_ROWS),
            kept(clear, True, GROUND_ROWS),
        ]


def support_polygon(
    model: mujoco.MjModel, robot: hurcules.Robot, support: str
) -> tuple[Array, float]:
    """(4, 2) [m] around the contacts of its tracks where it stands, and their z [m].

    In the axes of its support.

    Raises:
        hurcules.Error: no track touches anything there.
    """
    data = mujoco.MjData(model)
    data.qpos[:] = robot.qpos
    mujoco.mj_kinematics(model, data)
    mujoco.mj_collision(model, data)
    feet = data.contact.pos[on_tracks(model, data)]
    if not len(feet):
        raise hurcules.Error(
            "safe: wanted a robot that stands on its tracks, none touches the ground"
        )
    feet = (feet - robot.position(support)) @ robot.orientation(support)
    (x, y, _), (far_x, far_y, _) = feet.min(axis=0), feet.max(axis=0)
    return np.array([[x, y], [far_x, y], [far_x, far_y], [x, far_y]]), float(feet[:, 2].mean())


def on_tracks(model: mujoco.MjModel, data: mujoco.MjData) -> NDArray[np.bool_]:
    """(contacts) whether a track takes part."""
    return np.asarray((model.geom_contype[data.contact.geom] == TRACK).any(axis=1))


def _standing(
    robot: hurcules.Robot, polygon: Array, support: str, height: float, stands: float, tips: float
) -> list[Any]:
    """Centre of mass and zero moment point stay so far [m] within the polygon."""
    balance, tip = hurcules.BalanceTask, hurcules.ZeroMomentTask
    return [
        balance("balance", robot, polygon, stands, support, height),
        tip("zero moment", robot, polygon, tips, support, height),
    ]


def _room(robot: hurcules.Robot, polygon: Array, support: str) -> float:
    """[m] of the centre of mass within the polygon."""
    away = np.asarray(robot.com) - robot.position(support)
    centre = (away @ robot.orientation(support))[:2]
    low, high = polygon.min(axis=0), polygon.max(axis=0)
    return float(min((centre - low).min(), (high - centre).min()))


def _geom(model: mujoco.MjModel, name: str) -> int:
    return mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_GEOM, name)


def _grounded(model: mujoco.MjModel, pair: Sequence[int]) -> set[int]:
    """Of a pair of geoms with the ground the body of the other one, and all that bears it."""
    plane = [model.geom_type[i] == mujoco.mjtGeom.mjGEOM_PLANE for i in pair]
    if not any(plane):
        return set()
    return _above(model, int(model.geom_bodyid[pair[plane.index(False)]]))


def _on(model: mujoco.MjModel, pair: Sequence[int]) -> set[int]:
    """The bodies of a pair of geoms, and all that bears them."""
    return set().union(*(_above(model, int(model.geom_bodyid[i])) for i in pair if i >= 0))


def _above(model: mujoco.MjModel, body: int) -> set[int]:
    """A body and all that it is mounted on."""
    chain = set()
    while body:
        chain.add(body)
        body = int(model.body_parentid[body])
    return chain


def _hangs(model: mujoco.MjModel, body: int) -> bool:
    """A hinge with a spring and no motor turns it, or what it is mounted on."""
    driven = set(model.actuator_trnid[:, 0])
    chain = _above(model, int(body))
    for joint in range(model.njnt):
        hinge = model.jnt_type[joint] == mujoco.mjtJoint.mjJNT_HINGE
        sprung = hinge and model.jnt_stiffness[joint] > 0.0 and joint not in driven
        if sprung and int(model.jnt_bodyid[joint]) in chain:
            return True
    return False
