"""Many episodes at once: Gymnasium's VectorEnv on one batch of simulations."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from gymnasium import logger, spaces
from gymnasium.error import ResetNeeded
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space
from numpy.typing import NDArray

import hurcules
from hurcules_envs.checks import require_no_nan, require_open, require_whole
from hurcules_envs.copies import Copied
from hurcules_envs.endings import Ending
from hurcules_envs.environment import Numbers
from hurcules_envs.episodes import Episodes, Step, seeds_of, state_of
from hurcules_envs.pictures import HEIGHT, SIZE, WIDTH, Eyes, Views
from hurcules_envs.randomisation import Ranged, known_ranges, split
from hurcules_envs.registry import make_environment, warn_of_rate

__all__ = ["NativeVectorEnv"]

MODES = ("rgb_array",)
_CALLED = ("observe", "get_state")  # by `call`


class NativeVectorEnv(VectorEnv[Any, Any, Any], Copied, Ranged):
    """Episodes side by side, stepped in one call on a pool of threads.

    The bits of each episode are those that it has alone.
    """

    _views: Views | None = None  # Gymnasium closes what could not be made, too
    _eyes: Eyes | None = None

    def __init__(
        self,
        environment: str,
        num_envs: int = 1,
        max_episode_steps: int | None = None,
        threads: int = 0,
        autoreset_mode: AutoresetMode | str = AutoresetMode.NEXT_STEP,
        render_mode: str | None = None,
        flat: bool = False,
        cameras: Sequence[str] = (),
        camera_size: Sequence[int] = SIZE,
        width: int = WIDTH,
        height: int = HEIGHT,
        **options: Any,
    ) -> None:
        """Builds the environment once, and its episodes.

        Args:
            environment: "module:Class" of an `Environment`.
            num_envs: how many episodes.
            max_episode_steps: after so many an episode is truncated; None: never.
            threads: of the pool; 0 for one a processor.
            autoreset_mode: NextStep (default), SameStep or Disabled, see Gymnasium.
            render_mode: None or "rgb_array".
            flat: of a goal environment: one array, the observation and the way to the goal.
            cameras: whose pictures are observed too, drawn one after the other: an observation is
                then a dictionary, with (num_envs, height, width, 3) uint8 by camera.
            camera_size: (width, height) of these pictures [pixels].
            width: [pixels] of what `render` gives.
            height: [pixels].
            options: of the environment, by keyword, and ranges of what differs between episodes:
                see `randomisation`.

        Raises:
            hurcules.Error: an unknown option, render mode or camera, or a bad value.
        """
        Copied.__init__(
            self, environment, num_envs, max_episode_steps, threads, autoreset_mode, render_mode,
            flat, cameras, camera_size, width, height, **options,
        )  # fmt: skip
        hurcules.validation.require_known("render mode", render_mode or MODES[0], MODES)
        require_whole("num_envs", num_envs, 1)
        require_whole("threads", threads, 0)
        if max_episode_steps is not None:
            require_whole("max_episode_steps", max_episode_steps, 1)
        self.num_envs = num_envs
        ranges, options = split(options)
        known = ("flat", "threads", "autoreset_mode", "cameras", "camera_size", "width", "height")
        self.environment = make_environment(environment, options, known)
        self._episodes = Episodes(self.environment, num_envs, threads, flat=flat, ranges=ranges)
        mode = str(getattr(autoreset_mode, "value", autoreset_mode))
        hurcules.validation.require_known(
            "autoreset mode", mode, [one.value for one in AutoresetMode]
        )
        self.autoreset_mode = AutoresetMode(mode)
        self.metadata = {
            "autoreset_mode": self.autoreset_mode,
            "render_modes": list(MODES),
            "render_fps": round(1.0 / self._episodes.period),
        }
        self.render_mode = render_mode
        self._views = Views(self.environment, width, height)
        self._eyes = Eyes(self._episodes, cameras, camera_size)
        self.action_names = self._episodes.action_names
        self.action_scale = self._episodes.action_scale
        self.action_units = self._episodes.action_units
        self.single_action_space = self._episodes.single_action_space
        self.single_observation_space = self._eyes.observation_space
        self.action_space = batch_space(self.single_action_space, num_envs)
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.task_description = self.environment.task_description
        if self.environment.goal and not flat:
            self.compute_reward = self._episodes.compute_reward
        self._limit = np.inf if max_episode_steps is None else max_episode_steps
        self._steps = np.full(num_envs, -1, dtype=np.int64)  # -1: not begun
        self._over = np.zeros(num_envs, dtype=bool)
        self._begun = False  # all of them
        self._known = np.ones(num_envs, dtype=bool)
        self._known.flags.writeable = False
        self._masks: dict[str, NDArray[np.bool_]] = {}
        self._made = type(self) is NativeVectorEnv

    @property
    def dt(self) -> float:
        """Of a step of the policy [s]."""
        return self._episodes.period

    @property
    def observation_names(self) -> list[str]:
        """(o,) of one episode, what each number of the observation is, see `SingleEnv`."""
        return self._episodes.observation_names

    @property
    def batch(self) -> hurcules.SimulationBatch:
        """The loops underneath."""
        return self._episodes.batch

    @property
    def numbers(self) -> Numbers:
        """What was read after the last step; what an expert acts upon."""
        return self._episodes.numbers

    def reset(
        self,
        *,
        seed: int | Sequence[int | None] | None = None,
        options: dict[str, Any] | None = None,
    ) -> tuple[Any, dict[str, Any]]:
        """Starts all episodes, or those of a mask.

        Args:
            seed: a number (episode i gets seed + i), one each, or None: their generators go on.
            options: "reset_mask": (num_envs,) bool, which; and ranges of what differs between
                episodes, see `randomisation`, which hold for all that begin from now on.

        Raises:
            gymnasium.error.ClosedEnvironmentError: it was closed; `step`, `render`,
                states and copies too.
            hurcules.Error: an unknown option, a range that is none, or a mask of another shape.
        """
        require_open(self.closed, "reset")
        ranges = dict(known_ranges(options or {}, "reset_mask"))
        mask = ranges.pop("reset_mask", None)
        chosen = np.ones(self.num_envs, dtype=bool) if mask is None else np.asarray(mask)
        if chosen.shape != (self.num_envs,) or chosen.dtype != bool or not chosen.any():
            raise hurcules.Error(
                f"reset_mask: wanted ({self.num_envs},) bool, at least one true, got {mask!r}"
            )
        if mask is None:
            warn_of_rate(self.spec, self.environment.rate, self._limit)
        self._episodes.randomisation.set_ranges(ranges)
        for i, one in enumerate(seeds_of(seed, self.num_envs)):
            if one is not None and chosen[i]:
                self._episodes.generators[i] = np.random.default_rng(one)
        self._begin(chosen)
        self._begun = bool((self._steps >= 0).all())
        step = self._episodes.look(remember=None)
        return self._seen(step.observation), self._told(step)

    def step(self, actions: NDArray[Any]) -> tuple[Any, Any, Any, Any, dict[str, Any]]:
        """Holds the commands of all episodes for one period.

        Args:
            actions: (num_envs, k) in [-1, 1], see `action_names`; zero holds.

        Raises:
            gymnasium.error.ResetNeeded: some episode has not begun.
            hurcules.Error: no array of numbers, another shape, NaN or infinity.
        """
        self._require_begun("step")
        episodes = self._episodes
        values = episodes.checked(actions, self.action_space.shape or ())
        over = self._over
        some_over = np.count_nonzero(over) > 0
        if self.autoreset_mode == AutoresetMode.DISABLED and some_over:
            raise hurcules.Error(
                f"episodes {np.flatnonzero(over).tolist()} are over: reset them by reset_mask"
            )
        goes_on = ~over
        episodes.step(values, goes_on if some_over else None)
        if some_over:  # NEXT_STEP: the step after an end is the reset
            self._begin(over)
        step = episodes.look(remember=goes_on)
        reward, terminated = step.reward, step.terminated
        self._steps += goes_on if some_over else 1
        truncated = self._steps >= self._limit
        if some_over:
            reward, terminated = np.where(goes_on, reward, 0.0), terminated & goes_on
        if np.count_nonzero(truncated):
            truncated &= goes_on & ~terminated
            step.ending[truncated] = int(Ending.TimeLimit)
        ended = terminated | truncated
        observation, info = self._seen(step.observation), self._told(step)
        if self.autoreset_mode == AutoresetMode.SAME_STEP and np.count_nonzero(ended):
            self._begin(ended)
            observation, info = self._same_step(ended, observation, info)
            ended = np.zeros(self.num_envs, dtype=bool)
        self._over = ended
        return observation, reward, terminated, truncated, info

    def get_state(self) -> NDArray[np.float64]:
        """(num_envs, s) everything that decides how the episodes go on, and how new ones start.

        Raises:
            gymnasium.error.ResetNeeded: some episode has not begun.
        """
        self._require_begun("get_state")
        counters = np.stack([self._steps, self._over], axis=1).astype(np.float64)
        return np.concatenate([self._episodes.state(), counters], axis=1)

    def set_state(self, state: NDArray[np.float64]) -> None:
        """Goes back to states from `get_state`: the same actions then give the same bits.

        Raises:
            hurcules.Error: they are no states, or belong to another environment or version.
        """
        require_open(self.closed, "set_state")
        if not self._begun:
            self.reset()
        values = state_of(state, self.get_state().shape)
        require_no_nan("state: steps, over", values[:, -2:])
        self._episodes.restore(values[:, :-2])
        self._steps = values[:, -2].astype(np.int64)
        self._begun = bool((self._steps >= 0).all())
        self._over = values[:, -1] > 0.0

    def observe(self, *, noise: bool = True) -> Any:
        """The observations now, after `set_state` say; without noise what a critic may know."""
        return self._seen(self._episodes.observe(noise=noise))

    def render(self) -> tuple[NDArray[np.uint8], ...] | None:
        """A picture (368, 640, 3) of each episode in render mode "rgb_array", one after the other.

        Raises:
            hurcules.rendering.RendererError: there is no OpenGL that works; names the remedy.
        """
        require_open(self.closed, "render")
        if self.render_mode is None:
            logger.warn("render() without a render mode: pass render_mode='rgb_array'")
            return None
        assert self._views is not None
        return tuple(self._views.take(self._episodes, i) for i in range(self.num_envs))

    def call(self, name: str, *args: Any, **kwargs: Any) -> tuple[Any, ...]:
        """What an episode answers, one each, as Gymnasium's own vectors are asked.

        Args:
            name: render, observe, get_state, or an attribute (`get_attr`).
            args: of the method.
            kwargs: the same.

        Raises:
            hurcules.Error: another method, or a name that does not exist.
        """
        if name == "render":
            return self.render() or (None,) * self.num_envs
        if name in _CALLED:
            answers = getattr(self, name)(*args, **kwargs)
            return tuple(_row(answers, i) for i in range(self.num_envs))
        if callable(getattr(self, name, None)):
            hurcules.validation.require_known("call", name, ("render", *_CALLED, "an attribute"))
        return self.get_attr(name)

    def get_attr(self, name: str) -> tuple[Any, ...]:
        """An attribute of an episode, one each; all have the same, spaces are those of one.

        Raises:
            hurcules.Error: it does not exist.
        """
        for its in (f"single_{name}", name):
            if hasattr(self, its):
                return (getattr(self, its),) * self.num_envs
        raise hurcules.Error(f"attribute '{name}' of the vector does not exist")

    def set_attr(self, name: str, values: Any) -> None:
        """Sets an attribute, `friction` say: from the next episodes on.

        Args:
            name: of the attribute.
            values: one for all, or, in a list or tuple, one each, all the same. A range of two
                episodes is [(0.4, 1.4)] * 2, of any vector `vector.friction = 0.4, 1.4`.

        Raises:
            hurcules.Error: other values, or an attribute that does not exist.
        """
        each = list(values) if isinstance(values, (list, tuple)) else [values] * self.num_envs
        if len(each) != self.num_envs or any(one != each[0] for one in each):
            raise hurcules.Error(
                f"set_attr: wanted one value, or a list of {self.num_envs} that are the same, for "
                f"an attribute is the vector's, got {values!r}; a range is set by "
                f"vector.{name} = (least, most)"
            )
        setattr(self, name, each[0])

    def close_extras(self, **kwargs: Any) -> None:
        """Gives the renderers back."""
        for one in (self._views, self._eyes):
            if one is not None:
                one.close()

    def _went_on(self) -> dict[str, Any]:
        require_open(self.closed, "copy")
        ranges = dict(self._episodes.randomisation.ranges)
        return {"ranges": ranges, "state": self.get_state() if self._begun else None}

    def _go_on(self, there: dict[str, Any]) -> None:
        self._episodes.randomisation.set_ranges(there["ranges"])
        if there["state"] is not None:
            self.set_state(there["state"])

    def _require_begun(self, call: str) -> None:
        require_open(self.closed, call)
        if not self._begun:
            waiting = np.flatnonzero(self._steps < 0).tolist()
            raise ResetNeeded(f"episodes {waiting} have not begun: call reset() before {call}()")

    def _seen(self, observation: Any, drawn: NDArray[np.bool_] | None = None) -> Any:
        assert self._eyes is not None
        return self._eyes.look(observation, drawn)

    def _told(self, step: Step) -> dict[str, Any]:
        """All of `info`; beside each name stands of whom it is known, which is all."""
        info = step.info
        if len(self._masks) < len(info):
            self._masks = dict.fromkeys([f"_{name}" for name in info], self._known)
        info.update(self._masks)
        return info

    def _begin(self, chosen: NDArray[np.bool_]) -> None:
        self._episodes.reset(chosen)
        self._steps[chosen] = 0
        self._over = self._over & ~chosen

    def _same_step(
        self, ended: NDArray[np.bool_], observation: Any, info: dict[str, Any]
    ) -> tuple[Any, dict[str, Any]]:
        """The first observations of new episodes; the last ones of the old under `final_`."""
        step = self._episodes.look(remember=None)
        fresh, fresh_info = self._seen(step.observation, ended), self._told(step)
        final_obs = np.full(self.num_envs, None, dtype=object)
        for i in np.flatnonzero(ended):
            final_obs[i] = _row(observation, int(i))
        final_info: dict[str, Any] = {
            name: np.where(ended, values, np.zeros_like(values)) for name, values in info.items()
        }
        final_info |= {f"_{name}": ended.copy() for name in _names(info)}
        merged: dict[str, Any] = {
            name: _chosen(ended, fresh_info[name], info[name]) for name in info
        }
        merged |= {"final_obs": final_obs, "_final_obs": ended.copy()}
        merged |= {"final_info": final_info, "_final_info": ended.copy()}
        if isinstance(self.single_observation_space, spaces.Dict):
            return {n: _chosen(ended, fresh[n], observation[n]) for n in observation}, merged
        return _chosen(ended, fresh, observation), merged


def _chosen(mask: NDArray[np.bool_], one: NDArray[Any], other: NDArray[Any]) -> NDArray[Any]:
    return np.where(mask.reshape(-1, *[1] * (one.ndim - 1)), one, other)


def _names(info: dict[str, Any]) -> list[str]:
    return [name for name in info if not name.startswith("_")]


def _row(observation: Any, i: int) -> Any:
    if isinstance(observation, dict):
        return {name: values[i].copy() for name, values in observation.items()}
    return observation[i].copy()
