"""`hurcules reproduce`: the list, which claims are meant, the judge, workers, resuming, Ctrl-C.

Strategy: the judge and the choice of ids on small examples; the command as a program of its own,
with a handful of quick claims; a worker that dies, by a stand-in. What the claims measure:
test_claims.py.
"""

from __future__ import annotations

import json
import os
import re
import signal
import subprocess
import sys
import time
from collections import Counter
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

import hurcules
from hurcules_studies.thesis import CLAIMS, Claim, Expected, Finding, Verdict, page, run
from hurcules_studies.thesis import table as claims_table
from hurcules_studies.thesis.claim import (
    ALGORITHM_1,
    DEFAULT,
    DLS_HQP,
    HQP,
    Note,
    Plot,
    line,
    most,
)
from hurcules_studies.thesis.judge import judge
from hurcules_studies.thesis.measures import measured
from hurcules_studies.thesis.measures.registry import FUNCTIONS
from hurcules_studies.thesis.result import dump, from_finding, load, without_finding
from hurcules_studies.thesis.runner import Runner, kept
from hurcules_studies.thesis.select import select
from hurcules_studies.thesis.worker import examine, keep

QUICK = ["R14", "R18", "R20", "R24"]
COMMAND = [sys.executable, "-c", "import sys; from hurcules.cli import main; sys.exit(main())"]


def call(*arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [*COMMAND, "reproduce", *arguments], capture_output=True, text=True, timeout=600
    )


def rows(out: Path) -> dict[str, dict[str, Any]]:
    found = json.loads((out / "claims.json").read_text(encoding="utf-8"))["claims"]
    return {one["id"]: one for one in found}


# ---- the list


def test_the_list_has_112_claims() -> None:
    counts = Counter(name[0] for name in CLAIMS)
    wanted = {"R": 26, "E": 5, "H": 19, "M": 20, "S": 6, "F": 7, "K": 20, "P": 9}
    assert counts == wanted
    assert [name for name, claim in CLAIMS.items() if claim.id != name] == []
    assert all(claim.source and claim.statement for claim in CLAIMS.values())


def test_what_is_measured_has_numbers_to_be_judged_by_and_the_other_way_round() -> None:
    with_numbers = {name for name, claim in CLAIMS.items() if claim.expected}
    assert set(measured()) == with_numbers
    assert with_numbers == set(CLAIMS)


def test_a_number_that_is_explained_says_why_and_lies_elsewhere() -> None:
    for claim in CLAIMS.values():
        for one in claim.expected.values():
            assert (one.ours is None) == (not one.why)
            assert one.low <= one.high


def test_solvers_are_named_where_a_hierarchy_is_solved() -> None:
    known = {DEFAULT, ALGORITHM_1, HQP, DLS_HQP}
    named = {name: set(claim.solvers) for name, claim in CLAIMS.items()}
    assert all(solvers <= known for solvers in named.values())
    # the solver, its examples, manipulation, stretch: all; hardware and servo: where one plans
    assert [name for name in named if name[0] in "REMSK" and not named[name]] == []
    assert {name for name in named if name[0] in "HP" and named[name]} == {"H17", "H18", "H19"}
    # what a number's words say of a method is among the methods
    for name, claim in CLAIMS.items():
        for one in claim.expected.values():
            if one.what.endswith(("RHQP", "Algorithm 1")):
                assert ALGORITHM_1 in named[name], (name, one.what)


# ---- which claims are meant


@pytest.mark.parametrize(
    ("words", "ids"),
    [
        (["M05"], ["M05"]),
        (["m05", "R01"], ["R01", "M05"]),
        (["K1"], [f"K1{i}" for i in range(10)]),
        (["R24-E02"], ["R24", "R25", "R26", "E01", "E02"]),
        (["S01..03,P09"], ["S01", "S02", "S03", "P09"]),
        ([], list(CLAIMS)),
    ],
)
def test_ids_beginnings_and_ranges(words: list[str], ids: list[str]) -> None:
    assert select(words, CLAIMS) == ids


