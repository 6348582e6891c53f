"""Force control by torques in the physics, on still and moving walls (benchmarks/force_torques.py).

Strategy: an arm with motors alone, one-sided springs of 1e3 to 1e5 N/m. The force must be reached
without an error, an impact be no harder than that of a plain admittance of the same compliance, and
a moving wall leave less than what the first-order law alone says: amplitude of its speed / C. What
a model misses must not be magnified.
"""

import sys
from importlib import import_module
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest


@pytest.fixture
def study(root: Path, monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    monkeypatch.setattr(sys, "path", [str(root / "benchmarks"), *sys.path])
    return import_module("force_torques")


@pytest.mark.parametrize("stiffness", [1e3, 1e4, 1e5])
@pytest.mark.parametrize("force", [5.0, 50.0])
def test_torques_reach_the_force_without_a_harder_impact(
    study: ModuleType, stiffness: float, force: float
) -> None:
    wall = study.Wall(stiffness)
    ours, plain = study.Press(wall, force, 30.0).run(3.5), study.Press(wall, force, 30.0, 0.0)
    assert ours.settled == pytest.approx(force, rel=1e-3)
    assert ours.deviation(force, 0.5) < 0.01 * force
    assert ours.peak < 1.2 * plain.run(3.0).peak


def test_a_moving_wall_is_followed(study: ModuleType) -> None:
    wall = study.Wall(1e4, stroke=0.005)
    by_the_law_alone = np.pi * 0.005 * 1e4 / 100.0 / np.sqrt(2.0)
    plain = study.Press(wall, 20.0, 100.0, 0.0).run(4.0).deviation(20.0, 2.0)
    assert plain == pytest.approx(by_the_law_alone, rel=0.1)
    assert study.Press(wall, 20.0, 100.0).run(4.0).deviation(20.0, 2.0) < 0.25 * by_the_law_alone


def test_a_bias_of_the_sensor_is_not_magnified(study: ModuleType) -> None:
    # without what the torques bear: 0.5 N / (damping C m_eff), several newtons
    pressed = study.Press(study.Wall(1e4), 20.0, 30.0, bias=0.5).run(3.5)
    assert pressed.settled == pytest.approx(20.0, abs=0.5)
