"""The ground of a scene, felt by rays from above."""

import mujoco
import numpy as np

from hurcules import scenes

ABOVE = 10.0  # [m]


class Surface:
    """The ground of a scene without a robot."""

    def __init__(self, kind: str, **values: object) -> None:
        self.model = scenes.make(kind, **values).compile()
        self.data = mujoco.MjData(self.model)
        mujoco.mj_forward(self.model, self.data)

    def height(self, x: float, y: float = 0.0) -> float:
        """[m]."""
        geom = np.zeros(1, np.int32)
        start, down = np.array([x, y, ABOVE]), np.array([0.0, 0.0, -1.0])
        distance = mujoco.mj_ray(self.model, self.data, start, down, None, 1, -1, geom)
        assert distance >= 0, (x, y)
        return ABOVE - distance

    def heights(self, x: np.ndarray, y: float = 0.0) -> np.ndarray:
        """[m]."""
        return np.array([self.height(float(value), y) for value in x])

    def edges(self, low: float, high: float, y: float = 0.0, step: float = 0.002) -> list[float]:
        """Where the height jumps by more than 1 cm along the way, to a step [m]."""
        x = np.arange(low, high, step)
        jumps = np.flatnonzero(abs(np.diff(self.heights(x, y))) > 0.01)
        return [float(x[i] + step / 2) for i in jumps]
