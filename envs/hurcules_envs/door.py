"""Hurcules/Door-v0: a hand opens a door, lever first."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

import hurcules
from hurcules import models
from hurcules_envs.contact import ContactEnvironment, add_force_sensor, stiffen_fingers, view
from hurcules_envs.environment import Array, Group, Numbers, Start
from hurcules_envs.standing import SUPPORT, place_hands, settle

__all__ = ["Door"]

WANTED = 0.5  # [rad]
HAND = (0.92, -0.28, 1.12)  # [m] the right tcp at the start
AJAR = 0.05  # [rad] beyond the latch
DOOR = (1.08, 0.0)  # [m] middle of the doorway, on average
CLOSED = 0.05  # [m] of the fingers
ON_LEVER = np.array([0.015, -0.015, 0.0])  # [m] from its end, where the expert presses
LEVER = 0.10  # [m] its length, to where it is pressed
MOST = 80.0  # [N] full scale of the force
# [m/s/N]; against the lever's stop the arm is as stiff as its wrist's spring, 31 kN/m
COMPLIANCE, STIFFEST = 1e-3, 3.1e4


class Door(ContactEnvironment):
    """The right hand of the manipulation robot presses the lever down and pushes the door open.

    The door of 0.85 m opens away from the robot and hangs on the left; a latch holds it until the
    lever is down, a closer pushes it shut. The hand keeps its orientation, fingers closed and
    ahead. It feels what it touches: in contact it keeps the force downward that is asked for.
    Place, closer, spring of the lever and friction differ between episodes, the robot does not.
    Success, 0.5 rad, ends an episode.

    Actions, in [-1, 1]; zero holds the hand, and asks for no force:

    | index | name | scale | unit | what |
    |---|---|---|---|---|
    | 0 | across_0 | 0.2 | m/s | reference of the hand, forward |
    | 1 | across_1 | 0.2 | m/s | to the left |
    | 2 | down | 0.2 | m/s | down, where nothing is touched |
    | 3 | force | 80 | N | that the hand presses down with, where it touches |

    Observation, in the world's axes (x forward, y left, z up):

    | index | name | bound | unit | what |
    |---|---|---|---|---|
    | 0-2 | hand | 2 | m | from the end of the lever to the hand (tcp) |
    | 3-5 | velocity | 2 | m/s | of the hand |
    | 6-8 | lead | 0.5 | m | reference minus hand |
    | 9 | lever | 2 | rad | how far it is down, of 0.9 |
    | 10 | door | 2 | rad | how far it is open |
    | 11 | rate | 10 | rad/s | of the door |
    | 12 | reading | 500 | N | what the hand feels from below |
    | 13 | force | 2000 | N | sum of the normal forces on the hand |

    Reward:

    | term | what |
    |---|---|
    | distance | minus the distance of the hand to the lever [m], while the door is shut |
    | lever | 0.5 times the angle of the lever in this step [rad], while the door is shut |
    | door | 10 times the angle that the door opens in this step [rad] |
    | success | 10 once |
    """

    task_description = "Open the door: press the lever down and push."
    terms = ("distance", "lever", "door", "success")
    observation = (
        Group("hand", 3, "m", 2.0, "from the end of the lever to the hand"),
        Group("velocity", 3, "m/s", 2.0, "of the hand"),
        Group("lead", 3, "m", 0.5, "reference minus hand"),
        Group("lever", 1, "rad", 2.0, "how far it is down"),
        Group("door", 1, "rad", 2.0, "how far it is open"),
        Group("rate", 1, "rad/s", 10.0, "of the door"),
        Group("reading", 1, "N", 500.0, "what the hand feels from below"),
        Group("force", 1, "N", 2000.0, "sum of the normal forces on the hand"),
    )
    memory: Mapping[str, int] = MappingProxyType(
        {"place": 2, "closer": 1, "spring": 1, "friction": 1}
        | {"lever": 1, "door": 1, "down": 1, "opened": 1, "fresh": 1}
    )
    parameters = ("place", "closer", "spring", "friction")
    quantities = (
        "position/R_tcp", "velocity/R_tcp", "target/across", "value/across", "target/down",
        "value/down", "position/door_lever_near", "joint/door_lever", "joint/door_hinge",
        "joint_velocity/door_hinge", "force/down", "contact_force/R_hand",
    )  # fmt: skip

    def _build(self, model: mujoco.MjModel, tick: float) -> None:
        self.units = {"across": "m/s", "down": "m/s", "force": "N"}
        self.actions = {"across": 0.2, "down": 0.2, "force": MOST}
        plan = place_hands(model, {"R": np.array(HAND)}, {"R_grip_1": CLOSED, "R_grip_2": CLOSED})
        rest = settle(self._loop(plan, tick, safe=False))
        self.simulation = self._loop(rest, tick, safe=self.safe)

    def scene(self) -> mujoco.MjSpec:
        """The robot stands before a door that can be moved as a whole."""
        spec = models.parse([models.path("manipulation"), models.path("flat")], "door")
        child = mujoco.MjSpec.from_file(str(models.folder() / "objects" / "door.xml"))
        body = spec.worldbody.add_body(name="door", pos=[*DOOR, 0.0])
        spec.attach(child, prefix="door_", frame=body.add_frame())
        add_force_sensor(spec, "R_feel", "R_hand")
        stiffen_fingers(spec)
        return spec

    def _loop(self, plan: hurcules.Robot, tick: float, *, safe: bool) -> Any:
        across = hurcules.PositionTask("across", plan, "R_tcp", axes=[[1, 0, 0], [0, 1, 0]])
        across.max_lead = 0.1
        down = hurcules.ForceTask(
            "down", plan, "R_tcp", axis=[0.0, 0.0, -1.0], force_des=0.0, environment=STIFFEST,
            gains=hurcules.ForceGains(compliance=COMPLIANCE, dt=tick),
            contact=hurcules.ContactOptions(f_max=400.0),
        )  # fmt: skip
        down.max_lead = 0.1
        turn = hurcules.OrientationTask("turn", plan, "R_tcp")
        controller = self.controller(
            plan,
            [[across, down], turn, hurcules.PostureTask("posture", plan)],
            {
                "across": hurcules.Twist(across, 0.2),
                "down": hurcules.Twist(down, 0.2),
                "force": hurcules.ForceReference(down, MOST),
            },
            dt=tick,
            safe=safe,
            support=SUPPORT,
        )
        simulation = self.loop(controller)
        controller.sense(down, "R_feel", row=3, sign=-1.0)
        return simulation

    def configure(self, model: mujoco.MjModel, values: Mapping[str, Array]) -> None:
        """Place of the door, springs of closer and lever over their own, friction of the lever."""
        model.body("door").pos[:2] = values["place"]
        own = self.simulation.model
        for joint, name in (("door_hinge", "closer"), ("door_lever", "spring")):
            model.joint(joint).stiffness[0] = own.joint(joint).stiffness[0] * values[name][0]
        for geom in ("door_lever_near", "door_leaf"):
            model.geom(geom).friction[0] = values["friction"][0]

    def start(self, generator: np.random.Generator) -> Start:
        """A shut door before the hand."""
        place = np.array(DOOR) + generator.uniform([-0.03, -0.04], [0.04, 0.04])
        drawn = {
            "closer": generator.uniform(0.3, 1.5),
            "spring": generator.uniform(0.5, 1.5),
            "friction": generator.uniform(0.3, 0.9),
        }
        places = {"door_x": float(place[0]), "door_y": float(place[1])}
        return Start(None, {"place": place} | drawn, drawn | places)

    def remember(self, numbers: Numbers) -> None:
        """How far lever and door are, and how far they went in this step."""
        memory = numbers.memory
        lever, door = numbers["joint/door_lever"], numbers["joint/door_hinge"]
        memory["fresh"][:] = (door >= WANTED) & (memory["door"] < WANTED)
        memory["down"][:], memory["opened"][:] = lever - memory["lever"], door - memory["door"]
        memory["lever"][:], memory["door"][:] = lever, door

    def observe(self, numbers: Numbers) -> dict[str, Array]:
        """See the table."""
        lead_xy = numbers["target/across"] - numbers["value/across"]
        lead_z = numbers["value/down"] - numbers["target/down"]
        return {
            "hand": self._hand(numbers),
            "velocity": numbers["velocity/R_tcp"],
            "lead": np.concatenate([lead_xy, lead_z], axis=1),
            "lever": numbers["joint/door_lever"],
            "door": numbers["joint/door_hinge"],
            "rate": numbers["joint_velocity/door_hinge"],
            "reading": numbers["force/down"],
            "force": numbers["contact_force/R_hand"],
        }

    def reward(self, numbers: Numbers) -> dict[str, Array]:
        """See the table."""
        shaped = 0.0 if self.sparse else 1.0
        shut = numbers["joint/door_hinge"][:, 0] < AJAR
        return {
            "distance": -shaped * shut * np.linalg.norm(self._hand(numbers), axis=1),
            "lever": 0.5 * shaped * shut * numbers["down"][:, 0],
            "door": 10.0 * shaped * numbers["opened"][:, 0],
            "success": 10.0 * numbers["fresh"][:, 0],
        }

    def succeeded(self, numbers: Numbers) -> NDArray[np.bool_]:
        """The door is open by 0.5 rad."""
        return numbers["joint/door_hinge"][:, 0] >= WANTED

    def expert(self, numbers: Numbers) -> Array:
        """Over the lever, down on it, and forward once it is down."""
        seen = self.observe(numbers)
        hand, lever = seen["hand"], seen["lever"][:, 0]
        is_down = (lever > 0.76) | (seen["door"][:, 0] > AJAR)
        away = hand - ON_LEVER
        away[:, 1] -= LEVER * (1.0 - np.cos(lever))  # stays where it came down
        over = np.linalg.norm(away[:, :2], axis=1) < 0.015
        ahead = np.where(is_down, 0.15, -4.0 * away[:, 0])
        down = np.where(over | is_down, 0.1, 0.0)
        force = np.clip(300.0 * (0.93 - lever), 0.0, 70.0)  # beyond 0.9 rad it would jam
        across = [ahead / 0.2, -4.0 * away[:, 1] / 0.2]
        return np.clip(np.stack([*across, down / 0.2, force / MOST], axis=1), -1.0, 1.0)

    def camera(self) -> mujoco.MjvCamera:
        """From behind on the right, at the lever."""
        return view((1.0, -0.3, 1.05), 1.5, 60.0, -15.0)

    def _hand(self, numbers: Numbers) -> Array:
        return numbers["position/R_tcp"] - numbers["position/door_lever_near"]
