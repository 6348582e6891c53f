"""The types are true: _core.pyi against the compiled module, annotations against mypy, `__all__`.

mypy's stubtest compares names; what it cannot see, the arguments of compiled functions, is read
from the first line that pybind11 writes into each text and compared here, defaults included.
"""

import ast
import importlib
import inspect
import re
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
    # pybind11's metaclass has no name that a stub could write
    assert [line for line in lines if "metaclass differs" not in line] == [], done.stderr


def stub_functions(root: Path) -> list[tuple[str, ast.FunctionDef]]:
    """(dotted name, definition) of each function in the stub, without properties."""
    tree = ast.parse((root / "python/hurcules/_core.pyi").read_text(encoding="utf-8"))
    found = [(node.name, node) for node in tree.body if isinstance(node, ast.FunctionDef)]
    for owner in tree.body:
        if isinstance(owner, ast.ClassDef) and not owner.name.startswith("_"):
            found += [
                (f"{owner.name}.{node.name}", node)
                for node in owner.body
                if isinstance(node, ast.FunctionDef) and not node.decorator_list
                if node.name not in ("__lt__", "__gt__", "__len__")
            ]
    return found


def stub_arguments(function: ast.FunctionDef) -> list[tuple[str, str]]:
    """(name, default) of each argument, "" for none; "*" before those that must be named."""
    plain, named = function.args.args, function.args.kwonlyargs
    defaults = [None] * (len(plain) - len(function.args.defaults)) + function.args.defaults
    found = [(a.arg, ast.unparse(d) if d else "") for a, d in zip(plain, defaults, strict=True)]
    found += [("*", "")] if named else []
    pairs = zip(named, function.args.kw_defaults, strict=True)
    return found + [(a.arg, ast.unparse(d) if d else "") for a, d in pairs]


def bound_arguments(text: str) -> list[tuple[str, str]]:
    """The same out of "name(self: Owner, a: Type = default, ...) -> Type"."""
    inner = text[text.index("(") + 1 : text.rindex(") -> ")]
    parts, depth = [""], 0
    for letter in inner:
        depth += (letter in "([{<") - (letter in ")]}>")
        parts += [""] if letter == "," and depth == 0 else []
        parts[-1] += letter if letter != "," or depth else ""
    named = [
        re.match(r"\s*(\*|\w+)(?:: .*?)?(?: = (.*))?$", part, re.DOTALL) for part in parts if part
    ]
    return [(match[1], match[2] or "") for match in named if match]


def same_default(ours: str, theirs: str) -> bool:
    """Numbers and texts are compared as such; "..." stands for anything."""
    if ours in ("...", "") or theirs == "":
        return ours == theirs or (ours == "..." and theirs != "")
    try:
        return bool(ast.literal_eval(ours) == ast.literal_eval(theirs))
    except (ValueError, SyntaxError):
        return ours == theirs


def test_the_stub_has_the_arguments_and_defaults_of_the_compiled_functions(root: Path) -> None:
    from hurcules import _core

    functions = stub_functions(root)
    assert len(functions) > 50
    for name, function in functions:
        bound = _core
        for part in name.split("."):
            bound = getattr(bound, part)
        theirs = bound_arguments((inspect.getdoc(bound) or "").splitlines()[0])
        ours = stub_arguments(function)
        assert [n for n, _ in ours] == [n for n, _ in theirs], name
        wrong = [(a, b) for a, b in zip(ours, theirs, strict=True) if not same_default(a[1], b[1])]
        assert wrong == [], name


def test_the_stub_has_the_enumerators_of_the_compiled_module(root: Path) -> None:
    from hurcules import _core

    tree = ast.parse((root / "python/hurcules/_core.pyi").read_text(encoding="utf-8"))
    stubbed = {
        owner.name: [n.target.id for n in owner.body if isinstance(n, ast.AnnAssign)]
        for owner in tree.body
        if isinstance(owner, ast.ClassDef) and [ast.unparse(b) for b in owner.bases] == ["_Enum"]
    }
    bound = {
        name: [*value.__members__, "__members__"]
        for name, value in vars(_core).items()
        if hasattr(value, "__members__")
    }
    assert stubbed == bound


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
