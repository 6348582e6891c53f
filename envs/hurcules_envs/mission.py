"""What the environments share in which a mission acts and a policy corrects it."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Collection, Mapping, Sequence
from types import MappingProxyType

import mujoco
import numpy as np
from numpy.typing import NDArray

import hurcules
from hurcules import Mission
from hurcules_envs.contact import ContactEnvironment
from hurcules_envs.environment import Array, Numbers, Start
from hurcules_envs.loose import Loose

__all__ = ["MissionEnvironment", "kept"]

LIFTS = "lift"  # phase in which what lay on the ground leaves it
PLACES = {"ahead": 0.05, "left": 0.10, "yaw": 0.2}  # [m], [m], [rad] how far either way
ASKS = 0.5  # of the number `phase`: beyond it a phase is asked for


class MissionEnvironment(ContactEnvironment):
    """A mission, to whose commands an action is added; a zero action is the mission as it stands.

    A subclass builds itself with `adopt`, names its channels in `command`, and says in `harm` what
    should not happen; the other terms of the reward are the same for all.

    Attributes:
        fetched: what the mission is about.
        mass, friction: [kg], of its surface: least and largest of an episode.
        moved: quantity [m]: how far what is fetched is along the ground from where it lay.
        toll: of a step, and of a full action in it: taken from the reward.
    """

    terms = ("phase", "harm", "time", "effort", "success", "failure")
    memory: Mapping[str, int] = MappingProxyType(
        {
            "mass": 1, "friction": 1, "asked": 1, "furthest": 1, "reached": 1, "pushed": 1,
            "over": 1, "fresh": 1,
        }
    )  # fmt: skip
    parameters = ("mass", "friction")
    fetched: Loose
    mass: tuple[float, float]
    friction: tuple[float, float]
    moved: str
    toll = 0.01

    def __init__(self, fidelity: str = "exact", sparse: bool = False, rate: float = 20.0) -> None:
        """Builds scene, controller and mission.

        Args:
            fidelity: "exact" or "fast".
            sparse: reward of success and failure alone.
            rate: steps a second [Hz].

        Raises:
            hurcules.Error: a value that does not exist or is out of range.
        """
        super().__init__(fidelity, sparse, rate)

    def adopt(
        self,
        mission: Mission,
        model: mujoco.MjModel,
        controller: Callable[[mujoco.MjModel], hurcules.WholeBodyController],
        last: str,
        led: Mapping[str, Sequence[str]],
    ) -> None:
        """Builds the simulation, whose mission succeeds after the phase `last`.

        Args:
            mission: which.
            model: of robot and world.
            controller: for it, with channels `posture` and `joints`.
            last: the phase.
            led: by number of the action the joints that it moves while one of these stacks rules.
        """
        made = controller(model)
        self.simulation = hurcules.Simulation(
            mission, model=model, controller=made, variation=0.0, record=False, adds_command=True
        )
        self._phases = self.simulation.phases
        self._last, self._lifts = self._phases.index(last), self._phases.index(LIFTS) - 1
        names = {
            "posture": list(made.plan.coordinate_names),
            "joints": [
                name.removeprefix("joints_")
                for name in self.simulation.command_names
                if name.startswith("joints_")
            ],
        }
        self._led = led
        self._joints = {
            channel: (joints, _mask(mission.rows.phases, channel, joints))
            for channel, joints in names.items()
        }

    def joint_rates(self, action: Mapping[str, Array], numbers: Numbers) -> dict[str, Array]:
        """What is added to the channels `posture` and `joints`, but behind shut brakes."""
        phase = numbers["phase"][:, 0].astype(int)
        given = {}
        for channel, (names, moves) in self._joints.items():
            rates = np.zeros((len(phase), len(names)))
            for number, joints in self._led.items():
                for joint in joints:
                    rates[:, names.index(joint)] = action[number][:, 0]
            given[channel] = rates * moves[phase]
        return given

    def configure(self, model: mujoco.MjModel, values: Mapping[str, Array]) -> None:
        """Mass and friction of what is fetched."""
        self.fetched.configure(model, float(values["mass"][0]), float(values["friction"][0]))

    def start(self, generator: np.random.Generator) -> Start:
        """It lies near where the mission expects it."""
        drawn = {name: generator.uniform(*getattr(self, name)) for name in self.parameters}
        places = dict(
            zip(PLACES, generator.uniform(-1.0, 1.0, 3) * [*PLACES.values()], strict=True)
        )
        qpos = np.array(self.simulation.data.qpos)
        self.fetched.place(qpos, *places.values())
        return Start(qpos, drawn, drawn | {name: float(at) for name, at in places.items()})

    @abstractmethod
    def harm(self, numbers: Numbers) -> Array:
        """(n,) how far limits are passed, as shares of these."""

    def phases(self, action: Mapping[str, Array], numbers: Numbers) -> Mapping[int, str]:
        """The next one, or the one before, where it is asked for anew."""
        wish = np.where(np.abs(action["phase"][:, 0]) > ASKS, np.sign(action["phase"][:, 0]), 0.0)
        asked = numbers.memory["asked"][:, 0]
        fresh = (wish != 0.0) & (wish != asked) & ~numbers.finished
        asked[:] = wish
        now = numbers["phase"][:, 0].astype(int)
        wanted = np.clip(now + wish.astype(int), 0, len(self._phases) - 1)
        return {int(i): self._phases[wanted[i]] for i in np.flatnonzero(fresh & (wanted != now))}

    def remember(self, numbers: Numbers) -> None:
        """How far the mission has come, how far it pushed, and how it ended."""
        memory = numbers.memory
        phase = numbers["phase"]
        on_the_way = np.where(phase <= self._last, phase, 0.0)
        before = memory["furthest"].copy()
        np.maximum(before, on_the_way, out=memory["furthest"])
        memory["reached"][:] = memory["furthest"] - before
        lies = np.where(phase <= self._lifts, numbers[self.moved], 0.0)
        np.maximum(memory["pushed"], lies, out=memory["pushed"])
        over = memory["over"][:, 0] > 0.0
        memory["fresh"][:, 0] = numbers.finished & ~over
        memory["over"][:, 0] = numbers.finished

    def one_of_the_phases(self, numbers: Numbers) -> Array:
        """(n, phases) 1 for the present one."""
        return (numbers["phase"].astype(int) == np.arange(len(self._phases))).astype(float)

    def reward(self, numbers: Numbers) -> dict[str, Array]:
        """See the table."""
        shaped = 0.0 if self.sparse else 1.0
        fresh = numbers["fresh"][:, 0]
        fell = numbers.ended_as(hurcules.Ending.Fell)
        done = self.succeeded(numbers)
        effort = numbers.effort / numbers.action.shape[1]
        return {
            "phase": 10.0 * shaped * numbers["reached"][:, 0] / self._last,
            "harm": -0.1 * shaped * numbers.dt * self.harm(numbers),
            "time": np.full(len(fresh), -self.toll * shaped),
            "effort": -self.toll * shaped * effort,
            "success": 10.0 * fresh * done,
            "failure": -fresh * np.where(done, 0.0, np.where(fell, 10.0, 5.0)),
        }

    def succeeded(self, numbers: Numbers) -> NDArray[np.bool_]:
        """The mission is completed."""
        return numbers.ended_as(hurcules.Ending.Completed)

    def failed(self, numbers: Numbers) -> NDArray[np.bool_]:
        """It ended in another way."""
        return numbers.finished & ~self.succeeded(numbers)

    def costs(self, numbers: Numbers) -> NDArray[np.bool_]:
        """A limit is passed."""
        return self.harm(numbers) > 0.0

    def tell(self, numbers: Numbers) -> dict[str, Array]:
        """How far it came, and how it ended."""
        fell = numbers.ended_as(hurcules.Ending.Fell)
        return {
            "phase": numbers["phase"][:, 0],
            "furthest": numbers["furthest"][:, 0],
            "pushed_m": numbers["pushed"][:, 0],
            "fell": fell.astype(float),
            "missed": (self.failed(numbers) & ~fell).astype(float),
        }

    def expert(self, numbers: Numbers) -> Array:
        """Nothing is added: the mission as it stands."""
        return np.zeros_like(numbers.action)


def kept(
    mission: Mission,
    last: str,
    judged: Callable[[hurcules.Measure], bool] = lambda _: True,
    without: Collection[str] = (),
) -> Mission:
    """The mission that is over after the phase `last`, or where reactions lead.

    Args:
        mission: the table as it is.
        last: the phase.
        judged: which measures stay, of those that need no later phase.
        without: phases that are left out, with the troubles that lead there.
    """
    phases = [phase for phase in mission.rows.phases if phase.name not in without]
    for phase in phases:
        phase.last = phase.name == last
        phase.next = "" if phase.last else phase.next
        phase.troubles = [
            one for one in phase.troubles if not any(to.phase in without for to in one.reactions)
        ]
    after = {phase.name for phase in phases[[p.name for p in phases].index(last) + 1 :]}
    measures = [one for one in mission.rows.measures if not after & set(one.phases) and judged(one)]
    return Mission(
        mission.setup,
        hurcules.MissionTable(phases=phases, safety=mission.rows.safety, measures=measures),
    )


def _mask(phases: Sequence[hurcules.Phase], stack: str, names: Sequence[str]) -> Array:
    """(phases, names) 1 in phases of this stack, 0 in the others and behind shut brakes."""
    return np.array(
        [
            [one.stack == stack and not {name, name[1:]} & set(one.brakes) for name in names]
            for one in phases
        ],
        float,
    )
