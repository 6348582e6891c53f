"""Why an episode is over: what `info["ending"]` says."""

from enum import IntEnum

__all__ = ["Ending"]


class Ending(IntEnum):
    """The endings of simulations, `hurcules.Ending`, and the time limit of a vector."""

    Running = 0
    Completed = 1
    Missed = 2
    TimeUp = 3
    Fell = 4
    Diverged = 5
    SolverFailed = 6
    Held = 7
    TimeLimit = 8
