"""mink on the common problem: one weighted quadratic program a tick, its defaults."""

from __future__ import annotations

import mink
import mujoco
import numpy as np
from problem import DT, HANDS, Joint, Pose

__all__ = ["Peer"]


class Peer:
    """Two hands, centre of mass, posture; position and velocity limits; daqp."""

    def __init__(self, urdf: str, joints: list[Joint], right_weight: float = 1.0) -> None:
        self.name = "mink" + ("" if right_weight == 1.0 else f", right hand x {right_weight:g}")
        keep = '<mujoco><compiler fusestatic="false" autolimits="true"/></mujoco>'
        self.model = mujoco.MjModel.from_xml_string(urdf.replace("</robot>", keep + "</robot>"))
        self.configuration = mink.Configuration(self.model)
        self.configuration.update(np.array([joint.start for joint in joints]))
        weights = dict(zip(HANDS, (right_weight, 1.0), strict=True))
        self.hands = {
            hand: mink.FrameTask(hand, "body", position_cost=weight, orientation_cost=weight)
            for hand, weight in weights.items()
        }
        mass = mink.ComTask(cost=1e-2)
        mass.set_target_from_configuration(self.configuration)
        posture = mink.PostureTask(self.model, cost=1e-3)
        posture.set_target_from_configuration(self.configuration)
        self.tasks = [*self.hands.values(), mass, posture]
        speeds = {joint.name: joint.speed for joint in joints}
        self.limits = [mink.ConfigurationLimit(self.model), mink.VelocityLimit(self.model, speeds)]

    @property
    def q(self) -> np.ndarray:
        """The 19 joints, (n,) [rad] or [m]."""
        return self.configuration.q

    def start_poses(self) -> dict[str, Pose]:
        """Where the hands are."""
        poses = {}
        for hand in HANDS:
            pose = self.configuration.get_transform_frame_to_world(hand, "body")
            poses[hand] = (pose.rotation().as_matrix(), pose.translation())
        return poses

    def aim(self, wanted: dict[str, Pose]) -> None:
        """Tells where the hands shall be."""
        for hand, (rotation, place) in wanted.items():
            turn = mink.SO3.from_matrix(rotation)
            self.hands[hand].set_target(mink.SE3.from_rotation_and_translation(turn, place))

    def tick(self) -> bool:
        """Moves the robot by one DT; whether there was an answer."""
        try:
            velocity = mink.solve_ik(
                self.configuration, self.tasks, DT, "daqp", damping=1e-9, limits=self.limits
            )
        except mink.MinkError:
            return False
        self.configuration.integrate_inplace(velocity, DT)
        return True
