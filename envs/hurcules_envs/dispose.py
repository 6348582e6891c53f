"""Hurcules/Dispose-v0: a mission puts a case of ordnance away, and a policy corrects it."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

import mujoco
import numpy as np

from hurcules import disposal
from hurcules_envs.contact import view
from hurcules_envs.environment import Array, Group, Numbers
from hurcules_envs.loose import Loose
from hurcules_envs.mission import MissionEnvironment, kept

__all__ = ["Dispose"]

LAST = "rest"  # phase of the mission `disposal` in which the case lies in the container
TRACKS = (0.1, 0.1)  # [m/s], [rad/s] full scale of what is added
HANDS, TURN, SQUEEZE, JOINTS = 0.05, 0.1, 0.002, 0.1  # [m/s], [rad/s], [m/s], [rad/s]
LED = {
    "lean": ("HIP",),
    "shoulders": ("LSP", "RSP"),
    "elbows": ("LEB", "REB"),
    "wrists": ("LWP", "RWP"),
    "waist": ("WST",),
}
KNOCK, SINKING = 50.0, 0.5  # [N], [m/s] limits of the mission: what goes wrong, and success
SEEN = ("LKN", "RKN", "HIP", "WST", "LSP", "RSP", "LEB", "REB", "LWP", "RWP")
PLACE = ("ahead_m", "aside_m", "stand_ahead_m", "hands_ahead_m", "hands_aside_m")
BARS = tuple(
    f"load/{side}_hand_{way}_m" for side in ("left", "right") for way in ("ahead", "aside", "up")
)
WEIGHT = ("on_ground", "on_left_hand", "on_right_hand", "on_rest", "in_container")


class Dispose(MissionEnvironment):
    """The mission `disposal`, to whose commands a policy adds.

    The manipulation robot drives up to a case of ordnance 3 m ahead, stands up, takes it with both
    hands, sits down, folds its legs, carries it to a container and puts it in. The phases, their
    ends and what they do in trouble are those of models/missions/disposal.toml; an action is added
    to what the present phase commands, and may ask for the next phase or the one before. A zero
    action is the mission as it stands. Mass of the case (10 to 25 kg), friction of its bars (0.65
    to 0.9), its place (0.05 m ahead, 0.10 m aside) and heading (0.2 rad) differ between episodes.
    The cameras tell without error.

    Actions, in [-1, 1]; zero leaves the mission as it is:

    | index | name | scale | unit | what is added, where the phase has it |
    |---|---|---|---|---|
    | 0 | speed | 0.1 | m/s | of the tracks |
    | 1 | yaw_rate | 0.1 | rad/s | of the tracks |
    | 2 | ahead | 0.05 | m/s | both hands, forward (while the stack `hands` rules) |
    | 3 | left | 0.05 | m/s | both hands, to the left, likewise |
    | 4 | up | 0.05 | m/s | both hands, likewise |
    | 5 | turn | 0.1 | rad/s | both hands, to the left, likewise |
    | 6 | squeeze | 0.002 | m/s | the fingers of both hands close |
    | 7 | lean | 0.1 | rad/s | hip, while `hands` does not rule |
    | 8 | shoulders | 0.1 | rad/s | both, likewise; not behind shut brakes |
    | 9 | elbows | 0.1 | rad/s | both, likewise; not behind shut brakes |
    | 10 | wrists | 0.1 | rad/s | the pitch of both, likewise; not behind shut brakes |
    | 11 | waist | 0.1 | rad/s | likewise |
    | 12 | phase | 1 |  | above 0.5 asks for the next phase, below -0.5 for the one before |

    A phase is asked for when the number passes 0.5, and again when it has come back before.

    Observation:

    | index | name | bound | unit | what |
    |---|---|---|---|---|
    | 0-52 | phase | 1 |  | 1 for the present one, in the order of the table |
    | 53 | progress | 1 |  | of the present phase |
    | 54-58 | case | 10 | m | ahead, aside; its stand ahead; ahead and aside of the hands' middle |
    | 59-63 | container | 10 | m | the same |
    | 64-67 | heading | 4 | rad | of the case, bearing of its stand; both of the container |
    | 68-73 | bars | 10 | m | from the left hand to its bar: ahead, aside, up; from the right one |
    | 74-78 | weight | 5 |  | on the ground, left hand, right hand, the rest, in the container |
    | 79-80 | grip | 1000 | N | of the left and the right hand |
    | 81 | knock | 5000 | N | on the case by the robot, or on the container |
    | 82-84 | motion | 10 | m | of the case: raised, moved, away from a hand |
    | 85 | sinking | 10 | m/s | of the case |
    | 86 | tilt | 4 | rad | of the case |
    | 87-89 | place | 10 | m | of the case in the container: ahead, to the left, up |
    | 90-99 | joints | 7 | rad | knees, HIP, WST, shoulders (pitch), elbows, wrists (pitch) |
    | 100 | heat | 500 | degC | of the hottest motor |
    | 101 | mass | 100 | kg | of the case |
    | 102 | margin | 2 | m | of the centre of pressure within what the robot stands on |

    Reward:

    | term | what |
    |---|---|
    | phase | 10 times the share of the phases up to `rest` that was reached for the first time |
    | harm | minus 0.1 a second times the excess of knocks (50 N) and of sinking (0.5 m/s) |
    | time | -0.001 a step |
    | effort | minus 0.001 times the mean square of the action |
    | success | 10 once |
    | failure | -5 once, -10 when the robot fell |

    Success: the mission's own, but for the bounds of the fingers' force, which a control tick of
    4 ms does not keep: the case stands in the container, was not dropped, tilted or let slip, and
    the robot met nothing. It ends the episode; so does a fall, or the end of the mission in any
    other way (set down, backed off, aborted, time up). `info` has `phase` (its number),
    `furthest`, `knock_n`, `sinking_mps`, `slipped_m` (a hand from its bar), `in_container`,
    `pushed_m`, `fell` and `missed`; `cost` is 1 where a knock or sinking passes its limit too.
    """

    task_description = "Fetch the case of ordnance and put it into the container."
    moved = "load/moved_m"
    mass, friction = (10.0, 25.0), (0.65, 0.9)
    toll = 0.001
    components: Mapping[str, tuple[str, ...]] = MappingProxyType(
        {
            "tracks": ("speed", "yaw_rate"),
            "hands": ("ahead", "left", "up"),
            "turn": ("turn",),
            "squeeze": ("squeeze",),
            **{name: (name,) for name in LED},
            "phase": ("phase",),
        }
    )
    quantities = (
        "phase", "mission/progress", *(f"load/{name}" for name in PLACE),
        *(f"container/{name}" for name in PLACE), "load/heading_rad", "load/stand_rad",
        "container/heading_rad", "container/stand_rad", *BARS,
        *(f"load/{name}" for name in WEIGHT), "load/left_grip_n", "load/right_grip_n",
        "load/knock_n", "load/height_m", "load/moved_m", "load/off_m", "load/sinking_mps",
        "load/tilt_rad", "load/in_ahead_m", "load/in_aside_m", "load/in_up_m",
        *(f"joint/{name}" for name in SEEN), "monitor/motor_temperature_C",
        "monitor/pressure_margin_m",
    )  # fmt: skip

    def _build(self, model: mujoco.MjModel, tick: float) -> None:
        self.units = {
            "tracks": ("m/s", "rad/s"), "hands": "m/s", "turn": "rad/s", "squeeze": "m/s",
            **dict.fromkeys(LED, "rad/s"),
        }  # fmt: skip
        self.actions = {
            "tracks": np.array(TRACKS), "hands": HANDS, "turn": TURN, "squeeze": SQUEEZE,
            **dict.fromkeys(LED, JOINTS), "phase": 1.0,
        }  # fmt: skip
        mission = kept(disposal.mission(), LAST, lambda one: "grip" not in one.name)
        self.adopt(mission, model, disposal.controller, LAST, LED)
        bars = [f"ordnance_bar_{side}" for side in ("left", "right")]
        qpos = self.simulation.data.qpos
        own = disposal.Job().mass
        self.fetched = Loose(model, qpos, "ordnance_case", mass=own, surface=bars)
        self.observation = (
            Group("phase", len(self._phases), "", 1.0, "1 for the present one"),
            Group("progress", 1, "", 1.0, "of the present phase"),
            Group("case", 5, "m", 10.0, "its place, its stand ahead, its place from the hands"),
            Group("container", 5, "m", 10.0, "the same"),
            Group("heading", 4, "rad", 4.0, "of the case, its stand; of the container, its stand"),
            Group("bars", 6, "m", 10.0, "from the left hand, from the right hand"),
            Group("weight", 5, "", 5.0, "on the ground, both hands, the rest, in the container"),
            Group("grip", 2, "N", 1000.0, "of both hands"),
            Group("knock", 1, "N", 5000.0, "on the case by the robot, or on the container"),
            Group("motion", 3, "m", 10.0, "of the case: raised, moved, away from a hand"),
            Group("sinking", 1, "m/s", 10.0, "of the case"),
            Group("tilt", 1, "rad", 4.0, "of the case"),
            Group("place", 3, "m", 10.0, "of the case in the container"),
            Group("joints", len(SEEN), "rad", 7.0, ", ".join(SEEN)),
            Group("heat", 1, "degC", 500.0, "of the hottest motor"),
            Group("mass", 1, "kg", 100.0, "of the case"),
            Group("margin", 1, "m", 2.0, "of the centre of pressure within what it stands on"),
        )

    def scene(self) -> mujoco.MjSpec:
        """The robot, the case ahead, the container behind it."""
        return disposal.spec(disposal.Job())

    def command(self, action: Mapping[str, Array], numbers: Numbers) -> Mapping[str, Array]:
        """What is added to the channels; those of tasks that do not rule are not asked."""
        turn = np.zeros((len(action["turn"]), 3))
        turn[:, 2] = action["turn"][:, 0]
        given: dict[str, Array] = {"drive": action["tracks"]}
        for side in ("left", "right"):
            given[f"{side}_hand"], given[f"{side}_turn"] = action["hands"], turn
            given[f"{side}_grip"] = action["squeeze"]
        return given | self.joint_rates(action, numbers)

    def observe(self, numbers: Numbers) -> dict[str, Array]:
        """See the table."""
        load, container = (
            numbers.row(*(f"{thing}/{name}" for name in PLACE)) for thing in ("load", "container")
        )
        return {
            "phase": self.one_of_the_phases(numbers),
            "progress": numbers["mission/progress"],
            "case": load,
            "container": container,
            "heading": numbers.row(
                "load/heading_rad", "load/stand_rad", "container/heading_rad",
                "container/stand_rad",
            ),
            "bars": numbers.row(*BARS),
            "weight": numbers.row(*(f"load/{name}" for name in WEIGHT)),
            "grip": numbers.row("load/left_grip_n", "load/right_grip_n"),
            "knock": numbers["load/knock_n"],
            "motion": numbers.row("load/height_m", "load/moved_m", "load/off_m"),
            "sinking": numbers["load/sinking_mps"],
            "tilt": numbers["load/tilt_rad"],
            "place": numbers.row("load/in_ahead_m", "load/in_aside_m", "load/in_up_m"),
            "joints": numbers.row(*(f"joint/{name}" for name in SEEN)),
            "heat": numbers["monitor/motor_temperature_C"],
            "mass": numbers["mass"],
            "margin": numbers["monitor/pressure_margin_m"],
        }  # fmt: skip

    def harm(self, numbers: Numbers) -> Array:
        """Of knocks, and of a case that falls."""
        knocked = np.maximum(numbers["load/knock_n"][:, 0] / KNOCK - 1.0, 0.0)
        falls = np.maximum(numbers["load/sinking_mps"][:, 0] / SINKING - 1.0, 0.0)
        return knocked + falls

    def tell(self, numbers: Numbers) -> dict[str, Array]:
        """What was done to the case too."""
        return {
            **super().tell(numbers),
            "knock_n": numbers["load/knock_n"][:, 0],
            "sinking_mps": numbers["load/sinking_mps"][:, 0],
            "slipped_m": numbers["load/off_m"][:, 0],
            "in_container": numbers["load/in_container"][:, 0],
        }

    def camera(self) -> mujoco.MjvCamera:
        """From its right, the whole way."""
        return view((3.1, 0.3, 0.7), 6.2, 115.0, -16.0)
