"""Mistakes in a mission's file: one sentence with what was wanted, what came, file and row.

Strategy: the small table of test_mission_table.py with one thing wrong; files that include each
other; what is told without a controller, and by the command.
"""

from __future__ import annotations

import re
import warnings
from pathlib import Path

import numpy as np
import pytest

import hurcules
from hurcules import Error, Mission, cli
from test_mission_table import ARM, ROWS, loop, read

DONE = 'done = ["q/j1 <= -0.45 for 0.1 s"]'
KEYS = "keys = [{ share = 0.5, j1 = -0.2 }, { share = 1.0, j1 = -0.5, j2 = 0.3 }]"
LATE = 'late = ["hold 0.5 s", "back to up, 2 times", "abort"]'
TROUBLE = 'trouble = [{ when = "q/j2 >= 2.0", do = ["ask 5.0 s", "lower"] }]'
LEAD = "lead.posture = { rate = [0.5, 0.0], way = 0.2 }"
MONITOR = '[[monitor]]\nwhen = "q/j1 >= 1.5"\ndo = ["abort"]\nphases = ["up"]\n'

FIGURE = '[[figure]]\nname = "reached_rad"\nquantity = "q/j1"\n'
NO_PHASES = MONITOR.replace('["up"]', "[]") + "[[figure]]"


@pytest.mark.parametrize(
    "old, new, wanted",
    [
        (DONE, "done = [1]", "phase 'up', done: wanted a text, got 1"),
        (DONE, 'done = "q/j1 <= 0"', "phase 'up', done: wanted a list of texts, got 'q/j1 <= 0'"),
        (DONE, 'done = ["q/j1 < 0"]', "phase 'up', done: condition 'q/j1 < 0': wanted"),
        (LATE, 'late = "abort"', "phase 'up', late: wanted a list of texts, got 'abort'"),
        (LATE, "late = 3", "phase 'up', late: wanted a list of texts, got 3"),
        (LATE, 'late = ["stop"]', "phase 'up', late: reaction 'stop': wanted"),
        (KEYS, "keys = { j1 = 1.0 }", "phase 'up', keys: wanted a list of tables, got {'j1': 1.0}"),
        (KEYS, 'keys = [{ j1 = "0.3" }]', "phase 'up', keys, j1: wanted a number, got '0.3'"),
        (TROUBLE, "trouble = 1", "phase 'up', trouble: wanted a list of tables, got 1"),
        (TROUBLE, 'trouble = [{ do = ["abort"] }]', "phase 'up', trouble wants when"),
        (LEAD, "lead = 1", "phase 'back', lead: wanted a table, got 1"),
        (LEAD, "lead.posture = 1", "phase 'back', lead.posture: wanted a table, got 1"),
        (LEAD, "lead.posture = { by = 0.1 }", "by: wanted a list of numbers, got 0.1"),
        (LEAD, "seconds = 1.0\npark = 2", "phase 'back', park: wanted a table, got 2"),
        ("within = 3.0", "within = true", "phase 'up', within: wanted a number, got True"),
        ("seconds = 1.0", 'seconds = "1 s"', "phase 'up', seconds: wanted a number, got '1 s'"),
        ("[[figure]]", "[figure]", "figure: wanted a list of tables, got {'most': -0.4"),
        ("[[figure]]", "[monitor]\n[[figure]]", "monitor: wanted a list of tables, got {}"),
        ('phases = ["up"]', 'phases = "up"', "phases: wanted a list of texts, got 'up'"),
        ("[[figure]]", NO_PHASES, "monitor 'q/j1 >= 1.5': phases names none; there are: up"),
        ('[mission]\nname = "wave"\nsafety = "back"', "mission = 1", "mission: wanted a table"),
        ('name = "wave"', "name = 5", "[mission], name: wanted a text, got 5"),
        ('name = "wave"', "", "[mission] wants name"),
        ('name = "back"\nstack', "stack", "phase 2 wants a name"),
        ('name = "back"\nstack', 'name = "up"\nstack', "two phases are called 'up'"),
        ("seconds = 1.0", "secods = 1.0", "no entry 'secods'; is it 'seconds'? there are: name"),
        # times, ways and postures
        ("within = 3.0", "", "phase 'up', late: it wants `within`"),
        (LATE, "", "phase 'up': within wants `late`, what is done when"),
        ("within = 3.0", "within = 0.5", "'up' is always late: it takes 1 s, within wants as much"),
        ("back to up", "back to top", "phase 'up', late: phase 'top' does not exist; there are"),
        ("rate = [0.5, 0.0]", "rate = [0.0, 0.0]", "never gives its way: its rate is 0"),
        ("[[figure]]", FIGURE + "[[figure]]", "two figures are called 'reached_rad'"),
    ],
)
def test_a_file_is_told_with_its_row_when_it_is_read(
    old: str, new: str, wanted: str, tmp_path: Path
) -> None:
    assert old in ROWS
    file = tmp_path / "wave.toml"
    file.write_text(ROWS.replace(old, new, 1))
    with pytest.raises(Error) as raised:
        Mission.load(file)
    assert str(raised.value).startswith(f"{file}: ")
    assert wanted in str(raised.value)
    assert "\n" not in str(raised.value)


