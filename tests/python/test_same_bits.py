"""One seed, one run: `hurcules run`, `hurcules-sim` and the environment give the same bits.

The environment is driven with the operator's commands; half of its full scale is exact in float32.
"""

import io
import subprocess
from pathlib import Path

import numpy as np
import pytest
from rich.console import Console

from hurcules import _exec
from hurcules.run import RunOptions, run
from hurcules_envs.stretch import StretchEnv

SEED, SECONDS = 11, 3.0  # the stretch begins at 2 s


@pytest.fixture(scope="module")
def log(tmp_path_factory: pytest.TempPathFactory) -> dict[str, np.ndarray]:
    """What `hurcules run` wrote."""
    out = tmp_path_factory.mktemp("run")
    options = RunOptions(out=out, seed=SEED, seconds=SECONDS, video=False)
    run(options, Console(file=io.StringIO()))
    with np.load(out / "log.npz") as file:
        return {name: file[name] for name in file.files}


def test_the_program_gives_the_bits_of_the_command(
    log: dict[str, np.ndarray], tmp_path: Path
) -> None:
    table = tmp_path / "log.csv"
    words = ["stretch", "--seed", str(SEED), "--seconds", str(SECONDS), "--csv", str(table)]
    done = subprocess.run([_exec.program(), *words], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    rows = np.loadtxt(table, delimiter=",", skiprows=1)
    names = table.read_text().partition("\n")[0].split(",")
    columns = {name: rows[:, i] for i, name in enumerate(names) if name != "tick_us"}
    assert set(columns) == set(log)
    different = [name for name in log if not np.array_equal(log[name], columns[name])]
    assert different == []


def test_the_environment_gives_the_bits_of_the_command(log: dict[str, np.ndarray]) -> None:
    env = StretchEnv()
    env.reset(seed=SEED)
    for step in range(round(SECONDS / 0.02)):
        env.step(env.operator_action())
        # what the environment stands at is what the next tick of the run sensed
        tick = 20 * (step + 1)
        if tick < len(log["time"]):
            measured = env.simulation.observation()[:13]
            names = [name for name in env.observation_names if name.startswith("q/")]
            assert [log[name][tick] for name in names] == measured.tolist(), f"tick {tick}"
