"""Postures: moves as data, the pose transformations of both robots, and their play in the physics.

model = hurcules.models.load("rescue")
data = mujoco.MjData(model)
mujoco.mj_resetDataKeyframe(model, data, model.key("drive").id)
player = postures.Player(model, data)
for result in player.play(postures.stand_up("rescue")):
    print(result.name, result.margin, result.worst_torque)
"""

from hurcules._core import static_margin
from hurcules.postures.moves import Move, bend, move, standing
from hurcules.postures.player import Player, Result, joint_controller, joint_loop, look
from hurcules.postures.scripts import fold_back, lift, lower, stand_up

__all__ = [
    "Move",
    "Player",
    "Result",
    "bend",
    "fold_back",
    "joint_controller",
    "joint_loop",
    "lift",
    "look",
    "lower",
    "move",
    "stand_up",
    "standing",
    "static_margin",
]
