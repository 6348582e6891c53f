"""Hurcules/Stretch-v0: both lower arms reach forward for a casualty on the ground (thesis §4.4)."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from hurcules_envs.base import FRAME_SKIP, Array, HurculesEnv

__all__ = ["StretchEnv"]


class StretchEnv(HurculesEnv):
    """The stretch, commanded in task space.

    The rescue robot (680 kg) stands on its lower-leg tracks before a lying casualty. The action
    moves the references of its tasks; underneath, the hierarchy `joint < hpos < hpitch < pel <
    gaze` is solved at 1 kHz, so that no action commands a joint over its limits and lower tasks
    give way first. Axes are the world's: x forward, y left, z up.

    Action: Box(-1, 1, (11,), float32). Zero holds; 1 is the scale.

    | index | name         | unit  | scale | what it moves                             |
    |-------|--------------|-------|-------|-------------------------------------------|
    | 0     | left_hand_x  | m/s   | 0.043 | reference of the left hand, forward       |
    | 1     | left_hand_y  | m/s   | 0.043 | the same, to the left                     |
    | 2     | left_hand_z  | m/s   | 0.043 | the same, up                              |
    | 3     | right_hand_x | m/s   | 0.043 | reference of the right hand, forward      |
    | 4     | right_hand_y | m/s   | 0.043 | the same, to the left                     |
    | 5     | right_hand_z | m/s   | 0.043 | the same, up                              |
    | 6     | left_pitch   | rad/s | 0.1   | pitch of the left lower arm               |
    | 7     | right_pitch  | rad/s | 0.1   | pitch of the right lower arm              |
    | 8     | pelvis_x     | m/s   | 0.043 | reference of the pelvis, forward          |
    | 9     | gaze_yaw     | rad/s | 0.1   | line of sight of the head, to the left    |
    | 10    | gaze_pitch   | rad/s | 0.1   | the same, up                              |

    Observation: Box of shape (96,), float32; values beyond the range are cut off. C runs over the
    coordinates KN, HIP, WST, NKY, NKP, LSP, LSR, LSY, LEB, RSP, RSR, RSY, REB; L over the levels;
    A over the axes x, y, z.

    | index | name               | unit  | least | most | what it is                           |
    |-------|--------------------|-------|-------|------|--------------------------------------|
    | 0-12  | q/C                | rad   | -4    | 4    | measured position                    |
    | 13-25 | qd/C               | rad/s | -10   | 10   | measured velocity                    |
    | 26-38 | lag/C              | rad   | -2    | 2    | reference minus measured position    |
    | 39-51 | to_lower/C         | rad   | -8    | 8    | distance to the lower limit          |
    | 52-64 | to_upper/C         | rad   | -8    | 8    | distance to the upper limit          |
    | 65-67 | task_error/lhpos   | m     | -5    | 5    | left hand minus its reference        |
    | 68-70 | task_error/rhpos   | m     | -5    | 5    | right hand minus its reference       |
    | 71    | task_error/lhpitch | rad   | -5    | 5    | left lower arm minus its reference   |
    | 72    | task_error/rhpitch | rad   | -5    | 5    | right lower arm minus its reference  |
    | 73    | task_error/pel     | m     | -5    | 5    | pelvis minus its reference           |
    | 74-75 | task_error/gaze    | rad   | -5    | 5    | line of sight minus its reference    |
    | 76-80 | active_rows/L      | 1     | 0     | 64   | rows that hold level L back          |
    | 81-83 | base/A             | m     | -100  | 100  | position of the support              |
    | 84-86 | base_rotation/A    | rad   | -3.2  | 3.2  | its rotation vector                  |
    | 87-89 | base_velocity/A    | m/s   | -20   | 20   | its velocity                         |
    | 90-92 | base_spin/A        | rad/s | -20   | 20   | its angular velocity                 |
    | 93-95 | target_in_base/A   | m     | -100  | 100  | casualty's chest from the support    |

    Reward, a step: the sum of these terms, each in `info` as `reward_TERM`.

    | term     | what                                                                |
    |----------|---------------------------------------------------------------------|
    | progress | 10 a metre that the hands (their mean) came forward                 |
    | hands    | -2 a metre of hand error and second                                 |
    | pelvis   | -0.1 a metre that the pelvis gave way and second                    |
    | gaze     | -1 a radian of gaze error and second                                |
    | limits   | -0.02 a row that holds a level back and second                      |
    | effort   | -0.2 a second at full torque of all motors (mean square of the share) |
    | fall     | -10 once, when the robot falls or the run fails                     |

    Info, the same keys from `reset` on, besides `reward_TERM`:

    | key                   | unit     | what it is                                            |
    |-----------------------|----------|-------------------------------------------------------|
    | is_success            | bool     | the mission is done with small errors                 |
    | ending                | int      | why it is over, of `hurcules.Ending`; 0 before        |
    | solver_status         | 1        | number of rhqp.Status of the last tick, 0 is Solved   |
    | solver_factorizations | 1        | of levels, in the last tick                           |
    | solver_changes        | 1        | of the working set, in the last tick                  |
    | solver_iterations     | 1        | 1 + solver_changes                                    |
    | level_errors          | m or rad | measured error of each level                          |
    | limit_excess          | rad      | worst over any position limit, in the physics         |
    | limit_excess_velocity | rad/s    | worst over any velocity limit, in the physics         |
    | limit_excess_torque   | N m      | worst over any torque limit, in the physics           |
    | time                  | s        | since the start                                       |

    Start: keyframe `stretch`; the seed moves the casualty by up to 3 cm and 0.05 rad and each joint
    by up to 2 mrad, times `variation`.

    End: `terminated` when the mission is over: the hands went 0.875 m forward and held there for
    2 s (`is_success` says whether all errors are small), the robot fell, or the numbers failed.
    `truncated` after 3000 steps (60 s).

    Arguments: `render_mode` None or "rgb_array"; `variation` 1.0.
    """

    task_description = "Lead both hands forward to the person and hold them there."
    mission: ClassVar[str] = "stretch"
    terms: ClassVar[tuple[str, ...]] = (
        "progress",
        "hands",
        "pelvis",
        "gaze",
        "limits",
        "effort",
        "fall",
    )

    def _start(self) -> None:
        self._reach = self._hands_forward()

    def _memory(self) -> Array:
        return np.array([self._reach])

    def _remember(self, memory: Array) -> None:
        self._reach = float(memory[0])

    def _reward(self) -> dict[str, float]:
        simulation = self.simulation
        error = dict(zip(simulation.levels, simulation.level_errors(), strict=True))
        seconds = FRAME_SKIP * simulation.dt
        failed = simulation.finished and not simulation.success
        reach = self._reach if failed else self._hands_forward()
        progress, self._reach = reach - self._reach, reach
        return {
            "progress": 10.0 * progress,
            "hands": -2.0 * seconds * error["hpos"],
            "pelvis": -0.1 * seconds * error["pel"],
            "gaze": -1.0 * seconds * error["gaze"],
            "limits": -0.02 * seconds * self._active_rows(),
            "effort": 0.0 if failed else -0.2 * seconds * self._effort(),
            "fall": -10.0 if failed else 0.0,
        }

    def _hands_forward(self) -> float:
        """Mean x of both hands [m]."""
        data = self._posed()
        return float(0.5 * (data.site("L_tcp").xpos[0] + data.site("R_tcp").xpos[0]))

    def _active_rows(self) -> float:
        """Rows that hold a level back, over all levels."""
        rows = zip(self.observation_names, self.simulation.observation(), strict=True)
        return float(sum(value for name, value in rows if name.startswith("active_rows/")))

    def _effort(self) -> float:
        """Mean square of the motors' torques over their limits, 0 to 1."""
        model, data = self.simulation.model, self.simulation.data
        most = np.abs(model.actuator_forcerange).max(axis=1)
        limited = most > 0
        return float(np.mean((data.actuator_force[limited] / most[limited]) ** 2))
