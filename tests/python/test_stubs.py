"""The types are true: _core.pyi against the compiled module, annotations, `__all__`.

The stub is generated (python/bindings/stubs.py); mypy's stubtest compares its names once more.
"""

import ast
import importlib
import subprocess
import sys
from pathlib import Path

import pytest

import hurcules

MODULES = [
    "hurcules",
    "hurcules.cameras",
    "hurcules.figures",
    "hurcules.opengl",
    "hurcules.output",
    "hurcules.recording",
    "hurcules.rendering",
    "hurcules.report",
    "hurcules.rhqp",
    "hurcules.run",
    "hurcules.sensors",
    "hurcules.simulation",
    "hurcules.summary",
    "hurcules.video",
    "hurcules_envs",
    "hurcules_envs.base",
    "hurcules_envs.observations",
    "hurcules_envs.stretch",
]


def test_the_stub_names_what_the_compiled_module_has(root: Path) -> None:
    words = ["--ignore-disjoint-bases", "--concise", "--mypy-config-file", root / "pyproject.toml"]
    done = subprocess.run(
        [sys.executable, "-m", "mypy.stubtest", "hurcules._core", *words],
        capture_output=True,
        text=True,
    )
    lines = done.stdout.splitlines()
    assert "error: not checking" not in done.stdout, done.stdout
    # pybind11's metaclass has no name in a stub, which says a signature by `__init__`
    known = ("metaclass differs", ".__signature__ is not present in stub")
    assert [line for line in lines if not any(text in line for text in known)] == [], done.stderr


def test_the_stub_is_what_the_script_writes(root: Path) -> None:
    script = root / "python" / "bindings" / "stubs.py"
    done = subprocess.run([sys.executable, script, "--check"], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


def test_the_stub_leaves_few_types_open(root: Path) -> None:
    text = (root / "python/hurcules/_core.pyi").read_text(encoding="utf-8")
    functions = [node for node in ast.walk(ast.parse(text)) if isinstance(node, ast.FunctionDef)]
    assert len(functions) > 400
    vague = [one.name for one in functions if "Any" in ast.unparse(one.args)]
    vague = [name for name in vague if name != "__deepcopy__"]  # its memo holds anything
    assert len(vague) < 10, vague


def test_the_packages_are_typed(root: Path) -> None:
    for package in ("python/hurcules", "python/hurcules_studies", "envs/hurcules_envs"):
        assert (root / package / "py.typed").is_file()
    done = subprocess.run(
        [
            sys.executable,
            "-m",
            "mypy",
            "-p",
            "hurcules",
            "-p",
            "hurcules_studies",
            "-p",
            "hurcules_envs",
        ],
        cwd=root,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.parametrize("name", MODULES)
def test_all_names_what_a_module_offers(name: str) -> None:
    module = importlib.import_module(name)
    assert list(module.__all__) == sorted(set(module.__all__), key=module.__all__.index)
    assert [entry for entry in module.__all__ if not hasattr(module, entry)] == []


def test_the_package_offers_every_class_of_the_core_but_the_solvers() -> None:
    from hurcules import _core, rhqp

    classes = {name for name, value in vars(_core).items() if isinstance(value, type)}
    assert classes - set(rhqp.__all__) - set(hurcules.__all__) - {"SimulationOptions"} == set()


def test_the_stub_lies_where_type_checkers_look() -> None:
    folder = Path(hurcules.__file__).parent
    assert (folder / "_core.pyi").is_file()
