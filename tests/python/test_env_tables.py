"""The tables in the text of each environment are compared with its spaces and its reward."""

import re
import subprocess
import sys
from pathlib import Path

import gymnasium
import numpy as np

import hurcules_envs
from environments import env
from hurcules_envs.base import HurculesEnv

__all__ = ["env"]

Table = list[dict[str, str]]


def tables(env: HurculesEnv) -> list[Table]:
    """The tables in the text of an environment's class: a list of rows, each by heading."""
    found: list[Table] = []
    headings: list[str] = []
    for line in (type(env).__doc__ or "").splitlines():
        cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
        if not line.strip().startswith("|"):
            headings = []
        elif not headings:
            headings = cells
            found.append([])
        elif not set(cells[0]) <= {"-"}:
            found[-1].append(dict(zip(headings, cells, strict=True)))
    return found


def span(row: dict[str, str]) -> range:
    first, _, last = row["index"].partition("-")
    return range(int(first), int(last or first) + 1)


def test_the_table_of_actions_is_true(env: HurculesEnv) -> None:
    table = tables(env)[0]
    assert [row["name"] for row in table] == env.action_names
    assert [float(row["scale"]) for row in table] == env.action_scale.tolist()
    assert [row["unit"] for row in table] == env.action_units
    assert [span(row) for row in table] == [range(i, i + 1) for i in range(len(table))]
    assert env.action_space == gymnasium.spaces.Box(-1, 1, (len(table),), np.float32)


def test_the_table_of_observations_is_true(env: HurculesEnv) -> None:
    box = env.observation_space
    assert isinstance(box, gymnasium.spaces.Box)
    spans = [(span(row), row) for row in tables(env)[1]]
    assert [i for indices, _ in spans for i in indices] == list(range(box.shape[0]))
    for indices, row in spans:
        stem = re.sub(r"/[A-Z]$", "", row["name"])
        assert {env.observation_names[i].startswith(f"{stem}/") for i in indices} == {True}, stem
        assert {box.low[i] for i in indices} == {np.float32(row["least"])}
        assert {box.high[i] for i in indices} == {np.float32(row["most"])}
    assert len(env.observation_names) == box.shape[0]


def test_the_table_of_the_reward_is_true(env: HurculesEnv) -> None:
    assert [row["term"] for row in tables(env)[2]] == list(env.terms)


def test_the_coordinates_stand_in_the_order_of_the_text(env: HurculesEnv) -> None:
    text = " ".join((type(env).__doc__ or "").split())
    positions = [name[2:] for name in env.observation_names if name.startswith("q/")]
    assert ", ".join(positions) in text


def test_the_page_of_each_environment_is_the_text_of_the_classes(root: Path) -> None:
    script = root / "benchmarks" / "figures" / "each_environment.py"
    done = subprocess.run([sys.executable, script, "--check"], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    text = (root / "docs" / "each_environment.md").read_text(encoding="utf-8")
    for name in hurcules_envs.ENVIRONMENTS:
        assert name.split("/")[1] in text
    for picture in re.findall(r"!\[.*?\]\((.*?)\)", text):
        assert (root / "docs" / picture).is_file()
