"""The command line: help, lists, and one clear line for every wrong use; runs: test_run.py.

Called in this process through `hurcules.cli.main`, which is what the console script calls.
"""

import os
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

import hurcules
from hurcules import cli, doctor, extras, view
from hurcules.output import Output, void


def call(capsys: pytest.CaptureFixture[str], *arguments: str) -> tuple[int, str, str]:
    code = cli.main(arguments)
    said = capsys.readouterr()
    return code, said.out, said.err


@pytest.mark.parametrize("command", ["run", "reproduce", "list", "mission", "view", "doctor"])
def test_help_of_each_command_shows_an_example(
    capsys: pytest.CaptureFixture[str], command: str
) -> None:
    code, out, err = call(capsys, command, "--help")
    assert (code, err) == (0, "")
    assert f"hurcules {command}" in out
    assert "For example" in out


def test_without_arguments_the_help_is_shown(capsys: pytest.CaptureFixture[str]) -> None:
    code, out, err = call(capsys)
    assert (code, err) == (2, "")
    assert all(command in out for command in ("run", "reproduce", "list", "doctor"))


def test_version_is_that_of_the_package(capsys: pytest.CaptureFixture[str]) -> None:
    assert call(capsys, "--version") == (0, f"{hurcules.__version__}\n", "")


def test_list_names_everything_that_there_is(capsys: pytest.CaptureFixture[str]) -> None:
    code, out, _ = call(capsys, "list")
    assert code == 0
    for kind in ("missions", "scenes", "models", "environments"):
        assert kind in out
    names = [*hurcules.missions(), *hurcules.models.scenes(), *hurcules.models.names()]
    for name in [*names, "hurcules_envs:Hurcules/Stretch-v0"]:
        assert re.search(rf"(^|\s){re.escape(name)}\s", out), name