@pytest.mark.parametrize("word", ["X", "R99", "R05-R01", "R01-R99", "5", "-"])
def test_what_means_nothing_is_refused_with_the_ids_that_exist(word: str) -> None:
    with pytest.raises(hurcules.Error, match=r"R01-R26, E01-E05, .*P01-P09") as caught:
        select([word], CLAIMS)
    assert repr(word) in str(caught.value)


# ---- the judge

STATEMENT = most("statement", 1.0)
FIGURE = Expected("figure", 0.9, 1.1, "s", figure=True, ours=(2.0, 3.0), why="other geometry")


@pytest.mark.parametrize(
    ("statement", "figure", "verdict", "explained"),
    [
        (0.5, 1.0, Verdict.HOLDS, True),
        (0.5, 2.5, Verdict.ANOTHER_NUMBER, True),
        (0.5, 4.0, Verdict.ANOTHER_NUMBER, False),
        (1.5, 1.0, Verdict.NOT, False),
        (float("nan"), 1.0, Verdict.NOT, False),
        (0.5, float("nan"), Verdict.ANOTHER_NUMBER, False),
    ],
)
def test_the_verdict_follows_from_the_numbers(
    statement: float, figure: float, verdict: Verdict, explained: bool
) -> None:
    claim = Claim("X01", "here", "a claim", {"statement": STATEMENT, "figure": FIGURE})
    found, reason, why = judge(claim, Finding({"statement": statement, "figure": figure}))
    assert (found, why) == (verdict, explained)
    assert (reason == "") == (verdict == Verdict.HOLDS)
    assert ("other geometry" in reason) == (not FIGURE.met(figure))


def test_what_a_measurement_leaves_out_is_told_and_keeps_the_claim_from_holding() -> None:
    claim = Claim("X01", "here", "a claim", {"a": STATEMENT}, missing="the night")
    assert judge(claim, Finding({"a": 0.5})) == (Verdict.IN_PART, "not shown: the night", True)
    verdict, reason, _ = judge(claim, Finding({"a": 1.5}))
    assert verdict == Verdict.NOT and reason.endswith("; not shown: the night")


def test_values_under_other_names_are_refused() -> None:
    claim = Claim("X01", "here", "a claim", {"a": STATEMENT})
    with pytest.raises(hurcules.Error, match=r"wanted values for \['a'\], got \['b'\]"):
        judge(claim, Finding({"b": 0.0}))


# ---- keeping results


def test_a_kept_result_comes_back_whole(tmp_path: Path) -> None:
    plot = Plot("title", "x", "y", [line("", [0, 1], [1.0, float("nan")])], marks=(0.5,), log="y")
    claim = Claim("X01", "here", "a claim", {"a": STATEMENT})
    finding = Finding({"a": float("inf")}, [Note("n", 1.0, "s")], [plot], "remark")
    result = from_finding(claim, finding, 1.5)
    keep(result, tmp_path)
    assert load(tmp_path / "X01.json") == result
    assert result.verdict == Verdict.NOT and not result.done


@pytest.mark.parametrize("text", ["", "{", "[]", "{}", '{"fingerprint": "other"}'])
def test_a_broken_or_older_file_counts_as_none(tmp_path: Path, text: str) -> None:
    (tmp_path / "X01.json").write_text(text)
    assert load(tmp_path / "X01.json") is None


def test_errors_and_other_code_are_measured_again(tmp_path: Path) -> None:
    keep(without_finding("A", Verdict.ERROR, "failed"), tmp_path)
    keep(without_finding("B", Verdict.HOLDS, ""), tmp_path)
    old = json.loads(dump(without_finding("C", Verdict.HOLDS, ""))) | {"fingerprint": "older"}
    (tmp_path / "C.json").write_text(json.dumps(old))
    assert kept(tmp_path, ["A", "B", "C", "D"], fresh=False) == ["B"]
    assert sorted(path.name for path in tmp_path.iterdir()) == ["B.json"]
    assert kept(tmp_path, ["B"], fresh=True) == []


