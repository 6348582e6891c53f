"""Hurcules/Rescue-v0: a mission lifts a person, and a policy corrects it."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

import mujoco
import numpy as np

from hurcules import lift
from hurcules_envs.contact import view
from hurcules_envs.environment import Array, Group, Numbers
from hurcules_envs.harm import harm
from hurcules_envs.loose import limp_person
from hurcules_envs.mission import MissionEnvironment, kept

__all__ = ["Rescue"]

TRACKS = (0.1, 0.1)  # [m/s], [rad/s] full scale of what is added
HANDS, PITCH, PRESS, JOINTS = 0.05, 0.1, 0.0125, 0.1  # [m/s], [rad/s], [m/s], [rad/s]
LED = {"lean": ("HIP",), "shoulders": ("LSP", "RSP"), "elbows": ("LEB", "REB")}


class Rescue(MissionEnvironment):
    """The mission `lift` up to `hold`, to whose commands a policy adds.

    The robot drives up to a limp person who lies 3.3 m ahead across its way, turns square to him,
    presses the tips of its arms to the ground, drives them under him, lifts him, and holds him
    before its chest for 10 s. The phases, their ends and what they do in trouble are those of
    models/missions/lift.toml; an action is added to what the present phase commands, and may ask
    for the next phase or the one before. A zero action is the mission as it stands. Mass (60 to 90
    kg), friction of the clothes (0.4 to 0.6), place (0.05 m ahead, 0.10 m aside) and heading (0.2
    rad) of the person differ between episodes.

    Actions, in [-1, 1]; zero leaves the mission as it is:

    | index | name | scale | unit | what is added, where the phase has it |
    |---|---|---|---|---|
    | 0 | speed | 0.1 | m/s | of the tracks |
    | 1 | yaw_rate | 0.1 | rad/s | of the tracks |
    | 2 | ahead | 0.05 | m/s | both hands, forward (not while the posture rules) |
    | 3 | left | 0.05 | m/s | both hands, to the left |
    | 4 | up | 0.05 | m/s | both hands (not while they press) |
    | 5 | pitch | 0.1 | rad/s | both blades, tips up |
    | 6 | press | 0.0125 | m/s | of the way down, while they press |
    | 7 | lean | 0.1 | rad/s | hip, while the posture rules: `raise`, `hold`, `lower` |
    | 8 | shoulders | 0.1 | rad/s | both, likewise |
    | 9 | elbows | 0.1 | rad/s | both, likewise |
    | 10 | phase | 1 |  | above 0.5 asks for the next phase, below -0.5 for the one before |

    A phase is asked for when the number passes 0.5, and again when it has come back before.

    Observation:

    | index | name | bound | unit | what |
    |---|---|---|---|---|
    | 0-21 | phase | 1 |  | 1 for the present one, in the order of the table |
    | 22 | progress | 1 |  | of the present phase |
    | 23-27 | person | 5 | m | behind the tips, aside, raised, moved; the stand is ahead |
    | 28-29 | tips | 5 | m | height of the left and the right one |
    | 30-31 | heading | 4 | rad | of his body against square; bearing of the stand |
    | 32-35 | weight | 2 |  | on the ground, the left arm, the right arm, the rest: shares |
    | 36-39 | force | 5000 | N | of both presses, push along the ground, largest support |
    | 40 | contact | 20 |  | largest force of a contact over the limit of its region |
    | 41 | head | 500 | m/s^2 | of his head, gravity included |
    | 42-43 | tilt | 2 | rad | of the left and the right blade, tip up |
    | 44-49 | joints | 4 | rad | KN, HIP, both shoulders (pitch), both elbows |
    | 50 | mass | 200 | kg | of the person |
    | 51 | margin | 2 | m | of the centre of mass within what the robot stands on |

    Reward:

    | term | what |
    |---|---|
    | phase | 10 times the share of the phases up to `hold` that was reached for the first time |
    | harm | minus 0.1 a second times what contacts and the head (10 g) have over their limits |
    | time | -0.01 a step |
    | effort | minus 0.01 times the mean square of the action |
    | success | 10 once |
    | failure | -5 once, -10 when the robot fell |

    Success: he was held for 10 s at least 0.3 m above where he lay, nothing of him on the ground,
    and slid by 30 mm at most. It ends the episode; so does a fall, or the end of the mission in any
    other way (lowered, backed off, aborted, time up). `info` has `phase` (its number), `furthest`,
    `contact_share`, `head_mps2`, `support_n`, `pushed_m`, `fell` and `missed`; `cost` is 1 where a
    contact passes its limit too.
    """

    task_description = "Lift the person and hold him before the chest."
    mission, last = "lift", "hold"  # the mission, and its phase in which he is held
    moved = "casualty/moved_m"
    mass, friction = (60.0, 90.0), (0.4, 0.6)
    components: Mapping[str, tuple[str, ...]] = MappingProxyType(
        {
            "tracks": ("speed", "yaw_rate"),
            "hands": ("ahead", "left", "up"),
            "pitch": ("pitch",),
            "press": ("press",),
            "lean": ("lean",),
            "shoulders": ("shoulders",),
            "elbows": ("elbows",),
            "phase": ("phase",),
        }
    )
    quantities = (
        "phase", "mission/progress", "casualty/behind_tips_m", "casualty/aside_m",
        "casualty/height_m", "casualty/moved_m", "casualty/stand_ahead_m", "casualty/heading_rad",
        "casualty/stand_rad", "casualty/on_ground", "casualty/on_left_arm",
        "casualty/on_right_arm", "casualty/on_rest", "mission/force/L_press",
        "mission/force/R_press", "casualty/push_n", "casualty/support_n",
        "casualty/contact_share", "casualty/head_mps2", "position/L_tcp", "position/R_tcp",
        "matrix/L_tcp", "matrix/R_tcp", "q/KN", "q/HIP", "q/LSP", "q/RSP", "q/LEB", "q/REB",
        "monitor/static_margin_m",
    )  # fmt: skip

    def _build(self, model: mujoco.MjModel, tick: float) -> None:
        self.units = {
            "tracks": ("m/s", "rad/s"), "hands": "m/s", "pitch": "rad/s", "press": "m/s",
            "lean": "rad/s", "shoulders": "rad/s", "elbows": "rad/s",
        }  # fmt: skip
        self.actions = {
            "tracks": np.array(TRACKS), "hands": HANDS, "pitch": PITCH, "press": PRESS,
            "lean": JOINTS, "shoulders": JOINTS, "elbows": JOINTS, "phase": 1.0,
        }  # fmt: skip
        phases = kept(lift.mission(self.mission), self.last, without=lift.ON_THE_FRONT)
        self.adopt(phases, model, lift.controller, self.last, LED)
        self.fetched = limp_person(model, self.simulation.data.qpos)
        self.observation = (
            Group("phase", len(self._phases), "", 1.0, "1 for the present one"),
            Group("progress", 1, "", 1.0, "of the present phase"),
            Group("person", 5, "m", 5.0, "behind the tips, aside, raised, moved; the stand"),
            Group("tips", 2, "m", 5.0, "height of the left and the right one"),
            Group("heading", 2, "rad", 4.0, "of his body against square; bearing of the stand"),
            Group("weight", 4, "", 2.0, "on the ground, the left arm, the right arm, the rest"),
            Group("force", 4, "N", 5000.0, "of both presses, push, largest support"),
            Group("contact", 1, "", 20.0, "largest force of a contact over its limit"),
            Group("head", 1, "m/s^2", 500.0, "of his head, gravity included"),
            Group("tilt", 2, "rad", 2.0, "of the blades, tip up"),
            Group("joints", 6, "rad", 4.0, "KN, HIP, both shoulders, both elbows"),
            Group("mass", 1, "kg", 200.0, "of the person"),
            Group("margin", 1, "m", 2.0, "of the centre of mass within what it stands on"),
        )

    def scene(self) -> mujoco.MjSpec:
        """The robot, and a person 3.3 m ahead."""
        return lift.spec(lift.Person())

    def command(self, action: Mapping[str, Array], numbers: Numbers) -> Mapping[str, Array]:
        """What is added to the channels; those of tasks that do not rule are not asked."""
        given: dict[str, Array] = {"drive": action["tracks"]}
        for side in "LR":
            given[f"{side}_hand"] = action["hands"]
            given[f"{side}_across"] = action["hands"][:, :2]
            given[f"{side}_press"] = -action["press"]
            given[f"{side}_pitch"] = action["pitch"]
        return given | self.joint_rates(action, numbers)

    def observe(self, numbers: Numbers) -> dict[str, Array]:
        """See the table."""
        tips = [numbers[f"position/{side}_tcp"][:, 2] for side in "LR"]
        up = [np.clip(numbers[f"matrix/{side}_tcp"][:, 6], -1.0, 1.0) for side in "LR"]
        casualty = [
            f"casualty/{name}"
            for name in ("behind_tips_m", "aside_m", "height_m", "moved_m", "stand_ahead_m")
        ]
        return {
            "phase": self.one_of_the_phases(numbers),
            "progress": numbers["mission/progress"],
            "person": numbers.row(*casualty),
            "tips": np.stack(tips, axis=1),
            "heading": numbers.row("casualty/heading_rad", "casualty/stand_rad"),
            "weight": numbers.row(
                "casualty/on_ground", "casualty/on_left_arm", "casualty/on_right_arm",
                "casualty/on_rest",
            ),
            "force": numbers.row(
                "mission/force/L_press", "mission/force/R_press", "casualty/push_n",
                "casualty/support_n",
            ),
            "contact": numbers["casualty/contact_share"],
            "head": numbers["casualty/head_mps2"],
            "tilt": np.arcsin(np.stack(up, axis=1)),
            "joints": numbers.row("q/KN", "q/HIP", "q/LSP", "q/RSP", "q/LEB", "q/REB"),
            "mass": numbers["mass"],
            "margin": numbers["monitor/static_margin_m"],
        }  # fmt: skip

    def harm(self, numbers: Numbers) -> Array:
        """Of contacts on his body, and 10 g of his head."""
        return harm(numbers["casualty/contact_share"][:, 0], numbers["casualty/head_mps2"][:, 0])

    def tell(self, numbers: Numbers) -> dict[str, Array]:
        """What was done to him too."""
        return {
            **super().tell(numbers),
            "contact_share": numbers["casualty/contact_share"][:, 0],
            "head_mps2": numbers["casualty/head_mps2"][:, 0],
            "support_n": numbers["casualty/support_n"][:, 0],
        }

    def camera(self) -> mujoco.MjvCamera:
        """From the front, on the side of the legs."""
        return view((1.9, 0.0, 0.75), 4.8, 128.0, -14.0)
