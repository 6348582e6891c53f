"""Moves of joints and a stack take turns in one closed loop.

Strategy: a move, then the hand led by the stack, then a rest: nothing jumps when one follows the
other. Moves alone: test_transformation.py; follow and watch: test_power.py.
"""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

import hurcules
from hurcules import _core, models, postures

RISE = 0.03  # [m/s] of the left hand


@pytest.fixture
def player() -> postures.Player:
    model = models.load("rescue")
    robot = hurcules.Robot(model)
    robot.set_keyframe("ready")
    robot.stand_on("lower_leg_L")
    hand = hurcules.PositionTask("hand", robot, "L_tcp")
    controller = hurcules.WholeBodyController(
        robot,
        [hand, hurcules.PostureTask("rest", robot)],
        {"hand": hurcules.Twist(hand, 1.0)},
        feed_forward=False,
    )
    options = hurcules.SimulationOptions(record=False, max_seconds=4.0)
    data = mujoco.MjData(model)
    simulation = _core.Simulation(model, data, controller, options)
    return postures.Player(model, data, simulation=simulation)


def test_a_stack_goes_on_from_a_move_and_a_move_from_a_stack(player: postures.Player) -> None:
    tip = player.data.site("L_tcp").xpos
    player.play([postures.move("bend", 1.0, hold=0.5, LEB=1.6)])
    assert player.controller.active is None
    before = tip.copy()
    result = player.rule("rise", 1000, lambda i: [0.0, 0.0, RISE if i < 500 else 0.0])
    assert player.controller.active == "stack"
    moved = tip - before
    assert moved == pytest.approx([0.0, 0.0, 0.5 * RISE], abs=2e-3)
    assert result.worst_error < 7e-3 and result.speed < 1.0 and not result.collisions
    # places of the servos, not where the move had left them
    assert np.abs(player.reference - player.controller.joint_places).max() == 0.0
    before = tip.copy()
    assert player.wait(0.5).worst_error < 7e-3
    assert np.linalg.norm(tip - before) < 1e-3


def test_a_run_that_is_over_is_said(player: postures.Player) -> None:
    player.wait(4.0)
    with pytest.raises(hurcules.Error, match="the run is over: time is up"):
        player.wait(0.1)


def test_a_player_steps_a_plant_that_shows_itself(player: postures.Player) -> None:
    plant = player.simulation.plant
    plant.brakes.reset(True)
    player.wait(0.1)
    assert plant.is_sound and plant.brakes.is_shut("LEB")
    assert not player.controller.torque.any()  # behind shut brakes the motors rest
