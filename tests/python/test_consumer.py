"""A C++ user's view: install, find_package(hurcules), compile, run.

Strategy: installs the C++ part of make's build into a fresh prefix, so that nothing of the checkout
is seen, and builds the programs of README and docs there. Not tested: a prefix moved to
another machine.
"""

import json
import os
import re
import subprocess
import sys
import tomllib
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

import hurcules

CMAKE = """\
cmake_minimum_required(VERSION 3.24)
project(consumer LANGUAGES CXX)
set(library mine)
find_package(hurcules {version} REQUIRED)
find_package(hurcules REQUIRED COMPONENTS solver mission)
if(NOT library STREQUAL mine)
  message(FATAL_ERROR "a variable of the user's is now ${{library}}")
endif()
add_executable(consumer consumer.cpp)
target_link_libraries(consumer PRIVATE hurcules::hurcules)
"""

ARM = """<mujoco><worldbody><body pos="0 0 1"><joint name="shoulder" axis="0 1 0"/>
  <geom type="capsule" size=".04" fromto="0 0 0 .4 0 0" mass="2"/><body pos=".4 0 0">
  <joint name="elbow" axis="0 1 0" ref="1"/>
  <geom type="capsule" size=".04" fromto="0 0 0 0 0 -.4" mass="2"/>
  <site name="tip" pos="0 0 -.4"/></body></body></worldbody>
  <actuator><motor joint="shoulder"/><motor joint="elbow"/></actuator></mujoco>"""


def run(*command: str | Path, **environment: str) -> str:
    """Standard output of a command that must succeed."""
    env = os.environ | environment
    done = subprocess.run(command, capture_output=True, text=True, env=env)
    assert done.returncode == 0, f"{done.stdout}\n{done.stderr}"
    return done.stdout


def cmake() -> str:
    """The cmake beside this Python, else the machine's."""
    own = Path(sys.executable).with_name("cmake")
    return str(own) if own.is_file() else "cmake"


def installed(build: Path, folder: Path, program: str) -> Path:
    """The program, built against a fresh prefix in the folder."""
    prefix, source = folder / "prefix", folder / "source"
    run(cmake(), "--install", build, "--prefix", prefix, "--component", "cpp")
    source.mkdir()
    (source / "CMakeLists.txt").write_text(CMAKE.format(version=hurcules.__version__))
    (source / "consumer.cpp").write_text(program)
    # with AVX Eigen would lay its memory out otherwise than the library does
    flags = f"-DCMAKE_PREFIX_PATH={prefix}", "-DCMAKE_CXX_FLAGS=-O1 -march=native"
    run(cmake(), "-S", source, "-B", source / "build", *flags)
    run(cmake(), "--build", source / "build")
    return source / "build" / "consumer"


def test_the_library_is_compiled_alike_with_its_tests_and_without(
    root: Path, tmp_path: Path
) -> None:
    """So that `make test` goes on from what `make demo` compiled."""

    def commands(tests: str) -> dict[str, str]:
        where = str(tmp_path / tests)
        flags = "-DHURCULES_PRECOMPILE=OFF", f"-DHURCULES_TESTS={tests}"
        run(cmake(), "-S", root, "-B", where, *flags, VIRTUAL_ENV=sys.prefix)
        known = json.loads(Path(where, "compile_commands.json").read_text())
        own = str(root / "cpp")
        return {one["file"]: one["command"] for one in known if one["file"].startswith(own)}

    shipped, tested = commands("OFF"), commands("ON")
    assert len(shipped) > 100
    assert tested == shipped


