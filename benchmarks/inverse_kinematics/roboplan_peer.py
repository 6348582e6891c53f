"""roboplan on the common problem: one quadratic program a tick in C++, or two priorities."""

from __future__ import annotations

import numpy as np
from problem import DT, HANDS, Joint, Pose
from roboplan.core import CartesianConfiguration, Scene, loadUrdfSceneDescriptionFromXml
from roboplan.optimal_ik import (
    ConfigurationTask,
    ConfigurationTaskOptions,
    FrameTask,
    FrameTaskOptions,
    Oink,
    PositionLimit,
    VelocityLimit,
)

__all__ = ["Peer"]


class Peer:
    """Two hands and posture (it has no task for the centre of mass); limits; ProxQP."""

    def __init__(self, urdf: str, joints: list[Joint], priorities: bool = True) -> None:
        self.name = "roboplan, " + ("3 priorities" if priorities else "weights")
        self.scene = Scene("g1", loadUrdfSceneDescriptionFromXml(urdf))
        names = self.scene.getJointNames()
        by_name = {joint.name: joint for joint in joints}
        ordered = [by_name[name] for name in names]
        self.order = np.array([names.index(joint.name) for joint in joints])
        self.full = np.array([joint.start for joint in ordered])
        self.scene.setJointPositions(self.full)
        self.oink = Oink(self.scene)
        self.step = np.zeros(self.oink.num_variables)
        start = self.start_poses()
        self.pose = np.eye(4, order="F")
        self.hands = {}
        for level, hand in enumerate(HANDS, 1):
            self._fill(*start[hand])
            aim = CartesianConfiguration("world", hand, self.pose)
            options = FrameTaskOptions(priority=level if priorities else 1)
            self.hands[hand] = FrameTask(self.oink, self.scene, aim, options)
        weights = np.full(len(joints), 1e-3)
        rest = ConfigurationTaskOptions(priority=3 if priorities else 1)
        posture = ConfigurationTask(self.oink, self.full.copy(), weights, rest)
        self.tasks = [*self.hands.values(), posture]
        speeds = np.array([joint.speed for joint in ordered])
        self.limits = [PositionLimit(self.oink), VelocityLimit(self.oink, DT, speeds)]

    @property
    def q(self) -> np.ndarray:
        """The 19 joints, (n,) [rad] or [m]."""
        return self.full[self.order]

    def start_poses(self) -> dict[str, Pose]:
        """Where the hands are."""
        poses = {hand: self.scene.forwardKinematics(self.full, hand) for hand in HANDS}
        return {hand: (pose[:3, :3].copy(), pose[:3, 3].copy()) for hand, pose in poses.items()}

    def aim(self, wanted: dict[str, Pose]) -> None:
        """Tells where the hands shall be."""
        for hand, (rotation, place) in wanted.items():
            self._fill(rotation, place)
            self.hands[hand].setTargetFrameTransform(self.pose)

    def tick(self) -> bool:
        """Moves the robot by one DT; whether there was an answer."""
        try:
            self.oink.solveIk(self.scene, self.tasks, self.limits, [], self.step)
        except RuntimeError:
            return False
        self.full = self.scene.integrate(self.full, self.step)
        self.scene.setJointPositions(self.full)
        return True

    def _fill(self, rotation: np.ndarray, place: np.ndarray) -> None:
        self.pose[:3, :3], self.pose[:3, 3] = rotation, place
