"""Hurcules/Lift-v0: two arms are driven under a person and lift him off the ground."""

from __future__ import annotations

import math
from collections.abc import Mapping
from types import MappingProxyType
from typing import Any, ClassVar

import mujoco
import numpy as np
from numpy.typing import NDArray

import hurcules
from hurcules import lift
from hurcules_envs.contact import ContactEnvironment, add_force_sensor, view
from hurcules_envs.environment import Array, Group, Numbers, Start
from hurcules_envs.harm import Contacts, harm
from hurcules_envs.loose import limp_person

__all__ = ["Lift"]

PLACE = (2.30, 0.0)  # [m] of the person's centre from the knee axis: tips clear of the nearer hand
SETTLING = 1.5  # [s] until the robot stands and the person lies still
SPEED, PITCH_RATE = 0.2, 0.3  # [m/s], [rad/s] full scale of hands, tracks and pitch
YAW_RATE = 0.2  # [rad/s]
MOST = 20.0  # [N] full scale of the press
COMPLIANCE, DOWN = 0.005, 0.025  # [m/s/N] of the press, [m/s] its largest speed
RAISED, HOLD = 0.15, 2.0  # [m], [s]
GROUND = 0.15  # share of the weight with which he still lies, as in the mission's phase `look`
LOST = 1.0  # [m] between tips and person, along the ground


