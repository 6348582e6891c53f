"""30 kg in each hand of the manipulation robot, at carry and at reach (H05).

Strategy: the loads are tied to the hands in `carry`; the arms stretch forward and sideways, and
hold. Lifting them from the ground, and 120 kg with both arms of the rescue robot (H04, P06),
is part of test_transformation.py. Numbers: docs/design/robot.md#postures and #worst-torques.
"""

import mujoco
import numpy as np
import pytest

from hurcules import models, postures
from hurcules_studies.thesis.measures.rig import Load, scene, start, take

FORWARD = {"SP": 1.57, "EB": 0.05}
SIDEWAYS = {"SP": 0.0, "SR": 1.5, "EB": 0.05}
CARRY = {"SP": -0.1, "SR": 0.0, "EB": 1.65}


def loads():
    """30 kg at each hand, where they are in `carry`."""
    model = models.load("manipulation")
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key("carry").id)
    mujoco.mj_forward(model, data)
    return {f"load_{s}": Load(30.0, s, tuple(data.site(f"{s}_tcp").xpos), False) for s in "LR"}


@pytest.mark.slow
def test_thirty_kilograms_in_each_hand_at_carry_and_at_reach():  # H05
    model = scene("manipulation", loads())
    data, player = start(model, "manipulation", "carry", list(loads()))
    for side in "LR":
        take(model, data, "manipulation", f"load_{side}", side)
    # the hands take the weight over two seconds: 60 kg at once shake the arms for long
    ids = [model.body(f"load_{side}").id for side in "LR"]
    for share in np.linspace(1, 0, 41):
        data.xfrc_applied[ids, 2] = share * 30 * 9.81
        player.wait(0.05)
    player.wait(0.5)
    results = [player.wait(1.0, "carry")]
    for name, angles in (("forward", FORWARD), ("back", CARRY), ("sideways", SIDEWAYS)):
        results += player.play([postures.move(name, 6.0, hold=1.0, **angles)])
        for r in results[-1:]:
            worst = max(r.torque, key=r.torque.get)
            print(
                f"{r.name:9} margin {r.margin:.2f} m, torque {r.torque[worst]:.2f} of the peak"
                f" ({worst}), error {1e3 * r.worst_error:.1f} mrad"
            )
    for result in results:
        assert result.collisions == set() and result.margin > 0.05, result.name
        assert result.worst_torque < 1.0 and result.speed < 1.0, result.name
    # [robot#worst-torques] at reach sideways the shoulder bears what statics gives: 459 N m and the
    # weight of the hand's own bush; its motor has 800
    shoulder = abs(data.actuator("LSR").force[0])
    assert shoulder == pytest.approx(459, rel=0.06)
    # the bush of the wrist gives way by 74 N m / 1500 N m/rad at most [robot#worst-torques]
    assert 0.0 < abs(data.joint("LWPS").qpos[0]) < 0.05