def test_what_is_missing_is_told_to_who_can_do_without_it(build: Path, tmp_path: Path) -> None:
    prefix, source = tmp_path / "prefix", tmp_path / "source"
    run(cmake(), "--install", build, "--prefix", prefix, "--component", "cpp")
    source.mkdir()
    (source / "CMakeLists.txt").write_text(
        "cmake_minimum_required(VERSION 3.24)\nproject(consumer LANGUAGES CXX)\n"
        'find_package(hurcules QUIET)\nmessage(STATUS "${hurcules_FOUND}: '
        '${hurcules_NOT_FOUND_MESSAGE}")\n'
    )
    flags = f"-DCMAKE_PREFIX_PATH={prefix}", "-DCMAKE_DISABLE_FIND_PACKAGE_Eigen3=ON"
    told = run(cmake(), "-S", source, "-B", source / "build", *flags)
    assert "0: Eigen 3.4 is missing. Remedy: pip install cmeel-eigen" in told


def test_the_loop_of_the_docs_leads_a_robot(build: Path, root: Path, tmp_path: Path) -> None:
    text = (root / "docs" / "loop.md").read_text(encoding="utf-8")
    (tmp_path / "arm.xml").write_text(ARM, encoding="utf-8")
    program = installed(build, tmp_path, re.findall(r"```cpp\n(.*?)```", text, re.DOTALL)[0])
    where = np.array(run(program, tmp_path / "arm.xml", "tip").split(), dtype=float)
    # from (0.4, 0, 0.6) at 0.1 m/s for 500 ticks of 2 ms
    np.testing.assert_allclose(where, [0.4, 0.0, 0.7], atol=2e-3)


def test_the_mission_of_the_docs_says_what_python_says(
    build: Path, root: Path, tmp_path: Path
) -> None:
    text = (root / "docs" / "loop.md").read_text(encoding="utf-8")
    tables = re.findall(r"```toml\n(.*?)```", text, re.DOTALL)
    rows = next(rows for rows in tables if 'name = "lower"' in rows)
    model, mission = mujoco.MjModel.from_xml_string(ARM), hurcules.Mission.read(tomllib.loads(rows))
    mission.save_table(tmp_path / "lower.table", model)
    robot = hurcules.Robot(model)
    hand, posture = hurcules.PositionTask("hand", robot, "tip"), hurcules.PostureTask("p", robot)
    controller = hurcules.WholeBodyController(
        robot, channels={"hand": hurcules.Twist(hand, 0.3)}, stacks={"reach": [hand, posture]}
    )
    simulation = hurcules.Simulation(mission, model=model, controller=controller, variation=0.0)
    while not simulation.finished:
        simulation.step(100)
    program = installed(build, tmp_path, re.findall(r"```cpp\n(.*?)```", text, re.DOTALL)[1])
    reason, *figures = run(program, tmp_path / "lower.table", "tip").splitlines()
    assert reason == simulation.reason == "completed"
    here = [f"{name} {value:g}" for name, value in simulation.figures().items()]
    assert figures == here


def test_the_program_of_the_readme_runs_and_says_what_its_python_says(
    build: Path, root: Path, tmp_path: Path
) -> None:
    readme = (root / "README.md").read_text(encoding="utf-8")
    program = re.findall(r"```cpp\n(.*?)```", readme, re.DOTALL)
    pythons = re.findall(r"```python\n(.*?)```", readme, re.DOTALL)
    x0, x1, x2, status = run(installed(build, tmp_path, program[0])).split()
    space: dict[str, Any] = {}
    exec(next(text for text in pythons if "rhqp" in text), space)
    np.testing.assert_allclose([float(x0), float(x1), float(x2)], space["solution"].x, atol=1e-5)
    assert status == space["solution"].status.name.lower() == "solved"


def test_headers_are_installed_by_room_and_nothing_else(build: Path, tmp_path: Path) -> None:
    run(cmake(), "--install", build, "--prefix", tmp_path, "--component", "cpp")
    include = tmp_path / "include"
    headers = {str(file.relative_to(include)) for file in include.rglob("*") if file.is_file()}
    assert "hurcules/solver/solver.hpp" in headers
    assert all(name.startswith("hurcules/") and name.endswith(".hpp") for name in headers)
    assert not any(os.sep + "bindings" in name for name in headers)