# ---- claims that fail


def test_a_claim_that_raises_becomes_an_error_with_its_place(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def fail() -> Finding:
        raise RuntimeError("no such thing")

    assert examine("R14").verdict == Verdict.HOLDS
    monkeypatch.setitem(FUNCTIONS, "R14", fail)
    result = examine("R14")
    assert (result.verdict, result.done) == (Verdict.ERROR, False)
    assert re.fullmatch(r"RuntimeError: no such thing \(test_reproduce.py:\d+\)", result.reason)


def dying(names: Sequence[str], folder: Path) -> None:
    """Stands in for a worker whose process dies with the claim R18."""
    for name in names:
        if name == "R18":
            os._exit(9)
        keep(without_finding(name, Verdict.HOLDS, ""), folder)


def test_a_process_that_dies_costs_one_claim(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr("hurcules_studies.thesis.runner.work", dying)
    left: list[list[str]] = []
    Runner(tmp_path, 2, lambda: False, left.append).run([*QUICK, "H01", "H02"])
    results = {name: load(tmp_path / f"{name}.json") for name in [*QUICK, "H01", "H02"]}
    verdicts = {name: result and result.verdict for name, result in results.items()}
    assert verdicts == {
        name: Verdict.ERROR if name == "R18" else Verdict.HOLDS for name in verdicts
    }
    assert left[-1] == []


# ---- the command


@pytest.fixture(scope="module")
def first(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, str]:
    """A first run of a handful of claims: its folder and what it said."""
    out = tmp_path_factory.mktemp("reproduce") / "deep" / "out"
    done = call(*QUICK, "--out", str(out), "--workers", "2")
    assert done.returncode == 0, done.stderr
    return out, done.stdout


def test_a_run_writes_claims_and_report_and_says_where(first: tuple[Path, str]) -> None:
    out, said = first
    found = rows(out)
    assert list(found) == QUICK
    assert all(row["verdict"] == "holds" and row["seconds"] >= 0 for row in found.values())
    assert found["R20"]["measured"]["x1"] == pytest.approx(-0.4975, abs=5e-5)
    assert found["R20"]["expected"]["x1"]["low"] == pytest.approx(-0.49755)
    assert {"source", "statement", "reason", "notes"} <= set(found["R20"])
    page = (out / "report.html").read_text(encoding="utf-8")
    assert all(f'id="{name}"' in page for name in QUICK)
    assert "http" not in re.sub(r"http://www\.w3\.org\S*|http://purl\.org\S*", "", page)
    assert str(out / "report.html") in said.replace("\n", "")


def test_a_second_run_takes_over_what_is_finished(first: tuple[Path, str]) -> None:
    out, _ = first
    files = {name: (out / "claims" / f"{name}.json").stat().st_mtime_ns for name in QUICK}
    (out / "claims" / "R14.json").write_text("broken")
    done = call("R14", "R18", "--out", str(out))
    assert done.returncode == 0
    assert "2 claims" in done.stdout and "1 from an earlier run" in done.stdout
    assert (out / "claims" / "R18.json").stat().st_mtime_ns == files["R18"]
    assert call("R18", "--out", str(out), "--fresh").returncode == 0
    assert (out / "claims" / "R18.json").stat().st_mtime_ns > files["R18"]


def test_what_nothing_measures_yet_does_not_count_unless_asked_for() -> None:
    pending = without_finding("F07", Verdict.PENDING, "no pictures")
    holds = replace(without_finding("R14", Verdict.HOLDS, ""), explained=True)
    results = run.Reproduction({"F07": pending, "R14": holds})
    results.waiting = frozenset({"F07"})
    assert results.done
    results.waiting = frozenset()
    assert not results.done


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (["X07"], "no claim is meant by 'X07'; there are: R01-R26, E01-E05, H01-H19"),
        (["R14", "--workers", "0"], "--workers: wanted a whole number of 1 or more, got 0"),
        (["R14", "--workers", "two"], "--workers"),
        (["R14", "--out", ""], "'--out': wanted the name of a folder"),
    ],
)
def test_wrong_use_gives_one_line_and_exit_code_2(
    arguments: list[str], says: str, capsys: pytest.CaptureFixture[str]
) -> None:
    from hurcules import cli

    assert cli.main(["reproduce", *arguments]) == 2
    said = capsys.readouterr()
    assert said.out == "" and said.err.count("\n") == 1
    assert says in said.err


