"""pink on the common problem: one weighted quadratic program a tick, its defaults."""

from __future__ import annotations

import numpy as np
import pink
import pinocchio
from pink.tasks import ComTask, FrameTask, PostureTask
from problem import DT, HANDS, Joint, Pose

__all__ = ["Peer"]


class Peer:
    """Two hands, centre of mass, posture; position and velocity limits of the model; daqp."""

    def __init__(self, urdf: str, joints: list[Joint], right_weight: float = 1.0) -> None:
        self.name = "pink" + ("" if right_weight == 1.0 else f", right hand x {right_weight:g}")
        self.model = pinocchio.buildModelFromXML(urdf)
        order = [self.model.joints[self.model.getJointId(joint.name)].idx_q for joint in joints]
        self.order = np.array(order)
        q = np.zeros(self.model.nq)
        q[self.order] = [joint.start for joint in joints]
        self.configuration = pink.Configuration(self.model, self.model.createData(), q)
        weights = dict(zip(HANDS, (right_weight, 1.0), strict=True))
        self.hands = {
            hand: FrameTask(hand, position_cost=weight, orientation_cost=weight)
            for hand, weight in weights.items()
        }
        mass = ComTask(cost=1e-2)
        mass.set_target_from_configuration(self.configuration)
        posture = PostureTask(cost=1e-3)
        posture.set_target_from_configuration(self.configuration)
        self.tasks = [*self.hands.values(), mass, posture]

    @property
    def q(self) -> np.ndarray:
        """The 19 joints, (n,) [rad] or [m]."""
        return self.configuration.q[self.order]

    def start_poses(self) -> dict[str, Pose]:
        """Where the hands are."""
        poses = {}
        for hand in HANDS:
            pose = self.configuration.get_transform_frame_to_world(hand)
            poses[hand] = (pose.rotation.copy(), pose.translation.copy())
        return poses

    def aim(self, wanted: dict[str, Pose]) -> None:
        """Tells where the hands shall be."""
        for hand, (rotation, place) in wanted.items():
            self.hands[hand].set_target(pinocchio.SE3(rotation, place))

    def tick(self) -> bool:
        """Moves the robot by one DT; whether there was an answer."""
        try:
            velocity = pink.solve_ik(self.configuration, self.tasks, DT, solver="daqp")
        except (pink.exceptions.PinkError, RuntimeError):
            return False
        self.configuration.integrate_inplace(velocity, DT)
        return True
