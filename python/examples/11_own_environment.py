"""An environment of one's own on a robot of another package: a Panda follows a point.

A class says what the loop is, what is read, how an episode starts and what is wanted; Gymnasium's
single and vector environments come of it. Here the hand has to draw a circle.

Run:  python python/examples/11_own_environment.py
"""

from importlib.util import find_spec
from pathlib import Path

import gymnasium
import numpy as np

import hurcules
import hurcules_envs
from hurcules_envs.environment import Environment, Group, Start

KITCHEN = "envs/assets/kitchen_franka/kitchen_assets/kitchen_env_model.xml"
START = [0.0, -0.5, 0.0, -2.2, 0.0, 0.3, 0.0]
SPEED, RADIUS = 0.25, 0.12  # [m/s] full scale of the action, [m] of the circle


class Circle(Environment):
    """The hand follows a point that goes round."""

    terms = ("distance",)
    task_description = "Follow the point."
    quantities = ("position/end_effector", "velocity/end_effector")
    observation = (Group("way", 3, "m", 2.0), Group("velocity", 3, "m/s", 5.0))

    def __init__(self) -> None:
        """Robot, tasks, channels, loop."""
        path = Path(find_spec("gymnasium_robotics").origin).parent / KITCHEN
        robot = hurcules.Robot(path, joints=[f"robot:panda0_joint{i}" for i in range(1, 8)])
        robot.set_configuration(START)
        hand = hurcules.PositionTask("hand", robot, "end_effector")
        posture = hurcules.PostureTask("posture", robot)
        channels = {"hand": hurcules.Twist(hand, SPEED)}
        controller = hurcules.WholeBodyController(robot, [hand, posture], channels)
        self.simulation = hurcules.Simulation(model=path, controller=controller, record=False)
        self.actions = {"hand": SPEED}
        self.memory = {"centre": 3, "angle": 1}  # what an episode remembers
        self._centre = robot.position("end_effector")

    def start(self, generator):
        """The circle's centre and the point's first angle."""
        centre = self._centre + generator.uniform(-0.05, 0.05, 3)
        return Start(memory={"centre": centre, "angle": generator.uniform(0, 2 * np.pi)})

    def remember(self, numbers):
        """The point goes on by one radian a second."""
        numbers.memory["angle"] += numbers.dt

    def way(self, numbers):
        """From the hand to the point, (n, 3) [m]."""
        angle = numbers["angle"][:, 0]
        circle = np.stack([np.zeros_like(angle), np.cos(angle), np.sin(angle)], axis=1)
        return numbers["centre"] + RADIUS * circle - numbers["position/end_effector"]

    def observe(self, numbers):
        """The way to the point, and the hand's velocity."""
        return {"way": self.way(numbers), "velocity": numbers["velocity/end_effector"]}

    def reward(self, numbers):
        """Minus the distance."""
        return {"distance": -np.linalg.norm(self.way(numbers), axis=1)}

    def succeeded(self, numbers):
        """Nearer than 2 cm."""
        return np.linalg.norm(self.way(numbers), axis=1) < 0.02


def main() -> None:
    """Follows the point by a law of one line, in four episodes side by side."""
    if find_spec("gymnasium_robotics") is None:
        print("gymnasium_robotics is not installed: pip install gymnasium-robotics")
        return
    hurcules_envs.register("Own/Circle-v0", Circle, max_episode_steps=200)
    vector = gymnasium.make_vec("Own/Circle-v0", num_envs=4)
    observation, info = vector.reset(seed=0)
    for _ in range(100):
        observation, _, _, _, info = vector.step(np.clip(observation[:, :3] * 4 / SPEED, -1, 1))
    print("actions:", ", ".join(vector.action_names))
    print("distance of the hand from the point after 5 s:", np.round(-info["reward_distance"], 4))
    print("worst excess over a joint limit, measured:", f"{info['limit_excess'].max():.1e} rad")


if __name__ == "__main__":
    main()
