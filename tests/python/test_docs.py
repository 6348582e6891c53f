"""The README and the pages of docs keep their word: Python runs, commands and files exist."""

import re
import subprocess
import sys
import tomllib
from pathlib import Path
from typing import Any

import mujoco
import pytest

import hurcules
from hurcules import cli
from hurcules.recording import CHANNELS, FORCE_CHANNELS, LOAD_CHANNELS, PERSON_CHANNELS
from hurcules.shares import wilson
from hurcules_envs.environment import Environment

SHARE = r"(\d+) of (\d+)[^()|;]{0,90}\((\d+) to (\d+) %\)"  # 19 of 20 (76 to 99 %)
CALLED = r"^\w+$|[A-Za-z_]\w+(?=\()"  # a name alone, or what is called
SLIDES = """
<mujoco>
  <worldbody>
    <body pos="0 0 1">
      <joint name="x" type="slide" axis="1 0 0"/>
      <joint name="y" type="slide" axis="0 1 0"/>
      <joint name="z" type="slide"/>
      <geom size="0.05" mass="1"/>
      <site name="tip"/>
    </body>
  </worldbody>
  <actuator><motor joint="x"/><motor joint="y"/><motor joint="z"/></actuator>
</mujoco>"""


@pytest.fixture(scope="module")
def readme(root: Path) -> str:
    return (root / "README.md").read_text(encoding="utf-8")


def blocks(text: str, language: str) -> list[str]:
    return re.findall(rf"```{language}\n(.*?)```", text, re.DOTALL)


def test_each_python_block_runs(readme: str, root: Path, tmp_path: Path) -> None:
    programs = blocks(readme, "python")
    programs += blocks((root / "README.ko.md").read_text(encoding="utf-8"), "python")
    assert programs
    for program in programs:
        done = subprocess.run(
            [sys.executable, "-W", "error", "-c", program],
            cwd=tmp_path,
            capture_output=True,
            text=True,
            timeout=120,
        )
        assert done.returncode == 0, f"{program}\n{done.stderr}"


