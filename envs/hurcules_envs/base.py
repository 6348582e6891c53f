"""What all environments of Hurcules share: a mission's C++ loop behind Gymnasium's interface.

An environment adds what its mission is about: the reward, and the text with its tables.
"""

from __future__ import annotations

from abc import abstractmethod
from typing import Any, ClassVar

import gymnasium
import mujoco
import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

import hurcules
from hurcules.rendering import make_renderer, overview_camera, pose
from hurcules.validation import require_known
from hurcules_envs.checks import require_no_nan, require_open
from hurcules_envs.copies import GENERATOR, Copied, generator_numbers, generator_state
from hurcules_envs.episodes import numbers_of
from hurcules_envs.observations import observation_space

__all__ = ["HurculesEnv"]

FRAME_SKIP = 20  # control ticks of 1 ms in one step: 50 Hz
WIDTH, HEIGHT = 640, 368  # [pixels], multiples of 16 as encoders want them

Array = NDArray[np.float64]
Action = NDArray[np.float32]
Observation = NDArray[np.float32]


class HurculesEnv(gymnasium.Env[Observation, Action], Copied):
    """A mission whose task-space commands come from outside.

    Attributes:
        task_description: what is wanted, in a sentence.
        simulation: the mission underneath.
        action_names: what each component of the action commands.
        action_scale: (k,) [m/s] or [rad/s], what 1 in the action means.
        action_units: which of the two.
        observation_names: what each component of the observation is.
    """

    metadata: dict[str, Any] = {"render_modes": ["rgb_array"], "render_fps": 50}  # noqa: RUF012
    task_description: ClassVar[str]
    mission: ClassVar[str]
    terms: ClassVar[tuple[str, ...]]  # of the reward, in the order in which they are added

    def __init__(
        self, render_mode: str | None = None, variation: float = 1.0, **options: Any
    ) -> None:
        """Loads the mission's scene.

        Args:
            render_mode: None or "rgb_array"; "human" is Gymnasium's own, when pygame is there.
            variation: how much differs between seeds: 1 as the mission says, 0 nothing.
            options: there are no others.

        Raises:
            hurcules.Error: an unknown render mode or option, or a bad number.
        """
        for option in options:
            require_known("option", option, ("render_mode", "variation"))
        Copied.__init__(self, render_mode=render_mode, variation=variation)
        modes = self.metadata["render_modes"]
        if render_mode is not None and render_mode not in modes:
            known = ", ".join(modes)
            raise hurcules.Error(f"render mode '{render_mode}' does not exist; there are: {known}")
        self.render_mode = render_mode
        self.simulation = hurcules.Simulation(self.mission, variation=variation, record=False)
        self.action_names = list(self.simulation.command_names)
        self.action_scale = np.array(self.simulation.command_scale)
        # of the mission's commands all that turn are pitch and gaze
        turns = ["pitch" in name or "gaze" in name for name in self.action_names]
        self.action_units = ["rad/s" if turn else "m/s" for turn in turns]
        self.observation_names = list(self.simulation.observation_names)
        shape = self.action_scale.shape
        self.action_space = spaces.Box(-1.0, 1.0, shape, dtype=np.float32)
        self._box = observation_space(self.observation_names)
        self.observation_space = self._box
        self._renderer: mujoco.Renderer | None = None
        self._closed = False
        self._copy = mujoco.MjData(self.simulation.model)
        self._start()

    @property
    def dt(self) -> float:
        """Of a step of the policy [s]."""
        return FRAME_SKIP * self.simulation.dt

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observation, dict[str, Any]]:
        """Stands at the start of the mission.

        Args:
            seed: goes to the core as it is, so that `hurcules run --seed` is the same run; without
                one the environment's generator draws it.
            options: none are known.

        Raises:
            gymnasium.error.ClosedEnvironmentError: it was closed; `step`, `render`,
                states and copies too.
            hurcules.Error: an option that does not exist.
        """
        require_open(self._closed, "reset")
        super().reset(seed=seed)
        if options:
            raise hurcules.Error(f"reset: no options exist, got {', '.join(map(str, options))}")
        core_seed = int(self.np_random.integers(2**31)) if seed is None else seed
        self.simulation.reset(core_seed)
        self._start()
        return self.observe(), self._info(dict.fromkeys(self.terms, 0.0))

    def step(self, action: Action) -> tuple[Observation, float, bool, bool, dict[str, Any]]:
        """Holds the commanded velocities for 20 ms.

        Args:
            action: (k,) in [-1, 1], see `action_names`; zero holds.

        Returns:
            Observation, reward, terminated (the mission is over: done, fallen or failed), truncated
            (never; the time limit is Gymnasium's), info.

        Raises:
            hurcules.Error: the action is no array of numbers, has another shape or holds NaN or
                infinity.
        """
        require_open(self._closed, "step")
        command = self._checked(action) * self.action_scale
        self.simulation.step(FRAME_SKIP, command)
        terms = self._reward()
        reward = sum(float(terms[name]) for name in self.terms)
        return self.observe(), reward, bool(self.simulation.finished), False, self._info(terms)

    def operator_action(self) -> Action:
        """The action that the mission's own operator would take now, (k,)."""
        command = np.asarray(self.simulation.operator_command())
        return np.asarray(command / self.action_scale, dtype=np.float32)

    def get_state(self) -> Array:
        """Everything that decides how the episode goes on, and how the next ones start."""
        require_open(self._closed, "get_state")
        own = [generator_numbers(self.np_random), self._memory()]
        return np.concatenate([*own, self.simulation.state()])

    def set_state(self, state: Array) -> None:
        """Goes back to a state from `get_state`: the same actions then give the same bits.

        Raises:
            hurcules.Error: it is no state, or belongs to another environment.
        """
        require_open(self._closed, "set_state")
        values = numbers_of("state", state)
        require_no_nan("state", values)
        own = GENERATOR + len(self._memory())
        if values.ndim != 1 or len(values) <= own:
            wanted = own + len(self.simulation.state())
            raise hurcules.Error(f"state: wanted shape ({wanted},), got {values.shape}")
        generator = generator_state(values[:GENERATOR])
        self.simulation.restore(values[own:])
        self.np_random.bit_generator.state = generator
        self._remember(values[GENERATOR:own])

    def observe(self) -> Observation:
        """The observation now, after `set_state` say."""
        values = np.asarray(self.simulation.observation(), dtype=np.float32)
        return np.clip(values, self._box.low, self._box.high)

    def render(self) -> NDArray[np.uint8] | None:
        """A picture (368, 640, 3) in render mode "rgb_array", else None.

        Raises:
            hurcules.rendering.RendererError: there is no OpenGL that works; names the remedy.
        """
        require_open(self._closed, "render")
        if self.render_mode is None:
            gymnasium.logger.warn("render() without a render mode: pass render_mode='rgb_array'")
            return None
        if self._renderer is None:
            self._renderer = make_renderer(self.simulation.model, WIDTH, HEIGHT)
        self._renderer.update_scene(self._posed(), overview_camera())
        return self._renderer.render()

    def close(self) -> None:
        """Gives the renderer back."""
        if self._renderer is not None:
            self._renderer.close()
            self._renderer = None
        self._closed = True

    def _went_on(self) -> Array:
        require_open(self._closed, "copy")
        return self.get_state()

    def _go_on(self, state: Array) -> None:
        self.set_state(state)

    @abstractmethod
    def _reward(self) -> dict[str, float]:
        """The terms of the reward of the step that was just done."""

    @abstractmethod
    def _start(self) -> None:
        """Forgets what the reward remembers of the last episode."""

    @abstractmethod
    def _memory(self) -> Array:
        """What the reward remembers from step to step, as numbers."""

    @abstractmethod
    def _remember(self, memory: Array) -> None:
        """Takes back what `_memory` returned."""

    def _posed(self) -> mujoco.MjData:
        """Positions of everything now; those in `simulation.data` are of the tick before."""
        pose(self.simulation.model, self._copy, self.simulation.data.qpos)
        return self._copy

    def _checked(self, action: Action) -> Array:
        values = numbers_of("action", action)
        if values.shape != self.action_space.shape:
            raise hurcules.Error(
                f"action: wanted shape {self.action_space.shape}, got {values.shape}"
            )
        if not np.isfinite(values).all():
            bad = int(np.argmin(np.isfinite(values)))
            raise hurcules.Error(f"action: wanted finite numbers, got {values[bad]} at index {bad}")
        return values

    def _info(self, terms: dict[str, float]) -> dict[str, Any]:
        simulation = self.simulation
        worst, solver = simulation.limit_violation(), simulation.solver()
        return {
            **{f"reward_{name}": float(terms[name]) for name in self.terms},
            "is_success": bool(simulation.success),
            "ending": int(simulation.ending),
            "solver_status": int(solver["status"]),  # number of rhqp.Status, 0 is Solved
            "solver_factorizations": int(solver["factorizations"]),
            "solver_changes": int(solver["changes"]),
            "solver_iterations": 1 + int(solver["changes"]),
            "level_errors": np.array(simulation.level_errors()),
            "limit_excess": float(worst["position_rad"]),
            "limit_excess_velocity": float(worst["velocity"]),
            "limit_excess_torque": float(worst["torque"]),
            "time": float(simulation.time),
        }
