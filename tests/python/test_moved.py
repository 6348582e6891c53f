"""Old names work for one release and say what has taken their place."""

import importlib
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

import hurcules
from hurcules import _moved


@pytest.fixture(autouse=True)
def forgotten() -> Iterator[None]:
    """No old name was imported before, none stays."""

    def forget() -> None:
        for name in list(sys.modules):
            if _moved.new_name(name):
                del sys.modules[name]
        for name in ("trials", "reproduce"):
            vars(hurcules).pop(name, None)

    forget()
    yield
    forget()


@pytest.mark.parametrize(
    ("old", "new"),
    [
        *_moved.MOVED.items(),
        ("hurcules.trials.methods", "hurcules_studies.field_tests.methods"),
        ("hurcules.reproduce.claims", "hurcules_studies.thesis.claims"),
    ],
)
def test_an_old_name_warns_and_is_the_module_at_the_new_place(old: str, new: str) -> None:
    with pytest.warns(DeprecationWarning) as caught:
        module = importlib.import_module(old)
    assert f"{old} has moved to {new};" in str(caught[-1].message)
    assert module is importlib.import_module(new)


def test_an_attribute_of_the_package_warns_once() -> None:
    with pytest.warns(DeprecationWarning, match="hurcules_studies.field_tests") as caught:
        methods = hurcules.trials.METHODS
        again = hurcules.trials.METHODS
    assert methods is again and len(caught) == 1
    assert caught[0].filename == __file__
    with pytest.raises(AttributeError, match="no attribute 'nothing'"):
        _ = hurcules.nothing


def test_a_program_that_uses_old_names_runs_and_is_told(tmp_path: Path) -> None:
    program = tmp_path / "old.py"
    program.write_text(
        "from hurcules import trials\nfrom hurcules.trials.drive import drive_options\n"
        "import hurcules.reproduce\nprint(len(hurcules.reproduce.CLAIMS), len(trials.METHODS))\n"
    )
    done = subprocess.run([sys.executable, program], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert done.stderr.count("DeprecationWarning") == 3
    assert [f"old.py:{line}:" in done.stderr for line in (1, 2, 3)] == [True] * 3


@pytest.mark.parametrize(
    ("old", "new"),
    [("LevelNote", "LevelDiagnostics"), ("Physics", "Plant"), ("ShortTask", "Shortfall")],
)
def test_an_old_name_of_a_class_warns_and_is_the_class(old: str, new: str) -> None:
    with pytest.warns(
        DeprecationWarning, match=f"hurcules.{old} is called hurcules.{new};"
    ) as caught:
        assert getattr(hurcules, old) is getattr(hurcules, new)
    assert caught[0].filename == __file__


def test_old_names_of_attributes_warn_and_do_the_same() -> None:
    robot = hurcules.Robot(hurcules.models.load("rescue"))
    hand = hurcules.PositionTask("hand", robot, "L_tcp")
    with pytest.warns(DeprecationWarning, match="ValueTask.leash is called max_lead;") as caught:
        hand.leash = 0.1
        assert hand.leash == hand.max_lead == 0.1
    assert len(caught) == 2 and caught[0].filename == __file__
    hand.set_target(hand.value + 5.0)  # out of reach
    for controller in (hurcules.VelocityController(robot), hurcules.AccelerationController(robot)):
        controller.set_stack(hurcules.Stack([hand]))
        controller.compute(robot)
        wanted = controller.diagnostics(robot)[-1]
        with pytest.warns(DeprecationWarning, match="notes is called diagnostics;"):
            level = controller.notes(robot)[-1]
        with pytest.warns(DeprecationWarning, match="LevelDiagnostics.shorts is called shortfalls"):
            shorts = level.shorts
        assert level.level == wanted.level == "hand"
        assert [str(short) for short in shorts] == [str(short) for short in wanted.shortfalls]


def test_what_never_existed_is_still_an_import_error() -> None:
    with pytest.raises(ModuleNotFoundError), pytest.warns(DeprecationWarning):
        importlib.import_module("hurcules.trials.nothing")
    with pytest.raises(ModuleNotFoundError):
        importlib.import_module("hurcules.nothing")


def test_what_drove_beside_the_closed_loop_names_what_took_its_place() -> None:
    with pytest.raises(ImportError, match=r"Chassis is gone: hurcules.driving.simulation"):
        from hurcules.driving import Chassis  # noqa: F401
    assert not hasattr(hurcules.driving, "nothing")
