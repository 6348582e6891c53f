"""A controller under random and bad commands (benchmarks/random_ticks.py), on a few robots.

Strategy: both forms of Hurcules and an arm with a closed chain, 6,000 ticks. No limit may be passed
in the command, only bad targets may throw, numbers that are none must lead to braking.
"""

import sys
from importlib import import_module
from pathlib import Path

import mujoco
import pytest

import hurcules

# crank, coupler and rocker; the joints "elbow" and "rocker" follow
LINKAGE = """<mujoco><worldbody>
<body name="base"><joint name="turn" axis="0 0 1" range="-170 170"/><geom size="0.05"/>
  <body name="crank"><joint name="crank" axis="0 1 0" range="-60 60"/>
    <geom type="capsule" fromto="0 0 0 0 0 0.2" size="0.02"/>
    <body name="coupler" pos="0 0 0.2"><joint name="elbow" axis="0 1 0"/>
      <geom type="capsule" fromto="0 0 0 0.45 0 0" size="0.02"/></body></body>
  <body name="rocker" pos="0.4 0 0"><joint name="rocker" axis="0 1 0" range="-60 60"/>
    <geom type="capsule" fromto="0 0 0 0.05 0 0.2958" size="0.02"/></body></body>
</worldbody><equality><connect body1="coupler" body2="rocker" anchor="0.45 0 0"/></equality>
<actuator><motor joint="turn"/><motor joint="crank"/></actuator></mujoco>"""


def test_no_command_leads_beyond_the_limits(root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "path", [str(root / "benchmarks"), *sys.path])
    models = [hurcules.models.load(name) for name in hurcules.models.names()]
    models.append(mujoco.MjModel.from_xml_string(LINKAGE))
    assert hurcules.Robot(models[-1]).followers == ["elbow", "rocker"]
    worst = import_module("random_ticks").run(models, 6_000, seed=1)
    counts = worst.counts
    assert counts.pop("ticks") == 6_000  # none of them threw
    assert counts.pop("refused") > 0
    assert counts.pop("invalid input") > 0
    assert not counts, counts  # nothing accepted, not finite, or without braking
    assert worst.position <= 0.0
    assert worst.velocity <= 1e-12
    assert worst.change <= 1e-12