class Lift(ContactEnvironment):
    """The rescue robot drives its arms under a limp person and lifts him by friction alone.

    The person lies on the back across the way, the tips of the arms before him. What the mission
    `lift` commands in its phases `press` to `lift` is the action here: the tips want to be pressed
    on the ground, driven under him beyond his centre, and raised and pitched up. Mass (50 to
    120 kg), friction of his clothes on the ground (0.4 to 0.9), place and heading differ between
    episodes, the robot does not. An episode ends with success when his centre was 0.15 m above
    where it lay for 2 s, with less than 15 % of his weight on the ground: feet that hang down
    touch it.

    Actions, in [-1, 1]; zero holds:

    | index | name | scale | unit | what |
    |---|---|---|---|---|
    | 0 | ahead | 0.2 | m/s | both hands, forward |
    | 1 | left | 0.2 | m/s | both hands, to the left |
    | 2 | up | 0.2 | m/s | both hands |
    | 3 | pitch | 0.3 | rad/s | both blades, tips up |
    | 4 | press | 20 | N | that each tip presses on the ground, 0 or less: none |
    | 5 | speed | 0.2 | m/s | of the tracks |
    | 6 | yaw | 0.2 | rad/s | of the tracks |

    Observation, in the robot's axes (ahead, left, up):

    | index | name | bound | unit | what |
    |---|---|---|---|---|
    | 0-2 | centre | 5 | m | from the middle between the tips to the person's centre |
    | 3 | heading | 4 | rad | of his body, 0: square across the way, head to the left |
    | 4 | raised | 2 | m | his centre above where it lay |
    | 5 | lying | 2 |  | share of his weight on the ground; 0 at first, he starts 2 mm above it |
    | 6-7 | forces | 2000 | N | that the left and the right arm bear, negative: press down |
    | 8-9 | height | 2 | m | of the left and the right tip above the ground |
    | 10-11 | tilt | 2 | rad | of the left and the right blade, tip up |
    | 12 | mass | 200 | kg | of the person |

    Reward:

    | term | what |
    |---|---|
    | under | minus the distance of the person's centre to 0.15 m behind the tips [m] |
    | raised | his height over 0.15 m, at most 1, while less than 15 % of his weight lies |
    | harm | minus 0.1 a second times what contacts and the head (10 g) have over their limits |
    | success | 10 once |

    Success is the lift, and `harmless` in `info` tells it apart: 1 as long as no contact of the
    robot passed the limit of its region of the body (ISO/TS 15066, as long as more than 15 % of the
    weight is on the ground) and the head no 10 g. Both are looked at at the end of each step.
    `info` has `contact_share`, the largest force over its limit, `support_n`, the largest force on
    a region of who is carried, and `head_mps2`, gravity included, now, and `contact_share_most` and
    `head_mps2_most` of the episode; `cost` is 1 where a limit is passed.
    """

    body = "rescue"
    hanging = 0.02  # hands go 0.2 m/s and hardly swing; the lift leads 18 mm from a track
    clear: ClassVar[Mapping[str, float]] = MappingProxyType(
        # scoops; and the lift leads upper arms down to 50 mm
        {"L_larm": 0.0, "R_larm": 0.0, "L_uarm": 0.02, "R_uarm": 0.02}
    )
    task_description = "Drive the arms under the person and lift him off the ground."
    terms = ("under", "raised", "harm", "success")
    observation = (
        Group("centre", 3, "m", 5.0, "from the middle between the tips to the person's centre"),
        Group("heading", 1, "rad", 4.0, "of his body, 0: square across the way"),
        Group("raised", 1, "m", 2.0, "his centre above where it lay"),
        Group("lying", 1, "", 2.0, "share of his weight on the ground"),
        Group("forces", 2, "N", 2000.0, "that the arms bear, negative: press down"),
        Group("height", 2, "m", 2.0, "of the tips above the ground"),
        Group("tilt", 2, "rad", 2.0, "of the blades, tip up"),
        Group("mass", 1, "kg", 200.0, "of the person"),
    )
    memory: Mapping[str, int] = MappingProxyType(
        {"mass": 1, "friction": 1, "lay": 1, "held": 1, "done": 1, "fresh": 1}
        | dict.fromkeys(("share", "support", "head", "most_share", "most_head"), 1)
    )
    parameters = ("mass", "friction")
    beside: Mapping[str, float | Array] = MappingProxyType({"drive": np.array([SPEED, YAW_RATE])})
    components: Mapping[str, tuple[str, ...]] = MappingProxyType(
        {
            "hands": ("ahead", "left", "up"),
            "pitch": ("pitch",),
            "press": ("press",),
            "tracks": ("speed", "yaw"),
        }
    )
    quantities: tuple[str, ...] = (
        "position/L_tcp", "position/R_tcp", "matrix/L_tcp", "matrix/R_tcp",
        "position/casualty_thorax", "position/casualty_pelvis", "sensor/casualty_centre",
        "sensor/casualty_lies", "sensor/L_feel", "sensor/R_feel",
    )  # fmt: skip

    def _build(self, model: mujoco.MjModel, tick: float) -> None:
        tracks = ("m/s", "rad/s")
        self.units = {
            "hands": "m/s", "pitch": "rad/s", "press": "N", "tracks": tracks, "drive": tracks,
        }  # fmt: skip
        self.actions = {
            "hands": SPEED, "pitch": PITCH_RATE, "press": MOST,
            "tracks": np.array([SPEED, YAW_RATE]),
        }  # fmt: skip
        robot = hurcules.Robot(model)
        robot.set_keyframe("stretch")
        robot.stand_on(lift.SUPPORT)
        q, names = robot.configuration, robot.coordinate_names
        for name, angle in lift.START.items():
            for joint in {name, f"L{name}", f"R{name}"} & set(names):
                q[names.index(joint)] = angle
        robot.set_configuration(q)
        settled = self._loop(robot, tick, safe=False)
        settled.step(round(SETTLING / tick))
        start = hurcules.Robot(model)
        start.set_qpos(settled.data.qpos)
        start.stand_on(lift.SUPPORT)
        self.simulation = self._loop(start, tick, safe=self.safe)
        self._person = limp_person(model, settled.data.qpos)
        self.quantities = (*self.quantities, *self._contacts.quantities)

    def scene(self) -> mujoco.MjSpec:
        """The robot before a person who lies across its way."""
        spec = lift.spec(lift.Person(offset=(PLACE[0] - lift.DISTANCE, PLACE[1])))
        for side in "LR":
            add_force_sensor(spec, f"{side}_feel", f"{side}_larm")
        spec.add_sensor(
            name="casualty_centre",
            type=mujoco.mjtSensor.mjSENS_SUBTREECOM,
            objtype=mujoco.mjtObj.mjOBJ_BODY,
            objname="casualty_pelvis",
        )
        lies = spec.add_sensor(
            name="casualty_lies",
            type=mujoco.mjtSensor.mjSENS_CONTACT,
            objtype=mujoco.mjtObj.mjOBJ_XBODY,
            objname="casualty_pelvis",
            reftype=mujoco.mjtObj.mjOBJ_GEOM,
            refname="floor",
        )
        found, force = (
            mujoco.mjtConDataField.mjCONDATA_FOUND,
            mujoco.mjtConDataField.mjCONDATA_FORCE,
        )
        lies.intprm[:3] = [(1 << int(found)) | (1 << int(force)), 3, 1]
        self._contacts = Contacts(spec)
        return spec

    def _loop(self, plan: hurcules.Robot, tick: float, *, safe: bool) -> Any:
        limits = hurcules.JointLimits("joint", plan)
        for name, (lower, upper) in hurcules.mode_ranges("rescue_ready").items():
            limits.set_range(name, lower, upper)
        hands = [hurcules.PositionTask(f"{side}_hand", plan, f"{side}_tcp") for side in "LR"]
        for hand in hands:
            hand.max_lead = 0.1
        pitch = [hurcules.AngleTask(f"{side}_pitch", plan, f"{side}_tcp") for side in "LR"]
        pelvis = hurcules.PositionTask("pelvis", plan, "pelvis", axes=[[1.0, 0.0, 0.0]])
        neck = hurcules.PostureTask("neck", plan, ["NKY", "NKP"])
        controller = self.controller(
            plan,
            [limits, hands, pitch, pelvis, neck],
            {task.name: hurcules.Twist(task, math.inf) for task in [*hands, *pitch]}
            | {"drive": hurcules.Drive(speed=1.0, yaw_rate=0.5)},
            dt=tick,
            safe=safe,
            support=lift.SUPPORT,
            drive=hurcules.DriveOptions(),
        )
        return self.loop(controller)

    def configure(self, model: mujoco.MjModel, values: Mapping[str, Array]) -> None:
        """Mass of the person, friction of his clothes."""
        self._person.configure(model, float(values["mass"][0]), float(values["friction"][0]))

    def command(self, action: Mapping[str, Array], numbers: Numbers) -> Mapping[str, Array]:
        """Both hands and blades alike; a press adds what its error wants to the way down."""
        if self.action == "joint":
            return action
        wanted = np.maximum(action["press"], 0.0)
        down = np.clip(COMPLIANCE * (wanted + self._forces(numbers)), -DOWN, DOWN)
        down = np.where(wanted > 0.0, down, 0.0)
        left, right = action["hands"].copy(), action["hands"].copy()
        left[:, 2] -= down[:, 0]
        right[:, 2] -= down[:, 1]
        return {
            "L_hand": left, "R_hand": right, "L_pitch": action["pitch"],
            "R_pitch": action["pitch"], "drive": action["tracks"],
        }  # fmt: skip

    def start(self, generator: np.random.Generator) -> Start:
        """A person near where the approach ends."""
        ahead, left = generator.uniform([-0.05, -0.10], [0.10, 0.10])
        yaw = generator.uniform(-0.10, 0.10)
        qpos = np.array(self.simulation.data.qpos)
        self._person.place(qpos, ahead, left, yaw)
        drawn = {"mass": generator.uniform(50.0, 120.0), "friction": generator.uniform(0.4, 0.9)}
        places = {"ahead": float(ahead), "left": float(left), "yaw": float(yaw)}
        return Start(qpos, drawn | {"lay": self._person.centre[2]}, drawn | places)

    def remember(self, numbers: Numbers) -> None:
        """For how long he has been held, and what was done to him."""
        memory, lying = numbers.memory, self._lying(numbers)
        memory["share"][:, 0] = self._contacts.share(numbers, lying)
        memory["support"][:, 0] = self._contacts.support(numbers, lying)
        memory["head"][:, 0] = self._contacts.head(numbers)
        for name in ("share", "head"):
            most = memory[f"most_{name}"]
            np.maximum(most, memory[name], out=most)
        numbers.hold(self._up(numbers), HOLD)

    def observe(self, numbers: Numbers) -> dict[str, Array]:
        """See the table."""
        left, right = numbers["position/L_tcp"], numbers["position/R_tcp"]
        aside, ahead = self._axes(numbers)
        body = numbers["position/casualty_thorax"] - numbers["position/casualty_pelvis"]
        along, across = (body * ahead).sum(1), (body * aside).sum(1)
        return {
            "centre": self._centres(numbers),
            "heading": np.arctan2(-along, across)[:, None],
            "raised": self._raised(numbers)[:, None],
            "lying": self._lying(numbers)[:, None],
            "forces": self._forces(numbers),
            "height": np.stack([left[:, 2], right[:, 2]], axis=1),
            "tilt": np.stack(
                [
                    np.arcsin(np.clip(numbers[f"matrix/{side}_tcp"][:, 6], -1.0, 1.0))
                    for side in "LR"
                ],
                axis=1,
            ),
            "mass": numbers["mass"],
        }

    def reward(self, numbers: Numbers) -> dict[str, Array]:
        """See the table."""
        shaped = 0.0 if self.sparse else 1.0
        centre = self._centres(numbers)
        share = np.clip(self._raised(numbers) / RAISED, 0.0, 1.0)
        return {
            "under": -shaped * np.hypot(centre[:, 0] + 0.15, centre[:, 1]),
            "raised": shaped * np.where(self._lying(numbers) < GROUND, share, 0.0),
            "harm": -0.1 * shaped * numbers.dt * self._harm(numbers),
            "success": 10.0 * numbers["fresh"][:, 0],
        }

    def costs(self, numbers: Numbers) -> NDArray[np.bool_]:
        """A limit of a contact or of the head is passed."""
        return self._harm(numbers) > 0.0

    def tell(self, numbers: Numbers) -> dict[str, Array]:
        """What is done to him, and whether any of it passed a limit."""
        most = numbers["most_share"][:, 0], numbers["most_head"][:, 0]
        return {
            "contact_share": numbers["share"][:, 0],
            "contact_share_most": most[0],
            "support_n": numbers["support"][:, 0],
            "head_mps2": numbers["head"][:, 0],
            "head_mps2_most": most[1],
            "harmless": (harm(*most) == 0.0).astype(float),
        }

    def succeeded(self, numbers: Numbers) -> NDArray[np.bool_]:
        """He was held for 2 s."""
        return numbers["done"][:, 0] > 0.0

    def failed(self, numbers: Numbers) -> NDArray[np.bool_]:
        """He is out of reach."""
        return np.linalg.norm(self._centres(numbers)[:, :2], axis=1) > LOST

    def expert(self, numbers: Numbers) -> Array:
        """Faces him, presses, drives under, raises: the phases of the mission by what is seen."""
        seen = self.observe(numbers)
        ahead, left = seen["centre"][:, 0], seen["centre"][:, 1]
        height = seen["height"].min(axis=1)
        before = ahead > 0.42  # nobody is touched yet
        faces = before & (np.abs(left + 0.02) > 0.02)
        presses = (seen["forces"] < -3.0).all(axis=1)
        raises = (ahead < -0.13) | ((ahead < -0.03) & (height > 0.06))
        drives = ~raises & ~faces & (presses | ~before)
        action = np.zeros((len(ahead), 7))
        action[:, 4] = np.where(raises | faces, 0.0, 5.0) / MOST
        action[:, 5] = np.where(drives, 0.10, 0.0) / SPEED
        action[:, 6] = np.where(faces, np.clip(left + 0.02, -0.1, 0.1), 0.0) / YAW_RATE
        rising = raises & (height < 0.45)
        action[:, 0] = np.where(rising, -0.006, 0.0) / SPEED
        action[:, 2] = np.where(rising, 0.06, 0.0) / SPEED
        tilting = raises & (seen["tilt"].mean(axis=1) < 0.26)
        action[:, 3] = np.where(tilting, 0.076, 0.0) / PITCH_RATE
        return np.clip(action, -1.0, 1.0)

    def camera(self) -> mujoco.MjvCamera:
        """From the front, on the side of the legs."""
        return view((1.6, -0.1, 0.6), 4.1, 128.0, -14.0)

    def _axes(self, numbers: Numbers) -> tuple[Array, Array]:
        """(n, 3) each, level: to the robot's left, and ahead."""
        aside = numbers["position/L_tcp"] - numbers["position/R_tcp"]
        aside[:, 2] = 0.0
        aside = aside / np.linalg.norm(aside, axis=1, keepdims=True)
        return aside, np.stack([aside[:, 1], -aside[:, 0], np.zeros(len(aside))], axis=1)

    def _centres(self, numbers: Numbers) -> Array:
        """(n, 3) [m] from between the tips to the person's centre, ahead, left, up."""
        aside, ahead = self._axes(numbers)
        middle = 0.5 * (numbers["position/L_tcp"] + numbers["position/R_tcp"])
        way = numbers["sensor/casualty_centre"] - middle
        return np.stack([(way * ahead).sum(1), (way * aside).sum(1), way[:, 2]], axis=1)

    def _forces(self, numbers: Numbers) -> Array:
        """(n, 2) [N] up, of the left and the right arm on what they touch."""
        return np.stack([numbers[f"sensor/{side}_feel"][:, 3] for side in "LR"], axis=1)

    def _raised(self, numbers: Numbers) -> Array:
        return numbers["sensor/casualty_centre"][:, 2] - numbers["lay"][:, 0]

    def _lying(self, numbers: Numbers) -> Array:
        """(n,) share of the weight on the ground."""
        return np.abs(numbers["sensor/casualty_lies"][:, 3]) / (9.81 * numbers["mass"][:, 0])

    def _harm(self, numbers: Numbers) -> Array:
        return harm(numbers["share"][:, 0], numbers["head"][:, 0])

    def _up(self, numbers: Numbers) -> NDArray[np.bool_]:
        return (self._raised(numbers) >= RAISED) & (self._lying(numbers) < GROUND)