def test_ctrl_c_keeps_what_is_finished_and_the_next_run_goes_on(tmp_path: Path) -> None:
    # in one worker: whichever comes first, the others take two seconds more
    arguments = ["H14-H16", "--out", str(tmp_path), "--workers", "1"]
    process = subprocess.Popen(
        [*COMMAND, "reproduce", *arguments],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )
    deadline = time.monotonic() + 120
    while not list(tmp_path.glob("claims/*.json")) and time.monotonic() < deadline:
        time.sleep(0.005)
    os.killpg(process.pid, signal.SIGINT)  # as the terminal does: to the workers too
    said, errors = process.communicate(timeout=60)
    assert process.returncode == 130, errors
    assert "Traceback" not in errors
    assert "interrupted" in said
    found = rows(tmp_path)
    open_ones = [name for name, row in found.items() if row["verdict"] == "pending"]
    assert 0 < len(open_ones) < len(found)
    assert found[open_ones[0]]["reason"] == "interrupted before it was measured"
    again = call(*arguments)
    assert again.returncode == 0 and "from an earlier run" in again.stdout
    assert [name for name, row in rows(tmp_path).items() if row["verdict"] == "pending"] == []


def test_from_python_without_a_console(tmp_path: Path) -> None:
    results = run.reproduce(["R14", "R24"], tmp_path, workers=1)
    assert list(results) == ["R14", "R24"] and results.done
    assert replace(results["R14"], seconds=0.0).verdict == Verdict.HOLDS
    files = [tmp_path / name for name in ("claims.json", "claims.md", "report.html")]
    assert results.output.saved == files
    table = files[1].read_text(encoding="utf-8")
    assert "2 claims: 2 holds" in table and table.count("\n| R") == 2


def test_fitted_numbers_methods_and_caveats_are_shown(tmp_path: Path) -> None:
    claim = CLAIMS["K17"]
    values = {name: 1.0 for name in claim.expected} | {"when": 21.0}
    results = {"K17": from_finding(claim, Finding(values), 0.0)}
    results["H01"] = from_finding(
        CLAIMS["H01"], Finding({name: 680.0 for name in CLAIMS["H01"].expected}), 0.0
    )
    claims_table.write(tmp_path / "claims.md", results)
    text = (tmp_path / "claims.md").read_text(encoding="utf-8")
    assert "| default |" in text and "*fitted: speed down*" in text
    assert "Claims with such numbers: K17." in text
    assert "*Caveat: restates an input of the model.*" in text
    page.write(tmp_path / "report.html", results)
    report = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert "fitted: speed down" in report and "solver: default" in report
    assert "Caveat: restates an input of the model." in report


def test_the_page_of_claims_counts_what_it_shows(root: Path) -> None:
    text = (root / "docs" / "claims.md").read_text(encoding="utf-8")
    shown = re.findall(r"^\| ([A-Z]\d\d) \|(.*)\|$", text, re.MULTILINE)
    assert [name for name, _ in shown] == list(CLAIMS)
    verdicts = [re.split(r"(?<!\\) \| ", row)[3] for _, row in shown]
    counts = Counter(verdicts)
    told = ", ".join(f"{counts[verdict]} {verdict}" for verdict in Verdict if counts[verdict])
    assert f"112 claims: {told}.\n" in text
    fitted = [name for name, row in shown if "*fitted" in row]
    assert fitted == [name for name, claim in CLAIMS.items() if claim.fitted]


