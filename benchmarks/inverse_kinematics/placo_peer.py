"""placo on the common problem: one weighted quadratic program a tick, in C++."""

from __future__ import annotations

import tempfile
from pathlib import Path

import numpy as np
import placo
from problem import DT, HANDS, Joint, Pose

__all__ = ["Peer"]


class Peer:
    """Two hands (soft), centre of mass, posture; position and velocity limits; qpmad."""

    def __init__(self, urdf: str, joints: list[Joint], right_weight: float = 1.0) -> None:
        self.name = "placo" + ("" if right_weight == 1.0 else f", right hand x {right_weight:g}")
        self.names = [joint.name for joint in joints]
        with tempfile.TemporaryDirectory() as folder:
            Path(folder, "robot.urdf").write_text(urdf)
            self.robot = placo.RobotWrapper(folder, placo.Flags.ignore_collisions)
        for joint in joints:
            self.robot.set_joint(joint.name, joint.start)
            self.robot.set_velocity_limit(joint.name, joint.speed)
        self.robot.update_kinematics()
        self.solver = placo.KinematicsSolver(self.robot)
        self.solver.mask_fbase(True)
        self.solver.dt = DT
        self.solver.enable_joint_limits(True)
        self.solver.enable_velocity_limits(True)
        self.hands = {}
        for hand, weight in zip(HANDS, (right_weight, 1.0), strict=True):
            self.hands[hand] = self.solver.add_frame_task(hand, self.robot.get_T_world_frame(hand))
            self.hands[hand].configure(hand, "soft", weight, weight)
        self.solver.add_com_task(self.robot.com_world()).configure("com", "soft", 1e-4)
        posture = self.solver.add_joints_task()
        posture.set_joints({joint.name: joint.start for joint in joints})
        posture.configure("posture", "soft", 1e-6)
        self.pose = np.eye(4)

    @property
    def q(self) -> np.ndarray:
        """The 19 joints, (n,) [rad] or [m]."""
        return np.array([self.robot.get_joint(name) for name in self.names])

    def start_poses(self) -> dict[str, Pose]:
        """Where the hands are."""
        poses = {hand: self.robot.get_T_world_frame(hand) for hand in HANDS}
        return {hand: (pose[:3, :3].copy(), pose[:3, 3].copy()) for hand, pose in poses.items()}

    def aim(self, wanted: dict[str, Pose]) -> None:
        """Tells where the hands shall be."""
        for hand, (rotation, place) in wanted.items():
            self.pose[:3, :3], self.pose[:3, 3] = rotation, place
            self.hands[hand].T_world_frame = self.pose

    def tick(self) -> bool:
        """Moves the robot by one DT; whether there was an answer."""
        try:
            self.solver.solve(True)
        except RuntimeError:
            return False
        self.robot.update_kinematics()
        return True