@pytest.mark.parametrize(
    "old, new, wanted",
    [
        ("j1 = -0.5, j2", "j1 = 45, j2", "coordinate 'j1' goes from -3 to 3, 45 came (angles are"),
        (LEAD, "seconds = 0.1\nlead.posture = { by = [0.0, 0.2] }", "wants 0.1875 s, seconds are"),
        ('name = "wave"', 'name = "wave"\nsupport = "uper"', "[mission]: frame 'uper' does not"),
        ('name = "wave"', 'name = "wave"\nmax_seconds = nan', "max_seconds wants a time above 0"),
        ('name = "wave"', 'name = "wave"\nmax_tilt = -1', "max_tilt wants an angle from 0"),
        ('name = "wave"', 'name = "wave"\nmax_tilt = 20', "to pi [rad], 20 came"),
        ('name = "wave"', 'name = "wave"\nmin_height = 1', "min_height wants a max_tilt above 0"),
        ('"reached_rad"', '"power_W"', "figure 'power_W': every run has one of this name"),
        ("q/j1 <=", "qdes/j1 <=", "quantity 'qdes/j1' does not exist; there are: q_des/j1, q"),
    ],
)
def test_what_does_not_fit_the_robot_is_told(old: str, new: str, wanted: str) -> None:
    assert old in ROWS
    with pytest.raises(Error) as raised:
        loop(ROWS.replace(old, new, 1))
    assert wanted in str(raised.value)
    assert len(str(raised.value)) < 400


def test_a_row_that_is_never_reached_is_warned_of() -> None:
    rows = ROWS.replace("seconds = 1.0", "seconds = 1.0\nlast = true", 1)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        read(rows)  # `safety` names the row behind the last one
    more = '[[phase]]\nname = "{}"\nstack = "posture"\n\n'
    rows = rows.replace('safety = "back"\n', "").replace('"lower"', '"abort"')
    with pytest.warns(UserWarning, match="phase 'back' is never reached: .*; nor are 1 others"):
        read(rows.replace("[[figure]]", more.format("after") + "[[figure]]"))


def test_two_leads_of_a_channel_are_refused() -> None:
    mission = read(ROWS)
    up, back = mission.rows.phases
    for phase in (
        hurcules.Phase(name="twice", stack="posture", leads=[*back.leads, *back.leads]),
        hurcules.Phase(
            name="twice", stack="posture", seconds=1.0, leads=back.leads,
            posture=up.posture, keys=up.keys,
        ),
    ):  # fmt: skip
        with pytest.raises(Error, match="phase 'twice': channel 'posture' is led twice"):
            hurcules._core.check_rows(hurcules.MissionTable(phases=[phase]))


def test_a_byte_order_mark_is_none_of_the_table(tmp_path: Path) -> None:
    (tmp_path / "wave.toml").write_text(ROWS, encoding="utf-8-sig")
    (tmp_path / "plain.toml").write_text(ROWS)
    assert Mission.load(tmp_path / "wave.toml") == Mission.load(tmp_path / "plain.toml")


def test_files_that_include_each_other_are_told(tmp_path: Path) -> None:
    include = '[mission]\nname = "{}"\n[[phase]]\ninclude = "{}"\nrows = {}\n'
    (tmp_path / "one.toml").write_text(include.format("one", "one.toml", '["a", "b"]'))
    with pytest.raises(Error, match=r"one.toml: phase 1, include of 'one.toml': .* itself"):
        Mission.load(tmp_path / "one.toml")
    (tmp_path / "two.toml").write_text(include.format("two", "one.toml", '["a", "b"]'))
    (tmp_path / "one.toml").write_text(include.format("one", "two.toml", '["a", "b"]'))
    with pytest.raises(Error, match=r"include of 'two.toml': the file includes itself"):
        Mission.load(tmp_path / "two.toml")
    (tmp_path / "wave.toml").write_text(ROWS.replace(DONE, "done = [1]"))
    for file, rows, wanted in (
        ("wave.toml", '["up", "back"]', "wave.toml, phase 'up', done: wanted a text, got 1"),
        ("wave.toml", "2", "phase 1, rows: wanted a list of texts, got 2"),
        ("wave.toml", '["up", "bak"]', "got ['up', 'bak']; there are: up, back"),
        ("none.toml", '["up", "back"]', "No such file"),
    ):
        (tmp_path / "two.toml").write_text(include.format("two", file, rows))
        with pytest.raises(Error, match=re.escape(wanted)) as raised:
            Mission.load(tmp_path / "two.toml")
        assert str(raised.value).startswith(f"{tmp_path / 'two.toml'}: ")


def test_the_commands_tell_file_and_row(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    own = tmp_path / "own.toml"
    head = '[mission]\nname = "own"\nscene = "lift"\n[[phase]]\nname = "a"\nseconds = 1.0\n'
    table = str(tmp_path / "own.table")
    for rest, words, wanted in (
        ('stack = "arms"\ndone = [1]', ["mission"], "phase 'a', done: wanted a text"),
        ('stack = "arms"\nwithin = 0', ["mission"], "phase 'a': within wants a time above 0"),
        ('stack = "arm"', ["mission", "--out", table], "phase 'a': stack 'arm' does not exist"),
        ('stack = "arm"', ["run"], "phase 'a': stack 'arm' does not exist"),
    ):
        own.write_text(f"{head}{rest}\n")
        assert cli.main([words[0], str(own), *words[1:]]) == 2
        told = capsys.readouterr().err
        assert wanted in told
        assert str(own) in told
    assert not (tmp_path / "own.table").exists()


def test_a_robot_that_cannot_tip_over_has_no_margins() -> None:
    trouble = 'trouble = [{ when = "monitor/static_margin_m <= 0.01", do = ["abort"] }]'
    simulation = loop(ROWS.replace(TROUBLE, trouble))
    simulation.step(5000)
    assert simulation.success, simulation.reason
    assert np.isnan(simulation.log()["monitor/static_margin_m"]).all()
    assert not [text for _, text in simulation.events() if "alarm" in text]
    margins = ("static_margin_m", "pressure_margin_m", "tip_angle_rad", "energy_margin_J")
    assert all(np.isnan(simulation.monitors()[name]) for name in margins)
    simulation.restore(simulation.state())
    assert "freejoint" not in ARM