def test_a_time_or_a_length_of_a_fitted_motion_is_marked_as_fitted() -> None:
    """The thesis prints no start posture and no speed: no such number is evidence."""
    motions = [f"S0{i}" for i in range(1, 7)] + ["M04", "M08", "M14", "K08", "K09", "K10"]
    bare = [
        f"{name}: {one.what}"
        for name in motions
        for one in CLAIMS[name].expected.values()
        if one.thesis and one.unit in ("s", "m") and not one.fitted
    ]
    assert bare == []


def shown_as(one: Expected) -> str:
    return re.escape(f"{one.what} ") + "[^;]*" + re.escape(f" ({claims_table.wanted(one)})")


def test_the_page_of_claims_shows_the_criteria_of_the_list(root: Path) -> None:
    text = (root / "docs" / "claims.md").read_text(encoding="utf-8").replace("\\|", "|")
    lost = []
    for name, claim in CLAIMS.items():
        says = (
            f"| {name} | {claim.statement} | {claim.source} | {', '.join(claim.solvers) or '-'} |"
        )
        row = next((line for line in text.splitlines() if line.startswith(says)), None)
        if row is None:
            lost.append(f"{name}: {says}")
        elif name in measured():
            lost += [
                f"{name}: {words}" for words in (claim.missing, claim.caveat) if words not in row
            ]
            lost += [
                f"{name}: {one.what}"
                for one in claim.expected.values()
                if not re.search(shown_as(one), row)
            ]
    assert lost == []


def test_the_page_of_what_moved_has_the_numbers_of_the_table(root: Path) -> None:
    """What stands under "now" stands in the claim's row, in this unit or a thousand times it."""
    table = (root / "docs" / "claims.md").read_text(encoding="utf-8")
    page = (root / "docs" / "thesis.md").read_text(encoding="utf-8")
    page = page[page.index("## Numbers that moved") :]
    rows = re.findall(r"^\| ([A-Z]\d\d) \|[^|]*\|[^|]*\| ([\d.]+)[^|]*\|", page, re.MULTILINE)
    assert len(rows) >= 5
    for name, now in rows:
        row = next(line for line in table.splitlines() if line.startswith(f"| {name} |"))
        half = 0.5 * 10.0 ** -len(now.partition(".")[2]) + 1e-12
        numbers = [float(number) for number in re.findall(r"\d+\.?\d*(?:e-?\d+)?", row)]
        assert any(abs(float(now) - k * x) <= half for x in numbers for k in (1.0, 1e3)), name


def test_every_page_that_counts_claims_agrees_with_the_table(root: Path) -> None:
    table = (root / "docs" / "claims.md").read_text(encoding="utf-8")
    head = re.search(r"^112 claims: (.*)\.$", table, re.MULTILINE)
    assert head
    counts = {str(verdict): 0 for verdict in Verdict}
    for count, verdict in re.findall(r"(\d+) ([a-z ]+)", head[1]):
        counts[verdict] = int(count)
    wanted = (
        f"{len(CLAIMS)} claims: {counts['holds']} hold, {counts['holds in part']} in part, "
        f"{counts['holds with another number']} with another number, "
        f"{counts['does not hold']} do not"
    )
    assert counts["pending"] == 0
    told = {}
    for page_of in (root / "README.md", *sorted((root / "docs").rglob("*.md"))):
        text = re.sub(r"\s+", " ", page_of.read_text(encoding="utf-8"))
        if found := re.findall(r"\d+ claims: \d+ hold, .*? do not", text):
            told[page_of.name] = found
    assert "README.md" in told
    assert {name: set(found) for name, found in told.items()} == {name: {wanted} for name in told}
    korean = (root / "README.ko.md").read_text(encoding="utf-8")
    found = re.search(r"주장 (\d+)개 가운데 (\d+)개", korean)
    assert found and [int(one) for one in found.groups()] == [len(CLAIMS), counts["holds"]]
