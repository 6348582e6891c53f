""".ci/machine and .ci/step: missing packages are named, asked for, waited for; failures explained.

Strategy: a made-up apt-get and a made-up compiler that finds nothing stand in for the machine. Not
tested: real package managers (bare machines were tried by hand).
"""

import os
import stat
import subprocess
import sys
from pathlib import Path

import pytest

APT = """#!/bin/bash
echo "$*" >> {log}
if [ "$(cat {locks})" -gt 0 ]; then
  echo $(($(cat {locks}) - 1)) > {locks}
  echo "E: Could not get lock /var/lib/apt/lists/lock. It is held by process 1 (apt-get)" >&2
  exit 100
fi
case "$*" in *install*) {outcome} ;; esac
"""


class Machine:
    """A copy of the scripts with a machine of its own before them."""

    def __init__(self, root: Path, folder: Path) -> None:
        self.folder = folder
        (folder / ".ci").mkdir()
        for name in ("machine", "step"):
            target = folder / ".ci" / name
            target.write_bytes((root / ".ci" / name).read_bytes())
            target.chmod(0o755)
        self.bin = folder / "bin"
        self.bin.mkdir()
        (folder / "locks").write_text("0")
        self.program("c++", "#!/bin/bash\ncat >/dev/null\ntest -e compiler\n")
        self.program("sleep", "#!/bin/bash\n")
        self.program("id", "#!/bin/bash\necho 0\n")
        self.apt("touch compiler")

    def program(self, name: str, text: str) -> None:
        """Puts a script before the machine's own program of that name."""
        path = self.bin / name
        path.write_text(text)
        path.chmod(path.stat().st_mode | stat.S_IXUSR)

    def apt(self, outcome: str) -> None:
        """Says what an installation does."""
        names = {"log": self.folder / "calls", "locks": self.folder / "locks"}
        self.program("apt-get", APT.format(outcome=outcome, **names))

    def check(self, python: str = sys.executable, **environment: str) -> tuple[int, str]:
        """Exit code of `.ci/machine check`, and what it said."""
        clean = {k: v for k, v in os.environ.items() if k not in ("CI", "YES", "CXX")}
        done = subprocess.run(
            [self.folder / ".ci" / "machine", "check", python],
            env=clean | {"PATH": f"{self.bin}:{os.environ['PATH']}", **environment},
            cwd=self.folder,
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
        )
        return done.returncode, done.stdout + done.stderr

    def calls(self) -> list[str]:
        """What apt-get was called with."""
        path = self.folder / "calls"
        return path.read_text().splitlines() if path.exists() else []


@pytest.fixture
def machine(root: Path, tmp_path: Path) -> Machine:
    return Machine(root, tmp_path)


def test_nothing_is_installed_without_a_yes(machine: Machine) -> None:
    code, said = machine.check()
    assert code == 1
    assert "g++" in said and "Remedy: sudo apt-get install" in said and "YES=1" in said
    assert machine.calls() == []


@pytest.mark.parametrize("yes", [{"CI": "true"}, {"YES": "1"}])
def test_ci_and_yes_install_what_is_missing(machine: Machine, yes: dict[str, str]) -> None:
    code, said = machine.check(**yes)
    assert code == 0, said
    assert any("install" in call and "g++" in call for call in machine.calls())


def test_a_machine_without_python_gets_all_at_once(machine: Machine) -> None:
    machine.program("ldconfig", "#!/bin/bash\n")  # no library either
    machine.apt(f"touch compiler; ln -sf {sys.executable} {machine.bin}/python3.99")
    code, said = machine.check("python3.99", CI="true")
    assert code == 0, said
    (call,) = [call for call in machine.calls() if "install" in call]
    for package in ("g++", "python3", "python3-venv", "python3-dev", "libegl1"):
        assert package in call.split()


def test_a_locked_package_manager_is_waited_for(machine: Machine) -> None:
    (machine.folder / "locks").write_text("3")
    code, said = machine.check(CI="1")
    assert code == 0, said
    assert "another package manager is busy" in said
    assert sum("update" in call for call in machine.calls()) == 4


def test_patience_ends(machine: Machine) -> None:
    (machine.folder / "locks").write_text("1000000")
    code, said = machine.check(CI="1", HURCULES_APT_PATIENCE="0")
    assert code == 1
    assert "Could not get lock" in said and "Still missing: g++" in said


def test_a_failure_is_shown_and_the_next_call_tries_again(machine: Machine) -> None:
    machine.apt("echo 'E: Unable to locate package g++' >&2; exit 100")
    code, said = machine.check(CI="1")
    assert code == 1
    assert "Unable to locate package g++" in said and "build/logs/apt.log" in said
    machine.apt("touch compiler")
    assert machine.check(CI="1")[0] == 0


def step(machine: Machine, script: str) -> tuple[int, str]:
    done = subprocess.run(
        [machine.folder / ".ci" / "step", "logs/x.log", "working", "bash", "-c", script],
        cwd=machine.folder,
        capture_output=True,
        text=True,
    )
    return done.returncode, done.stdout


def test_a_step_shows_how_far_it_is_and_logs_the_rest(machine: Machine) -> None:
    code, said = step(machine, 'for i in $(seq 40); do echo "[$i/40] a.o"; echo wall; done')
    assert code == 0
    assert "working [40/40]" in said and "wall" not in said
    assert len(said.splitlines()) < 15
    assert (machine.folder / "logs" / "x.log").read_text().count("wall") == 40


@pytest.mark.parametrize(
    ("output", "says"),
    [
        ("a.cpp:3:1: error: no such type", "a.cpp:3:1: error: no such type"),
        ("c++: fatal error: Killed signal terminated program cc1plus", "make JOBS=1"),
        ("fatal error: cannot write: No space left on device", "The disk is full"),
        ("ERROR: No matching distribution found for numpy", "check the network"),
        ("SSLError: [SSL: CERTIFICATE_VERIFY_FAILED]", "PIP_CERT"),
    ],
)
def test_a_failed_step_shows_cause_and_remedy(machine: Machine, output: str, says: str) -> None:
    code, said = step(machine, f"seq 500; echo '{output}'; seq 30; exit 3")
    assert code == 3
    assert says in said and "logs/x.log" in said
    assert len(said.splitlines()) < 20


def test_a_step_that_tells_its_own_remedy_gets_no_other(machine: Machine) -> None:
    """CMake without GoogleTest and without a network: packages from PyPI are not the trouble."""
    cause = 'CMake Error: GoogleTest is missing ("Could not resolve hostname")'
    code, said = step(machine, f"echo '{cause}'; echo '  Remedy: libgtest-dev'; exit 1")
    assert code == 1
    assert said.count("Remedy") == 1 and "libgtest-dev" in said
