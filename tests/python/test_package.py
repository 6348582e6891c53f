"""The package as installed: versions, names, models, and the message when MuJoCo is another.

Strategy: another MuJoCo is simulated by a module of that name. Not tested: the loader's own refusal
of another libmujoco.
"""

import importlib
import inspect
import os
import re
import subprocess
import sys
import tomllib
from pathlib import Path
from types import ModuleType

import pytest

import hurcules
from hurcules import _core, _exec, _version, doctor, mjcf, models


@pytest.fixture(scope="module")
def pyproject(root: Path) -> dict[str, dict[str, object]]:
    return tomllib.loads((root / "pyproject.toml").read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def pin(root: Path) -> str:
    match = re.search(r'"mujoco==([\d.]+)"', (root / "pyproject.toml").read_text(encoding="utf-8"))
    assert match
    return match[1]


def test_version_stands_in_pyproject_alone(pyproject: dict[str, dict[str, object]]) -> None:
    assert hurcules.__version__ == pyproject["project"]["version"] == _core.build["version"]


def test_mujoco_is_the_pinned_one_at_build_and_at_run_time(pin: str) -> None:
    assert _version.wanted_mujoco() == pin == _core.build["mujoco"]


def test_mujoco_is_pinned_in_one_place(root: Path, pin: str) -> None:
    listed = subprocess.run(["git", "ls-files"], cwd=root, capture_output=True, text=True)
    if listed.returncode != 0:
        pytest.skip("not a git checkout")
    prose = {".md", ".xml", ".obj", ".png", ".html", ".json"}
    files = [root / name for name in listed.stdout.splitlines() if Path(name).suffix not in prose]
    holders = {
        str(file.relative_to(root))
        for file in files
        if file.is_file() and pin in file.read_text(encoding="utf-8", errors="ignore")
    }
    assert holders == {"pyproject.toml"}


def test_gymnasium_is_one_that_knows_how_vectors_reset(root: Path) -> None:
    """1.0 has no AutoresetMode: pip left it beside d3rlpy, and no environment could be made."""
    text = (root / "pyproject.toml").read_text(encoding="utf-8")
    least = re.search(r'"gymnasium>=(\d+)\.(\d+)"', text)
    assert least is not None
    assert (int(least[1]), int(least[2])) >= (1, 1)


@pytest.mark.parametrize(("module", "came"), [("3.0.0", "3.0.0"), (None, "none")])
def test_another_mujoco_gives_one_clear_message(
    monkeypatch: pytest.MonkeyPatch, pin: str, module: str | None, came: str
) -> None:
    fake = None if module is None else ModuleType("mujoco")
    if fake is not None:
        fake.__dict__["__version__"] = module
    monkeypatch.setitem(sys.modules, "mujoco", fake)
    with pytest.raises(ImportError) as caught:
        _version.require_mujoco()
    message = str(caught.value)
    assert f"needs MuJoCo {pin}" in message
    assert f"installed is {came}" in message
    assert f"pip install mujoco=={pin}" in message


def test_import_with_another_mujoco_ends_with_that_message(tmp_path: Path, pin: str) -> None:
    (tmp_path / "mujoco.py").write_text('__version__ = "2.3.7"\n')
    run = subprocess.run(
        [sys.executable, "-c", "import hurcules"],
        env={**os.environ, "PYTHONPATH": str(tmp_path)},
        capture_output=True,
        text=True,
    )
    assert run.returncode == 1
    assert run.stderr.splitlines()[-1].startswith(
        f"ImportError: hurcules {hurcules.__version__} needs MuJoCo {pin}, installed is 2.3.7"
    )


@pytest.mark.parametrize(
    "name",
    [
        "hurcules",
        "hurcules.models",
        "hurcules.rhqp",
        "hurcules.doctor",
        "hurcules.scenes",
        "hurcules.casualties",
        "hurcules.driving",
        "hurcules.plugins",
        "hurcules_studies.field_tests",
        "hurcules_studies.thesis",
    ],
)
def test_all_names_exactly_what_is_there(name: str) -> None:
    module = importlib.import_module(name)
    assert len(set(module.__all__)) == len(module.__all__)
    assert [entry for entry in module.__all__ if not hasattr(module, entry)] == []


def test_what_completes_names_sees_those_that_are_meant_to_be_used() -> None:
    assert dir(hurcules) == sorted(hurcules.__all__)
    assert "Robot" in dir(hurcules) and "warnings" not in dir(hurcules)


def test_what_a_compiled_class_takes_is_its_signature() -> None:
    class Height(hurcules.CustomTask):
        def __init__(self, frame: str) -> None:
            """Made in another way."""

    class Same(hurcules.CustomTask):
        pass

    taken = inspect.signature(hurcules.PositionTask).parameters
    assert [*taken] == ["name", "robot", "frame", "reference", "axes"]
    assert taken["frame"].default is inspect.Parameter.empty
    assert str(taken["reference"]) == "reference: str = ''"
    servo = inspect.signature(hurcules.WholeBodyController).parameters["servo"]
    assert servo.kind is inspect.Parameter.KEYWORD_ONLY and str(servo.default) == "{}"
    assert [*inspect.signature(hurcules.Robot).parameters] == ["model", "joints", "floating"]
    assert [*inspect.signature(Height).parameters] == ["frame"]
    assert [*inspect.signature(Same).parameters] == ["name", "robot", "rows", "measure", "unit"]
    assert "mission" in inspect.signature(hurcules.Simulation).parameters


def test_error_is_a_value_error_of_the_package() -> None:
    assert issubclass(hurcules.Error, ValueError)
    assert f"{hurcules.Error.__module__}.{hurcules.Error.__qualname__}" == "hurcules.Error"


def test_the_program_lies_beside_the_module_and_runs() -> None:
    program = _exec.program()
    assert program.is_file()
    run = subprocess.run([program, "no-such-mission"], env={}, capture_output=True, text=True)
    assert run.returncode == 2, run.stderr
    assert "no-such-mission" in run.stderr


@pytest.mark.parametrize("scene", models.scenes())
def test_every_scene_compiles_with_a_robot(scene: str) -> None:
    assert models.load("rescue", scene=scene).nq > 0


@pytest.mark.parametrize("name", models.names())
def test_every_robot_compiles_on_flat_ground(name: str) -> None:
    assert models.path(name).is_file()
    assert models.load(name).nq > 0


def test_unknown_names_are_answered_with_those_that_exist() -> None:
    with pytest.raises(hurcules.Error, match=r"robot 'nobody' does not exist; there are: .*rescue"):
        models.load("nobody")
    with pytest.raises(hurcules.Error, match=r"scene 'nowhere' does not exist; there are: .*flat"):
        models.load("rescue", scene="nowhere")
    with pytest.raises(hurcules.Error, match="made for robot 'rescue', not 'manipulation'"):
        models.load("manipulation", mission="stretch")
    with pytest.raises(
        hurcules.Error, match=r"'nothing' does not exist; there are: .*rescue.*stretch"
    ):
        models.path("nothing")


@pytest.mark.parametrize(
    ("scene", "says"), [("<mujoco><worldbdy/></mujoco>", "worldbdy"), ("<mujoco>", "line")]
)
def test_broken_mjcf_gives_the_text_of_what_is_wrong(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, scene: str, says: str
) -> None:
    for kind, text in (("robots", "<mujoco><size/></mujoco>"), ("scenes", scene)):
        (tmp_path / kind).mkdir()
        (tmp_path / kind / "x.xml").write_text(text)
    monkeypatch.setattr(mjcf, "folder", lambda: tmp_path)
    with pytest.raises(hurcules.Error, match=says):
        models.load("x", scene="x")


def test_doctor_names_a_remedy_for_whatever_is_not_well() -> None:
    findings = doctor.examine()
    assert [f.what for f in findings if f.status != "ok" and not f.remedy] == []
    broken = [f for f in findings if f.status == "broken"]
    assert broken == []


def test_a_renderer_that_fails_is_reported_not_raised() -> None:
    assert doctor.render_with("no-such-backend") != ""
