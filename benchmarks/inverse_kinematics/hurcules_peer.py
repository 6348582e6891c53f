"""Hurcules on the common problem: strict levels, defaults."""

from __future__ import annotations

import mujoco
import numpy as np
from problem import DT, HANDS, Joint, Pose

import hurcules
from hurcules import OrientationTask, PositionTask, PostureTask, Stack

__all__ = ["Peer"]


class Peer:
    """limits < right hand < left hand < right turn < left turn [< waist] < mass centre < posture.

    Args:
        urdf: the robot as text.
        joints: its 19 joints.
        levels: 4 (both turns of the hands on one level, no centre of mass) to 7.
    """

    def __init__(self, urdf: str, joints: list[Joint], levels: int = 6) -> None:
        self.name = f"hurcules, {levels} levels"
        self.model = mujoco.MjModel.from_xml_string(with_hands(urdf))
        self.robot = hurcules.Robot(self.model)
        self.robot.set_configuration([joint.start for joint in joints])
        limits = hurcules.JointLimits("limits", self.robot)
        for joint in joints:
            limits.set_max_velocity(joint.name, joint.speed)
        self.places = {hand: PositionTask(f"{hand} place", self.robot, hand) for hand in HANDS}
        self.turns = {hand: OrientationTask(f"{hand} turn", self.robot, hand) for hand in HANDS}
        right, left = HANDS
        mass = hurcules.CenterOfMassTask("com", self.robot)
        posture = PostureTask("posture", self.robot)
        waist = PostureTask("waist", self.robot, ["waist_roll_joint", "waist_pitch_joint"])
        rest = {
            4: [[self.turns[right], self.turns[left]], posture],
            5: [[self.turns[right], self.turns[left]], mass, posture],
            6: [self.turns[right], self.turns[left], mass, posture],
            7: [self.turns[right], self.turns[left], waist, mass, posture],
        }[levels]
        self.controller = hurcules.VelocityController(
            self.robot, hurcules.VelocityControllerOptions(dt=DT)
        )
        self.controller.set_stack(Stack([limits, self.places[right], self.places[left], *rest]))
        self.q = self.robot.configuration

    def start_poses(self) -> dict[str, Pose]:
        """Where the hands are."""
        return {hand: (self.robot.orientation(hand), self.robot.position(hand)) for hand in HANDS}

    def aim(self, wanted: dict[str, Pose]) -> None:
        """Tells where the hands shall be."""
        for hand, (rotation, place) in wanted.items():
            self.places[hand].set_target(place)
            self.turns[hand].set_target(rotation)

    def tick(self) -> bool:
        """Moves the robot by one DT; whether there was an answer."""
        self.q = self.controller.step(self.robot)
        return bool(np.isfinite(self.q).all())


def with_hands(urdf: str) -> str:
    """MuJoCo melts links behind fixed joints into their parents unless it is told not to."""
    keep = '<mujoco><compiler fusestatic="false" strippath="true" autolimits="true"/></mujoco>'
    return urdf.replace("</robot>", keep + "</robot>")
