"""Hurcules/Casualty-v0: the whole rescue, corrected by a policy."""

from __future__ import annotations

from hurcules_envs.rescue import Rescue

__all__ = ["Casualty"]


class Casualty(Rescue):
    """The mission `casualty`, from the first metre until the person lies on the bed at home.

    `Rescue` goes as far as the chest; here the robot sits down with him, folds its legs, lays him
    on its transfer bed, takes the arms out and drives home: 31 phases, about 155 s. An action is
    added to what the present phase of models/missions/casualty.toml commands, a zero action is the
    mission as it stands. The person is drawn as in `Rescue`.

    Actions, in [-1, 1]; zero leaves the mission as it is:

    | index | name | scale | unit | what is added, where the phase has it |
    |---|---|---|---|---|
    | 0 | speed | 0.1 | m/s | of the tracks |
    | 1 | yaw_rate | 0.1 | rad/s | of the tracks |
    | 2 | ahead | 0.05 | m/s | both hands, forward (not while posture or joints rule) |
    | 3 | left | 0.05 | m/s | both hands, to the left |
    | 4 | up | 0.05 | m/s | both hands (not while they press) |
    | 5 | pitch | 0.1 | rad/s | both blades, tips up |
    | 6 | press | 0.0125 | m/s | of the way down, while they press |
    | 7 | lean | 0.1 | rad/s | hip, while posture or joints rule |
    | 8 | shoulders | 0.1 | rad/s | both, likewise |
    | 9 | elbows | 0.1 | rad/s | both, likewise |
    | 10 | phase | 1 |  | above 0.5 asks for the next phase, below -0.5 for the one before |

    A phase is asked for when the number passes 0.5, and again when it has come back before.

    Observation:

    | index | name | bound | unit | what |
    |---|---|---|---|---|
    | 0-41 | phase | 1 |  | 1 for the present one, in the order of the table |
    | 42 | progress | 1 |  | of the present phase |
    | 43-47 | person | 5 | m | behind the tips, aside, raised, moved; the stand is ahead |
    | 48-49 | tips | 5 | m | height of the left and the right one |
    | 50-51 | heading | 4 | rad | of his body against square; bearing of the stand |
    | 52-55 | weight | 2 |  | on the ground, the left arm, the right arm, the rest: shares |
    | 56-59 | force | 5000 | N | of both presses, push along the ground, largest support |
    | 60 | contact | 20 |  | largest force of a contact over the limit of its region |
    | 61 | head | 500 | m/s^2 | of his head, gravity included |
    | 62-63 | tilt | 2 | rad | of the left and the right blade, tip up |
    | 64-69 | joints | 4 | rad | KN, HIP, both shoulders (pitch), both elbows |
    | 70 | mass | 200 | kg | of the person |
    | 71 | margin | 2 | m | of the centre of mass within what the robot stands on |

    Reward:

    | term | what |
    |---|---|
    | phase | 10 times the share of the phases up to `hand over` reached for the first time |
    | harm | minus 0.1 a second times what contacts and the head (10 g) have over their limits |
    | time | -0.002 a step |
    | effort | minus 0.002 times the mean square of the action |
    | success | 10 once |
    | failure | -5 once, -10 when the robot fell |

    Success: he lies on the bed, nothing of him on the ground, where the robot stands at home. It
    ends the episode; so does a fall, or the end of the mission in any other way. `info` and `cost`
    are those of `Rescue`.
    """

    task_description = "Fetch the person: lift him, lay him on the bed and bring him home."
    mission, last = "casualty", "hand over"
    toll = 0.002