def test_mission_prints_a_table_or_writes_it(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    code, out, _ = call(capsys, "mission", "lift")
    assert code == 0
    assert out == hurcules.lift.mission().table()
    for kind, begin in ((".svg", "<svg"), (".toml", "[mission]"), (".txt", "1  settle")):
        file = tmp_path / f"lift{kind}"
        assert call(capsys, "mission", "lift", "--out", str(file)) == (0, f"{file}\n", "")
        assert file.read_text(encoding="utf-8").startswith(begin)
    code, again, _ = call(capsys, "mission", str(tmp_path / "lift.toml"))
    assert (code, again) == (0, out)


def test_folders_of_files_are_made(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    """`export` made them, `mission` did not."""
    there = tmp_path / "file"
    there.touch()
    for k, words in enumerate(
        ("mission lift --out {}.svg", "mission lift --out {}.table", "export rescue --out {}.xml")
    ):
        name = words.split("{}")[1]
        path = tmp_path / "new" / str(k) / "lift"
        assert call(capsys, *words.format(path).split()) == (0, f"{path}{name}\n", "")
        assert path.with_suffix(name).is_file()
        code, _, err = call(capsys, *words.format(there / "lift").split())
        assert code == 1
        assert err == f"hurcules: error: cannot write {there}/lift{name}: Not a directory\n"
    hurcules.lift.mission().save(tmp_path / "another" / "lift.toml")
    assert (tmp_path / "another" / "lift.toml").is_file()


def test_a_table_that_does_not_fit_on_the_disk_leaves_what_there_was(tmp_path: Path) -> None:
    file = tmp_path / "lift.table"
    file.with_suffix(".mjb").write_text("older")
    program = """
import resource, sys
from hurcules import cli
resource.setrlimit(resource.RLIMIT_FSIZE, (60_000, 60_000))
sys.exit(cli.main())
"""
    done = subprocess.run(
        [sys.executable, "-c", program, "mission", "lift", "--out", file],
        capture_output=True,
        text=True,
    )
    assert (done.returncode, done.stderr.count("\n")) == (1, 1), done.stderr
    assert f"cannot write {file.with_suffix('.mjb')}: File too large" in done.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["lift.mjb"]
    assert file.with_suffix(".mjb").read_text() == "older"


def test_places_out_of_range_are_told_by_the_options_that_say_them(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    for words, wanted in (
        (
            "lift --offset 100,0",
            "the place ahead, 3.3 m and the offset, wants a number from 1.5 to",
        ),
        ("lift --offset 0,9", "the offset to the left wants a number from -5 to 5 m, got 9"),
        ("crossing --way -5", "the place ahead, 5.3 m, the way and the offset, wants a number"),
        ("disposal --offset 30,0", "the place ahead, 3 m and the offset, wants a number from 1.6"),
    ):
        code, _, err = call(capsys, "run", *words.split(), "--out", str(tmp_path))
        assert code == 2
        assert wanted in err


def test_view_takes_the_options_of_a_mission(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    seen = []
    monkeypatch.setattr(view, "watch", lambda simulation, seconds: seen.append(simulation))
    assert call(capsys, "view", "lift", "--mass", "90", "--seed", "3")[0] == 0
    people = [
        part for part in range(seen[0].model.nbody) if "casualty" in seen[0].model.body(part).name
    ]
    assert sum(seen[0].model.body_mass[people]) == pytest.approx(90.0)
    code, _, err = call(capsys, "view", "lift", "--mas", "90")
    assert (code, "no such option: --mas; options are: --mass" in err) == (2, True)
    code, _, err = call(capsys, "view", "rescue", "--mass", "90")
    assert (code, "no such option: --mass" in err) == (2, True)


def test_doctor_tells_each_finding_and_ends_well_where_nothing_is_broken(
    capsys: pytest.CaptureFixture[str],
) -> None:
    code, out, _ = call(capsys, "doctor")
    assert code == 0
    for word in ("Python", "MuJoCo", "renderer", "codec", "processor"):
        assert word in out


def test_doctor_looks_at_every_extra_and_none_of_them_has_to_be_there(
    root: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    pyproject = tomllib.loads((root / "pyproject.toml").read_text())
    declared = pyproject["project"]["optional-dependencies"]
    assert extras.names() == list(extras.FOR) == list(declared)
    for extra, wanted in declared.items():
        assert [re.match("[a-z0-9-]+", one)[0] for one in wanted] == extras.packages(extra)
    monkeypatch.setattr(doctor, "_renderer", lambda: [])
    monkeypatch.setattr(extras, "find_spec", lambda module: None)
    code, out, _ = call(capsys, "doctor")
    words = " ".join(out.split())
    assert code == 0
    for extra in declared:
        assert f"{extras.FOR[extra]} lacks no " in words
        assert f"remedy: pip install 'hurcules[{extra}]'" in words


def test_doctor_ends_with_1_and_the_remedy_where_something_is_broken(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    finding = doctor.Finding("heart", "broken", "stopped", "start it")
    monkeypatch.setattr(doctor, "examine", lambda: [finding])
    code, out, _ = call(capsys, "doctor")
    assert code == 1
    assert "start it" in out


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (["run", "nowhere"], "mission or test method 'nowhere' does not exist; there are: stretch"),
        (["run", "nowhere"], "e2803"),
        (["run", "Valve-v0"], "Valve-v0 is an environment, which wants --policy"),
        (["run", "--wombat", "3"], "no such option: --wombat"),
        (["run", "stretch", "--wombat", "3"], "no such option: --wombat"),
        (["run", "lift", "casualty"], "unexpected argument: casualty; options are: --mass"),
        (["run", "lift", "--yaw", "left"], "--yaw: wanted a number, got 'left'"),
        (
            ["run", "lift", "--offset", "near"],
            "--offset: wanted numbers between commas, got 'near'",
        ),
        (["RUN"], "No such command 'RUN'; there are: run, list, mission, view, export, doctor"),
        (["run", "stretch", "--robot", "nonsense"], "--robot: for test methods; 'stretch' is a"),
        (["run", "stretch", "--pace", "-7"], "--pace: for test methods"),
        (["run", "stretch", "--repetitions", "0"], "--repetitions: for test methods"),
        (["run", "stretch", "--workers", "-3"], "--workers: for test methods"),
        (["run", "e2803", "--angle", "200"], "--angle: wanted a number from"),
        (["run", "e2803", "--angle", "200"], "degrees, got 200"),
        (["run", "e2803", "--pace", "100"], "5.56 m/s (20 km/h) at most, got 100"),
        (["run", "e2803", "--repetitions", "0"], "repetitions: wanted a whole number from 1 up"),
        (["mission", "nowhere"], "table of a mission 'nowhere' does not exist; there are: lift"),
        (
            ["mission", "nowhere.toml"],
            "mission file nowhere.toml: No such file or directory; one that comes along: hurcules",
        ),
        (["mission", "lift", "--out", "lift.pdf"], "kind of file '.pdf' does not exist"),
        (["view", "nowhere"], "mission, model, scene or file 'nowhere' does not exist"),
        (["view", "nowhere.xml"], "nowhere.xml: no such file"),
        (
            ["view", str(Path(__file__).parents[2] / "LICENSE")],
            "LICENSE: wanted a file that ends in one of .xml, .mjb",
        ),
        (["run", "--method", "magic"], "magic"),
        (["run", "--seed", "-1"], "seed: wanted a whole number from 0 to 2**64 - 1, got -1"),
        (["run", "--seed", "x"], "--seed"),
        (["run", "--seed", "abc"], "as an integer, got 'abc'"),
        (["run", "--seed=abc"], "as an integer, got 'abc'"),
        (["run", "casualty", "--mass"], "--mass wants a value"),
        (
            ["run", "casualty", "--yaw", "200"],
            "casualty: yaw wants a number from -3.142 to 3.142 rad",
        ),
        (
            ["run", "lift", "--pose", "sitting"],
            "pose wants one of back, left, front, right, got 's",
        ),
        (["run", "disposal", "--friction", "-1"], "disposal: friction wants a number from"),
        (
            ["train", "Fly-v0"],
            "environment 'Hurcules/Fly-v0' does not exist; there are: Carry-v0, ",
        ),
        (["train", "Reach-v0", "--steps", "0"], "--steps: wanted 1 or more, or"),
        (["evaluate", "Drive-v0", "--vary", "weight=3"], "--vary 'weight' does not exist; there"),
        (["evaluate", "Drive-v0", "--vary", "mass=1,x"], "wanted mass=LEAST,MOST, got 'mass=1,x'"),
        (["train", "Drive-v0", "--vary", "mass"], "--vary: wanted mass=LEAST,MOST, got 'mass'"),
        (["evaluate", "Drive-v0", "--set", "terrain"], "--set: wanted NAME=VALUE, terrain=stairs"),
        (["evaluate", "Drive-v0", "--set", "terrain=moon"], "terrain 'moon' does not exist"),
        (["evaluate", "Drive-v0", "--set", "blind=7"], "blind: wanted True or False, got 7"),
        (["evaluate", "Drive-v0", "--set", "seed=7"], "'seed' is no option of an environment"),
        (["record", "Drive-v0", "--set", "episodes=7"], "'episodes' is no option of an"),
        (["evaluate", "Drive-v0", "--set", "given=7"], "option 'given' does not exist"),
        (["run", "lift", "--set", "mass=7"], "--set: for policies"),
        (["evaluate", "Drive-v0", "--vary", "mass=2,1"], "mass: wanted a number or (least, most)"),
        (["record", "Reach-v0", "--policy", "operator"], "hurcules_envs.recording.record"),
        (["record", "Fly-v0"], "environment 'Hurcules/Fly-v0' does not exist"),
        (["record", "Reach-v0", "--episodes", "0"], "greater than or equal to 1, got '0'"),
        (["run", "--out", __file__], "test_cli.py: it is a file"),
        (["run", "stretch", "--mass", "90"], "--mass; 'stretch' has no options of its own"),
        (["run", "--seed", str(2**64)], "seed: wanted a whole number"),
        (["run", "--out", ""], "'--out': wanted the name of a folder, got ''"),
        (["run", "--seconds", "x"], "--seconds"),
        (["run", "--seconds", "0"], "--seconds: wanted a time of 0.001 s or more, got 0.0"),
        (["run", "--seconds", "nan"], "--seconds: wanted"),
        (["run", "--seconds", "inf"], "--seconds: wanted"),
        (["run", "--frobnicate"], "--frobnicate"),
        (["run", "e2801", "--sensors"], "--sensors: for missions"),
        (["run", "stretch", "again"], "again"),
        (["jump"], "jump"),
    ],
)
def test_wrong_use_gives_one_line_and_exit_code_2(
    capsys: pytest.CaptureFixture[str], arguments: list[str], says: str
) -> None:
    code, out, err = call(capsys, *arguments)
    assert (code, out) == (2, "")
    assert err.startswith("hurcules: error: ")
    assert err.count("\n") == 1
    assert says in err


def test_a_folder_that_cannot_be_written_is_refused_before_the_run(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    (tmp_path / "file").touch()
    code, out, err = call(capsys, "run", "--out", str(tmp_path / "file" / "out"))
    assert (code, out) == (2, "")
    assert err == f"hurcules: error: --out: cannot write to {tmp_path}/file/out: Not a directory\n"


def test_ctrl_c_in_a_command_is_told(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def stopped() -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(hurcules, "missions", stopped)
    assert call(capsys, "list") == (130, "", "hurcules: error: interrupted\n")


def test_the_console_script_ends_with_the_code_of_main() -> None:
    script = Path(sys.executable).with_name("hurcules")
    done = subprocess.run([script, "run", "nowhere"], capture_output=True, text=True)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith("hurcules: error: mission or test method 'nowhere'")
    assert "Traceback" not in done.stderr


def test_two_runs_may_write_to_one_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    first, second = Output(tmp_path, ()), Output(tmp_path, ())

    def write(path: Path) -> None:  # while another process writes the same file
        path.write_text("first")
        monkeypatch.setattr(os, "getpid", lambda: -1)
        second.write("log.txt", lambda other: void(other.write_text("second")))
        monkeypatch.undo()

    first.write("log.txt", write)
    assert (tmp_path / "log.txt").read_text() == "first"
    assert [path.name for path in tmp_path.iterdir()] == ["log.txt"]


def test_a_folder_keeps_an_earlier_run_until_there_is_another(tmp_path: Path) -> None:
    for name in ("summary.json", "log.npz", "notes.txt"):
        (tmp_path / name).write_text("earlier")
    output = Output(tmp_path, ("summary.json", "log.npz"))
    assert len(list(tmp_path.iterdir())) == 3
    output.write_json("summary.json", {})
    assert sorted(path.name for path in tmp_path.iterdir()) == ["notes.txt", "summary.json"]


@pytest.mark.parametrize(
    ("words", "wanted"),
    [
        ("Reach-v0 --algo foo", "algorithm 'foo' does not exist; there are: ppo, sac, her"),
        ("Reach-v0 --fidelity foo", "fidelity 'foo' does not exist; there are: exact, fast, kin"),
        ("Reach-v0 --robot nope.xml", "got 'nope.xml'"),
        ("Valve-v0 --fidelity kinematic", "fidelity 'kinematic' has no physics"),
        ("Reach-v0 --rate 5", "rate: wanted 10 to 100 Hz, got 5.0"),
    ],
)
def test_what_is_wrong_with_a_training_is_told_before_pytorch_is_loaded(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, words: str, wanted: str
) -> None:
    monkeypatch.setitem(sys.modules, "hurcules_envs.training", None)  # an import of it fails
    assert cli.main(["train", *words.split()]) == 2
    assert wanted in capsys.readouterr().err


def test_a_cluster_trains_by_ppo_alone(capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main(["train", "Reach-v0", "--ray", "local", "--algo", "sac"]) == 2
    assert "--ray: wanted --algo ppo, got sac" in capsys.readouterr().err
