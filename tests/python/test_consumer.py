"""A C++ user's view: install, find_package(hurcules), compile, run.

Strategy: installs the C++ part of make's build into a fresh prefix, so that nothing of the checkout
is seen, and builds a program of 15 lines there. Not tested: a prefix moved to another machine.
"""

import os
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np

import hurcules

CMAKE = """\
cmake_minimum_required(VERSION 3.24)
project(consumer LANGUAGES CXX)
find_package(hurcules {version} REQUIRED)
add_executable(consumer consumer.cpp)
target_link_libraries(consumer PRIVATE hurcules::hurcules)
"""

# x0 = 1 before x0 + x1 = 3 within |x| <= 1.5
PROGRAM = """\
#include <hurcules/robot/robot.hpp>
#include <hurcules/solver/solver.hpp>
#include <iostream>

int main() {
  using namespace hurcules;
  Level first, second;
  first.A = Matrix{{1.0, 0.0}};
  first.lower = first.upper = Vector{{1.0}};
  second.A = Matrix{{1.0, 1.0}};
  second.lower = second.upper = Vector{{3.0}};
  Solver solver(2);
  const Level box = make_bounds(Vector{{-1.5, -1.5}}, Vector{{1.5, 1.5}});
  const Solution& solution = solver.solve({box, first, second});
  const ModelPtr ball = load_model_text("<mujoco><worldbody><geom size='1'/></worldbody></mujoco>");
  std::cout << solution.x.transpose() << " " << to_string(solution.status) << "\\n";
}
"""


def run(*command: str | Path) -> str:
    """Standard output of a command that must succeed."""
    done = subprocess.run(command, capture_output=True, text=True)
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
    run(cmake(), "-S", source, "-B", source / "build", f"-DCMAKE_PREFIX_PATH={prefix}")
    run(cmake(), "--build", source / "build")
    return source / "build" / "consumer"


def test_a_program_builds_and_runs_against_the_installed_library(
    build: Path, tmp_path: Path
) -> None:
    x0, x1, status = run(installed(build, tmp_path, PROGRAM)).split()
    assert (round(float(x0), 9), round(float(x1), 9), status) == (1.0, 1.5, "solved")


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
