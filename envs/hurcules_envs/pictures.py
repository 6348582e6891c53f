"""Pictures of episodes: what the robot's cameras see, observed, without shadows; and for people."""

from __future__ import annotations

from collections.abc import Sequence
from numbers import Integral
from typing import Any

import mujoco
import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

import hurcules
from hurcules import cameras
from hurcules.rendering import make_renderer
from hurcules_envs.environment import Environment
from hurcules_envs.episodes import Episodes

__all__ = ["HEIGHT", "SIZE", "WIDTH", "Eyes", "Pictures", "Views"]

MOST = 2048  # [pixels] a side
SIZE = (128, 96)  # [pixels] of what is observed, where nothing else is asked for
WIDTH, HEIGHT = 640, 368  # [pixels] of a view, multiples of 16 as encoders want them


class Views:
    """Episodes as the environment's own camera sees them, with what it draws."""

    def __init__(self, environment: Environment, width: int, height: int) -> None:
        """A view of width and height [pixels].

        Raises:
            hurcules.Error: no such size.
        """
        if not (_is_side(width) and _is_side(height)):
            raise hurcules.Error(
                f"width and height: wanted 1 to {MOST} pixels each, got {width!r} and {height!r}"
            )
        self._environment, self._size = environment, (int(width), int(height))
        self._renderer: mujoco.Renderer | None = None

    def take(self, episodes: Any, i: int) -> NDArray[np.uint8]:
        """(height, width, 3) of episode i now.

        Raises:
            hurcules.rendering.RendererError: there is no OpenGL that works; names the remedy.
        """
        model, data = self._environment.pictured(episodes, i)
        if self._renderer is None:
            self._renderer = make_renderer(model, *self._size)
        self._renderer.update_scene(data, self._environment.camera())
        self._environment.draw(episodes, i, self._renderer.scene)
        return self._renderer.render()

    def close(self) -> None:
        """Gives the renderer back."""
        if self._renderer is not None:
            self._renderer.close()
        self._renderer = None


class Pictures:
    """What cameras of the scene see of an episode.

    Attributes:
        spaces: by camera, (height, width, 3) uint8.
        observation_space: these beside what is observed otherwise.
    """

    def __init__(
        self,
        environment: Environment,
        names: Sequence[str],
        size: Sequence[int],
        space: spaces.Space[Any],
    ) -> None:
        """Finds the cameras.

        Args:
            environment: whose visual model is drawn.
            names: of cameras of that model.
            size: (width, height) [pixels].
            space: of what is observed otherwise, "observation" where it is no dictionary.

        Raises:
            hurcules.Error: no sequence of names, each once, no such camera, or no such size.
        """
        taken = dict(space.spaces) if isinstance(space, spaces.Dict) else {"observation": space}
        if isinstance(names, str) or not all(isinstance(name, str) for name in names):
            raise hurcules.Error(f"cameras: wanted a sequence of names, got {names!r}")
        if len(set(names)) < len(names) or set(names) & set(taken):
            known = ", ".join(taken)
            raise hurcules.Error(
                f"cameras: wanted names, each once, none of {known}; got {names!r}"
            )
        sides = tuple(size) if isinstance(size, Sequence) else ()
        if len(sides) != 2 or not all(_is_side(side) for side in sides):
            raise hurcules.Error(
                f"camera_size: wanted (width, height) of 1 to {MOST} pixels, got {size!r}"
            )
        self._environment, self._size = environment, sides
        model, _ = environment.drawn()
        self._cameras = {name: cameras.find(model, name).name for name in names}
        box = spaces.Box(0, 255, (self._size[1], self._size[0], 3), np.uint8)
        self.spaces = dict.fromkeys(names, box)
        self.observation_space = spaces.Dict(taken | self.spaces)
        self._renderer: mujoco.Renderer | None = None

    def take(self, episodes: Any, i: int) -> dict[str, NDArray[np.uint8]]:
        """By camera, what it sees of episode i now.

        Raises:
            hurcules.rendering.RendererError: there is no OpenGL that works; names the remedy.
        """
        model, data = self._environment.pictured(episodes, i)
        if self._renderer is None:
            self._renderer = make_renderer(model, *self._size)
            # they take seven eighths of the time where no GPU draws
            self._renderer.scene.flags[mujoco.mjtRndFlag.mjRND_SHADOW] = 0
        seen = {}
        for name, camera in self._cameras.items():
            self._renderer.update_scene(data, camera)
            seen[name] = self._renderer.render()
        return seen

    def close(self) -> None:
        """Gives the renderer back."""
        if self._renderer is not None:
            self._renderer.close()
        self._renderer = None


class Eyes:
    """What episodes side by side observe, pictures of cameras included.

    Attributes:
        observation_space: of one episode.
    """

    def __init__(
        self, episodes: Episodes, cameras: Sequence[str] = (), camera_size: Sequence[int] = SIZE
    ) -> None:
        """Finds the cameras; see `Pictures`."""
        self._episodes = episodes
        self._pictures: Pictures | None = None
        self._views: dict[str, NDArray[np.uint8]] = {}
        self.observation_space = episodes.single_observation_space
        if not cameras and not np.array_equal(camera_size, SIZE):
            raise hurcules.Error(f"camera_size={camera_size!r} wants cameras=[...] beside it")
        if cameras:
            self._pictures = Pictures(
                episodes.environment, cameras, camera_size, self.observation_space
            )
            self.observation_space = self._pictures.observation_space
            self._views = {
                name: np.zeros((episodes.n, *(space.shape or ())), np.uint8)
                for name, space in self._pictures.spaces.items()
            }

    def look(self, parts: dict[str, NDArray[Any]], chosen: NDArray[np.bool_] | None = None) -> Any:
        """An array (n, m), or a dictionary of them with pictures (n, height, width, 3), each new.

        Args:
            parts: what is observed beside them, by name.
            chosen: (n,) of whom pictures are drawn, None: of all. The others are as they were.

        Raises:
            hurcules.rendering.RendererError: there is no OpenGL that works; names the remedy.
        """
        if self._pictures is None:
            return parts if len(parts) > 1 else parts["observation"]
        self._views = {name: views.copy() for name, views in self._views.items()}
        for i in range(self._episodes.n) if chosen is None else np.flatnonzero(chosen):
            for name, view in self._pictures.take(self._episodes, int(i)).items():
                self._views[name][i] = view
        return parts | self._views

    def close(self) -> None:
        """Gives the renderer back."""
        if self._pictures is not None:
            self._pictures.close()


def _is_side(side: object) -> bool:
    return isinstance(side, Integral) and 1 <= int(side) <= MOST
