"""H05: 30 kg in each hand of the manipulation robot, from the ground to carry and at reach."""

from __future__ import annotations

from functools import cache

import numpy as np

from hurcules import postures
from hurcules.postures import Result
from hurcules_studies.thesis.claim import Finding, Note, Plot, line
from hurcules_studies.thesis.measures.problems import Array
from hurcules_studies.thesis.measures.registry import measures
from hurcules_studies.thesis.measures.rig import Load, acquisition, scene, start, take

MASS = 30.0  # [kg] a hand, Table 4.1
FORWARD = {"SP": 1.57, "EB": 0.05}
SIDEWAYS = {"SP": 0.0, "SR": 1.5, "EB": 0.05}
CARRY = {"SP": -0.1, "SR": 0.0, "EB": 1.65}
ARM = ("SP", "SR", "SY", "EB", "WY", "WP", "WY2")
SAMPLE = 10  # steps between two looks


def loads() -> dict[str, Load]:
    """30 kg at each hand, where they are in the acquisition posture."""
    hands = acquisition("manipulation")
    sites = {side: hands.site(f"{side}_tcp").xpos for side in "LR"}
    return {
        f"load_{side}": Load(MASS, side, (float(x), float(y), float(z)))
        for side, (x, y, z) in sites.items()
    }


@cache
def run() -> tuple[list[Result], Array, Array, Array, list[str]]:
    """The moves; time [s], height of the left load [m], torque shares of the motors, joints."""
    ground = loads()
    model = scene("manipulation", ground)
    data, player = start(model, "manipulation", "acquisition", list(ground))
    player.play([postures.move("settle", 1.0, EB=0.225)])
    for name, load in ground.items():
        take(model, data, "manipulation", name, load.hands)
    rows: list[Array] = []
    heights: list[float] = []

    def watch() -> None:
        if round(data.time / model.opt.timestep) % SAMPLE == 0:
            rows.append(np.concatenate([[data.time], player.controller.torque / player.peak]))
            heights.append(float(data.body("load_L").xpos[2]) - ground["load_L"].position[2])

    player.watch = watch
    results = [*player.play(postures.lift("manipulation")), player.wait(2.0, "carry")]
    for name, angles in (("forward", FORWARD), ("back", CARRY), ("sideways", SIDEWAYS)):
        results += player.play([postures.move(name, 6.0, hold=2.0, **angles)])
    log = np.array(rows)
    return results, log[:, 0], np.array(heights), log[:, 1:], player.joints


@measures("H05")
def thirty_in_each_hand() -> Finding:
    """Lifted, carried, stretched out forward, back, and sideways; no motor at its peak."""
    results, time, height, torque, joints = run()
    arms = [i for i, joint in enumerate(joints) if joint[1:] in ARM]
    shares = np.abs(torque[:, arms])
    worst = int(shares.max(axis=0).argmax())
    lines = [line(name, time, torque[:, joints.index(name)]) for name in ("LSP", "LSR", "LEB")]
    return Finding(
        {
            "height": float(height[-1]),
            "saturated": int(np.sum(np.any(np.abs(torque) >= 1.0, axis=1))),
            "margin": min(result.margin for result in results),
            "collisions": sum(len(result.collisions) for result in results),
        },
        [
            Note(f"largest share of a peak torque of the arms, {joints[arms[worst]]}",
                 float(shares.max())),
            *(Note(f"balance, {one.name}", one.margin, "m") for one in results),
        ],
        [
            Plot("Left load", "time [s]", "height over its place [m]", [line("", time, height)]),
            Plot("Torques of the left arm", "time [s]", "share of the peak", lines),
        ],
    )  # fmt: skip
