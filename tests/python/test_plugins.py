"""What other packages add to the command line, found by entry points.

Strategy: the entry points of this installation, and made-up ones in place of them.
"""

from importlib.metadata import EntryPoint

import pytest

from hurcules import cli, plugins


def test_the_studies_and_environments_are_found() -> None:
    assert list(plugins.commands()) == ["bench", "evaluate", "record", "reproduce", "train"]
    assert [methods.kind for methods in plugins.method_groups()] == ["test methods"]
    assert "e2803" in plugins.method_groups()[0].titles()
    assert "hurcules_envs:Hurcules/Stretch-v0" in plugins.environments()


def test_an_entry_that_cannot_be_loaded_is_left_out_with_a_warning(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    group = "hurcules.environments"
    made_up = [
        EntryPoint("lost", "no_such_package:NAMES", group),
        EntryPoint("found", "string:digits", group),
    ]
    monkeypatch.setattr(plugins, "entry_points", lambda group: made_up)
    assert plugins.environments()[:2] == ["string:0", "string:1"]
    warning = capsys.readouterr().err
    assert warning.startswith("hurcules: warning: no_such_package:NAMES (hurcules.environments)")
    assert warning.count("\n") == 1


def test_without_other_packages_the_product_still_works(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(plugins, "entry_points", lambda group: [])
    assert cli.main(["list"]) == 0
    assert "stretch" in capsys.readouterr().out
    assert cli.main(["run", "e2803"]) == 2
    assert "'e2803' does not exist" in capsys.readouterr().err