def test_the_mission_of_the_loop_runs_where_there_is_no_checkout(
    root: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    page = (root / "docs/loop.md").read_text(encoding="utf-8")
    block = next(block for block in blocks(page, "python") if "longer = " in block)
    monkeypatch.chdir(tmp_path)
    names: dict[str, Any] = {}
    exec(block, names)
    names["simulation"].step(1)
    assert names["simulation"].phase == "wait"


def test_a_mission_of_an_own_robot_is_what_the_page_says(
    root: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    page = (root / "docs/loop.md").read_text(encoding="utf-8")
    table = next(block for block in blocks(page, "toml") if "lower" in block)
    (tmp_path / "lower.toml").write_text(table)
    monkeypatch.chdir(tmp_path)
    model = mujoco.MjModel.from_xml_string(SLIDES)
    robot = hurcules.Robot(model)
    names: dict[str, Any] = {"hurcules": hurcules, "robot": robot, "model": model}
    names["hand"] = hurcules.PositionTask("hand", robot, "tip")
    names["posture"] = hurcules.PostureTask("posture", robot)
    exec(next(block for block in blocks(page, "python") if "lower.toml" in block), names)
    simulation = names["simulation"]
    assert simulation.success and simulation.figures()["hand_error_m"] < 0.02
    assert simulation.data.site("tip").xpos[2] == pytest.approx(0.95, abs=1e-4)


def test_a_hand_goes_to_a_thing_as_the_page_says(root: Path) -> None:
    page = (root / "docs/loop.md").read_text(encoding="utf-8")
    sensor = next(iter(re.findall(r"`(<framepos .*?/>)`", page)))
    lead = next(line for line in re.findall(r"`(lead\.hand = .*?)`", page) if "sensor/" in line)
    cube = '<body name="cube" pos="0.2 -0.1 0.7"><geom size="0.02"/></body></worldbody>'
    text = SLIDES.replace("</worldbody>", cube).replace('"tip"', '"grip"')
    text = text.replace("</mujoco>", f"<sensor>{sensor}</sensor></mujoco>")
    model = mujoco.MjModel.from_xml_string(text)
    robot = hurcules.Robot(model)
    hand = hurcules.PositionTask("hand", robot, "grip")
    controller = hurcules.WholeBodyController(robot, [hand], {"hand": hurcules.Twist(hand, 0.5)})
    phase = {"name": "to it", "stack": "stack", "seconds": 2.0, **tomllib.loads(lead)}
    mission = hurcules.Mission.read({"mission": {"name": "reach"}, "phase": [phase]})
    simulation = hurcules.Simulation(mission, model=model, controller=controller)
    simulation.step(2000)
    assert simulation.success
    assert simulation.data.site("grip").xpos == pytest.approx([0.2, -0.1, 0.8], abs=1e-3)


def test_the_columns_of_the_log_are_those_that_the_page_says(root: Path) -> None:
    page = (root / "docs/loop.md").read_text(encoding="utf-8")
    table = page.partition("| column | value |\n|---|---|\n")[2].partition("\n\n")[0]
    told = [row.strip("|").split("|") for row in table.splitlines()]
    columns = (*CHANNELS, *FORCE_CHANNELS, *PERSON_CHANNELS, *LOAD_CHANNELS)
    assert [(names.replace("`", "").strip(), text.strip()) for names, text in told] == [*columns]


def test_the_loop_on_the_first_screen_has_ten_lines(readme: str) -> None:
    lines = [line for line in blocks(readme, "python")[0].splitlines() if line.strip()]
    assert len(lines) <= 10


def test_every_make_target_that_is_named_exists(readme: str, root: Path) -> None:
    makefile = (root / "Makefile").read_text(encoding="utf-8")
    named = set(re.findall(r"\bmake ([a-z]+)\b", "\n".join(blocks(readme, "sh"))))
    assert {"demo", "test"} <= named
    assert [name for name in named if not re.search(rf"^{name}:", makefile, re.MULTILINE)] == []


def test_every_command_that_is_named_exists(
    readme: str, capsys: pytest.CaptureFixture[str]
) -> None:
    named = set(re.findall(r"^hurcules ([a-z]+)", "\n".join(blocks(readme, "sh")), re.MULTILINE))
    assert {"run", "list", "doctor"} <= named
    for name in named:
        assert cli.main([name, "--help"]) == 0
        assert name in capsys.readouterr().out


def test_every_link_leads_to_a_file(readme: str, root: Path) -> None:
    links = re.findall(r"\]\(([^)#:]+)\)", readme) + re.findall(r'src="([^":]+)"', readme)
    assert links
    assert [link for link in links if not (root / link).exists()] == []


def test_every_link_and_command_in_a_page_leads_to_a_file(root: Path) -> None:
    pages = [*sorted((root / "docs").rglob("*.md")), root / "README.ko.md"]
    assert pages
    makefile = (root / "Makefile").read_text(encoding="utf-8")
    lost = []
    for page in pages:
        text = page.read_text(encoding="utf-8")
        links = [page.parent / link for link in re.findall(r"\]\(([^)#:]+)\)", text)]
        programs = [root / name for name in re.findall(r"`python ([^ `]+)", text)]
        lost += [str(path) for path in links + programs if not path.exists()]
        targets = re.findall(r"`make ([a-z]+)", text)
        lost += [name for name in targets if not re.search(rf"^{name}:", makefile, re.MULTILINE)]
    assert lost == []


def test_the_pictures_are_small(root: Path) -> None:
    kinds = {".png", ".jpg", ".gif"}
    folders = (root / "docs", root / "models" / "assets")
    pictures = [path for one in folders for path in one.rglob("*") if path.suffix in kinds]
    assert pictures
    assert [path.name for path in pictures if path.stat().st_size > 300_000] == []


def test_what_other_packages_call_otherwise_exists_here(root: Path) -> None:
    text = (root / "docs" / "loop.md").read_text(encoding="utf-8")
    tables = re.findall(r"\| there \| here \|\n((?:\|.*\n)+)", text)
    here = "\n".join(row.partition(" | ")[2] for row in "".join(tables).splitlines())
    named = {name for code in re.findall(r"`([^`]+)`", here) for name in re.findall(CALLED, code)}
    assert {"CustomTask", "set_weights", "Delta", "tick", "succeeded"} <= named
    kinds = [one for one in vars(hurcules).values() if isinstance(one, type)]
    known = {name for one in (hurcules, Environment, *kinds) for name in dir(one)}
    others = {"as_matrix", "rotation", "translation", "zeros"}  # of mink and NumPy
    assert named - known == others


def test_the_interval_of_each_share_is_the_one_that_evaluate_tells(root: Path) -> None:
    shares = []
    for page in [root / "README.md", *sorted((root / "docs").glob("*.md"))]:
        shares += re.findall(SHARE, page.read_text(encoding="utf-8"))
    assert len(shares) > 5
    wrong = []
    for successes, n, low, high in (map(int, share) for share in shares):
        ends = zip(wilson(successes, n), (low, high), strict=True)
        if any(abs(100 * end - told) > 0.51 for end, told in ends):
            wrong.append((successes, n, low, high))
    assert wrong == []
