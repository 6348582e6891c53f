"""One episode at a time: Gymnasium's Env on a batch of one."""

from __future__ import annotations

import time
from collections.abc import Sequence
from contextlib import ExitStack
from typing import Any

import gymnasium
import mujoco
import numpy as np
from gymnasium.error import ResetNeeded
from numpy.typing import NDArray

import hurcules
from hurcules import _core
from hurcules.rendering import pose
from hurcules.view import opened
from hurcules_envs.checks import require_open
from hurcules_envs.copies import Copied
from hurcules_envs.environment import Numbers
from hurcules_envs.episodes import Episodes, state_of
from hurcules_envs.pictures import HEIGHT, SIZE, WIDTH, Eyes, Views
from hurcules_envs.randomisation import Ranged, known_ranges, split
from hurcules_envs.registry import make_environment, warn_of_rate

__all__ = ["SingleEnv"]

# keywords beside the environment's
OWN = ("flat", "render_mode", "cameras", "camera_size", "width", "height")

_ALL = np.ones(1, dtype=bool)
Observation = NDArray[np.float32] | dict[str, NDArray[Any]]


class SingleEnv(gymnasium.Env[Any, NDArray[np.float32]], Copied, Ranged):
    """An environment with Gymnasium's interface.

    Attributes:
        environment: what it is an episode of.
        action_names: what each number of the action commands.
        action_scale: (k,) what 1 in the action means [SI].
        action_units: their units, "m/s" say; "" for a mere number.
        task_description: one sentence.
        compute_reward: of a goal environment alone, (achieved, desired, info): the reward of other
            goals, any leading axes, the same of both. Stable-Baselines3 takes who has it for one.
    """

    metadata: dict[str, Any] = {"render_modes": ["rgb_array", "human"], "render_fps": 20}  # noqa: RUF012

    def __init__(
        self,
        environment: str,
        render_mode: str | None = None,
        flat: bool = False,
        cameras: Sequence[str] = (),
        camera_size: Sequence[int] = SIZE,
        width: int = WIDTH,
        height: int = HEIGHT,
        **options: Any,
    ) -> None:
        """Builds the environment.

        Args:
            environment: "module:Class" of an `Environment`.
            render_mode: None, "rgb_array", or "human" (a window, in real time at most).
            flat: of a goal environment: one array, the observation and the way to the goal.
            cameras: of the robot ("head_wide", "head_left", "head_right", "auxiliary") or the
                scene, whose pictures are observed too: an observation is then a dictionary of
                "observation", the goals, and the pictures by camera, (height, width, 3) uint8.
            camera_size: (width, height) of these pictures [pixels].
            width: [pixels] of what `render` gives.
            height: [pixels].
            options: of the environment, by keyword, and ranges of what differs between episodes:
                see `randomisation`.

        Raises:
            hurcules.Error: an unknown render mode or option, or a bad value.
        """
        Copied.__init__(
            self, environment, render_mode, flat, cameras, camera_size, width, height, **options
        )
        hurcules.validation.require_known(
            "render mode", render_mode or "rgb_array", self.metadata["render_modes"]
        )
        self.render_mode = render_mode
        ranges, options = split(options)
        self.environment = make_environment(environment, options, OWN)
        self._episodes = Episodes(self.environment, 1, threads=1, flat=flat, ranges=ranges)
        self.metadata = self.metadata | {"render_fps": round(1.0 / self._episodes.period)}
        self.action_names = self._episodes.action_names
        self.action_scale = self._episodes.action_scale
        self.action_units = self._episodes.action_units
        self.action_space = self._episodes.single_action_space
        self._eyes = Eyes(self._episodes, cameras, camera_size)
        self.observation_space = self._eyes.observation_space
        self.task_description = self.environment.task_description
        if self.environment.goal and not flat:
            self.compute_reward = self._episodes.compute_reward
        self._begun = self._closed = False
        self._steps = 0  # of the episode, none once it terminated
        self._over = False  # it terminated, and nobody has reset it
        self._viewer: Any = None
        self._window = ExitStack()  # waits for the viewer's thread
        self._due = 0.0  # [s] when the next step may be shown
        self._views = Views(self.environment, width, height)
        self._made = type(self) is SingleEnv

    @property
    def dt(self) -> float:
        """Of a step of the policy [s]."""
        return self._episodes.period

    @property
    def observation_names(self) -> list[str]:
        """(o,) what each number of the observation is: its group, with _i where that has several.

        Of a dictionary its part "observation"; with `flat` the last are to_goal_i, the way there.
        """
        return self._episodes.observation_names

    @property
    def numbers(self) -> Numbers:
        """What was read after the last step; what an expert acts upon."""
        return self._episodes.numbers

    @property
    def simulation(self) -> _core.Simulation:
        """The loop underneath."""
        return self._episodes.batch[0]

    @property
    def model(self) -> mujoco.MjModel:
        """Of the physics, with the masses and friction of this episode."""
        return self._episodes.model(0)

    @property
    def data(self) -> mujoco.MjData:
        """The physics as it is now, contacts and their forces too; a copy, each time anew."""
        data = mujoco.MjData(self.model)
        state = self._episodes.batch.physics[0]
        mujoco.mj_setState(self.model, data, state, mujoco.mjtState.mjSTATE_INTEGRATION)
        mujoco.mj_forward(self.model, data)
        return data

    @property
    def pictured(self) -> tuple[mujoco.MjModel, mujoco.MjData]:
        """What pictures are drawn of: a model with lights and visual parts, and the episode now.

        The data are drawn over by the next picture. `hurcules.cameras.picture(*env.pictured, name,
        depth=True)` is the depth of what `cameras` observes; MuJoCo's renderer makes segmentations.

        Raises:
            gymnasium.error.ResetNeeded: no episode has begun.
        """
        self._require_begun("pictured")
        return self.environment.pictured(self._episodes, 0)

    @property
    def qpos(self) -> NDArray[np.float64]:
        """(nq,) positions of everything in the model, now."""
        return self._episodes.batch.qpos[0].copy()

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observation, dict[str, Any]]:
        """Starts an episode.

        Args:
            seed: of the generator that draws it; None: it goes on.
            options: ranges of what differs between episodes, see `randomisation`; they hold for
                this episode and those after it.

        Raises:
            gymnasium.error.ClosedEnvironmentError: it was closed; `step`, `render`,
                states and copies too.
            hurcules.Error: an option that does not exist, or a range that is none.
        """
        require_open(self._closed, "reset")
        super().reset(seed=seed)
        # a limit is Gymnasium's, and is not told: what was cut after so many steps shows it
        warn_of_rate(self.spec, self.environment.rate, self._steps)
        self._steps = 0
        self._episodes.randomisation.set_ranges(known_ranges(options or {}))
        self._episodes.generators[0] = self.np_random
        self._episodes.reset()
        self._begun, self._over = True, False
        step = self._episodes.look(remember=None)
        return self._seen(step.observation), step.info_of_one

    def step(
        self, action: NDArray[np.float32]
    ) -> tuple[Observation, float, bool, bool, dict[str, Any]]:
        """Holds the commands for one period.

        Args:
            action: (k,) in [-1, 1], see `action_names`; zero holds.

        Returns:
            Observation, reward, terminated, truncated (never; the time limit is Gymnasium's), info.

        Raises:
            gymnasium.error.ResetNeeded: no episode has begun.
            hurcules.Error: the action is no array of numbers, has another shape or holds NaN or
                infinity.
        """
        self._require_begun("step")
        values = self._episodes.checked(action, self.action_space.shape or ())
        if self._over:
            gymnasium.logger.warn(
                "step() after the episode terminated: reset() begins the next one, and what comes "
                "until then is of none"
            )
        self._episodes.step(values[None])
        step = self._episodes.look(remember=_ALL)
        terminated = self._over = bool(step.terminated[0])
        self._steps = 0 if terminated else self._steps + 1
        if self.render_mode == "human":
            self.render()
            self._keep_time()
        seen = self._seen(step.observation)
        return seen, float(step.reward[0]), terminated, False, step.info_of_one

    def get_state(self) -> NDArray[np.float64]:
        """(s,) everything that decides how the episode goes on, and how the next ones start.

        The count of steps of Gymnasium's time limit is not in it.

        Raises:
            gymnasium.error.ResetNeeded: no episode has begun.
        """
        self._require_begun("get_state")
        return self._episodes.state()[0]

    def set_state(self, state: NDArray[np.float64]) -> None:
        """Goes back to a state from `get_state`: the same actions then give the same bits.

        Raises:
            hurcules.Error: it is no state, or belongs to another environment or version.
        """
        require_open(self._closed, "set_state")
        if not self._begun:
            self.reset()
        self._episodes.restore(state_of(state, self.get_state().shape)[None])
        self._over = False

    def observe(self, *, noise: bool = True) -> Observation:
        """The observation now, after `set_state` say; without noise what a critic may know.

        Raises:
            gymnasium.error.ResetNeeded: no episode has begun.
        """
        self._require_begun("observe")
        return self._seen(self._episodes.observe(noise=noise))

    def render(self) -> NDArray[np.uint8] | None:
        """A picture (368, 640, 3) in render mode "rgb_array"; None in "human", which has a window.

        Raises:
            hurcules.rendering.RendererError: there is no OpenGL that works; names the remedy.
        """
        require_open(self._closed, "render")
        if self.render_mode is None:
            gymnasium.logger.warn("render() without a render mode: pass render_mode='rgb_array'")
            return None
        if self.render_mode == "human":
            self._show(*self.environment.pictured(self._episodes, 0))
            return None
        return self._views.take(self._episodes, 0)

    def close(self) -> None:
        """Gives the renderer and the window back."""
        self._views.close()
        self._window.close()
        self._eyes.close()
        self._viewer = None
        self._closed = True

    def _went_on(self) -> dict[str, Any]:
        require_open(self._closed, "copy")
        there: dict[str, Any] = {"ranges": dict(self._episodes.randomisation.ranges)}
        if self._begun:
            there |= {"state": self.get_state(), "steps": self._steps}
        return there

    def _go_on(self, there: dict[str, Any]) -> None:
        self._episodes.randomisation.set_ranges(there["ranges"])
        if "state" in there:
            self.set_state(there["state"])
            self._steps = there["steps"]

    def _require_begun(self, call: str) -> None:
        require_open(self._closed, call)
        if not self._begun:
            raise ResetNeeded(f"no episode has begun: call reset() before {call}()")

    def _seen(self, observation: dict[str, NDArray[np.float32]]) -> Observation:
        """The observation of the one episode, pictures included."""
        seen = self._eyes.look(observation)
        return {name: rows[0] for name, rows in seen.items()} if isinstance(seen, dict) else seen[0]

    def _show(self, model: mujoco.MjModel, data: mujoco.MjData) -> None:
        if self._viewer is None:
            self._shown = mujoco.MjData(model)
            self._viewer = self._window.enter_context(opened(model, self._shown))
        pose(model, self._shown, data.qpos)
        self._viewer.sync()

    def _keep_time(self) -> None:
        now = time.perf_counter()
        time.sleep(max(0.0, self._due - now))
        self._due = max(self._due, now) + self._episodes.period
