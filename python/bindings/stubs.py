"""Writes python/hurcules/_core.pyi, the types of the compiled module, with its docstrings.

Run:  python python/bindings/stubs.py            writes the file
      python python/bindings/stubs.py --check    says whether it is up to date, by its exit status

pybind11-stubgen reads the signatures of the installed module; what it leaves open or writes at
length is tidied here: numbers are int and float, arrays may come as anything array-like, a bare
dict holds Any, enumerations share a base. To change a type, change the binding.
"""

from __future__ import annotations

import argparse
import ast
import re
import subprocess
import sys
import tempfile
from pathlib import Path

MODULE = "hurcules._core"
TARGET = Path(__file__).resolve().parents[1] / "hurcules" / "_core.pyi"
HEAD = '''"""{doc}

Written by python/bindings/stubs.py out of the compiled module; not to be edited.
"""

import collections.abc
import os
from typing import Annotated, Any, ClassVar, overload, type_check_only

import mujoco
import numpy as np
from numpy.typing import ArrayLike, NDArray

build: dict[str, str | bool]  # version, mujoco, eigen, simd, compiler, build_type, flags, asserts


class Error(ValueError):
    """Bad input: what was wanted, what came, and where."""


@type_check_only
class _Enum:
    """What pybind11 gives each enumeration."""

    def __init__(self, value: int) -> None: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...
    def __eq__(self, other: object, /) -> bool: ...
    def __ne__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __int__(self) -> int: ...
    def __index__(self) -> int: ...


'''
NAMES = {
    "typing.SupportsFloat | typing.SupportsIndex": "float",
    "typing.SupportsInt | typing.SupportsIndex": "int",
    "numpy.bool]": "np.bool_]",  # numpy 1 has no bool
    "numpy.typing.": "",
    "numpy.": "np.",
    "typing.": "",
    "hurcules._core.": "",
}
# of a class that only the library makes objects of: pybind11's refuses at run time
# put there by hurcules._reprs and hurcules._subclasses
INSTALLED = ("__repr__", "_repr_html_", "__init_subclass__", "__signature__")
NO_INIT = "def __init__(self, *args: object, **kwargs: object) -> None: ..."
# what a bare container holds
BARE = {
    "dict": "dict[str, Any]",
    "collections.abc.Callable": "collections.abc.Callable[..., Any]",
    "list": "list[Any]",
    "tuple": "tuple[Any, ...]",
    "os.PathLike": "os.PathLike[str]",
    "collections.abc.Iterable": "collections.abc.Iterable[Any]",
}


def generated() -> str:
    """The file as it should be."""
    with tempfile.TemporaryDirectory() as folder:
        words = [sys.executable, "-m", "pybind11_stubgen", MODULE, "-o", folder]
        done = subprocess.run(words, capture_output=True, text=True)
        if done.returncode != 0:
            raise SystemExit(f"pybind11-stubgen failed:\n{done.stderr}")
        text = (Path(folder) / MODULE.replace(".", "/")).with_suffix(".pyi").read_text("utf-8")
    tree = ast.parse(text)
    kept = [node for node in tree.body if isinstance(node, ast.ClassDef | ast.FunctionDef)]
    parts = [ast.unparse(_tidy(node)) for node in kept]
    raw = HEAD.format(doc=(ast.get_docstring(tree) or "").strip()) + "\n\n\n".join(parts) + "\n"
    return _formatted(raw)


def _tidy(node: ast.stmt) -> ast.stmt:
    if isinstance(node, ast.ClassDef) and any(_target(one) == "__members__" for one in node.body):
        node.bases = [ast.Name("_Enum")]
        doc = (ast.get_docstring(node) or "").partition("Members:")[0].strip()
        members = [one for one in node.body if isinstance(one, ast.AnnAssign)]
        node.body = [ast.Expr(ast.Constant(doc)), *members]
    elif isinstance(node, ast.ClassDef) and not any(
        isinstance(one, ast.FunctionDef) and one.name == "__init__" for one in node.body
    ):
        node.body += ast.parse(NO_INIT).body
    result: ast.stmt = _Types().visit(node)
    return result


def _target(node: ast.stmt) -> str:
    if isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name):
        return node.target.id
    return ""


class _Types(ast.NodeTransformer):
    """Writes annotations as people do, and docstrings without indentation at their ends."""

    def visit_FunctionDef(self, node: ast.FunctionDef) -> ast.AST | None:
        if node.name in INSTALLED and node.decorator_list:
            return None
        if node.returns:
            node.returns = _type(node.returns)
        for argument in (*node.args.posonlyargs, *node.args.args, *node.args.kwonlyargs):
            if argument.annotation:
                argument.annotation = _type(argument.annotation, taken=True)
        for decorator in node.decorator_list:
            if isinstance(decorator, ast.Attribute) and decorator.attr == "overload":
                node.decorator_list[node.decorator_list.index(decorator)] = ast.Name("overload")
        if node.name == "__eq__":
            node.args.args[1].annotation = ast.Name("object")
        self._clean(node)
        return node

    def visit_ClassDef(self, node: ast.ClassDef) -> ast.AST:
        self.generic_visit(node)
        self._clean(node)
        return node

    def visit_AnnAssign(self, node: ast.AnnAssign) -> ast.AST | None:
        if _target(node) in INSTALLED:
            return None
        node.annotation = _type(node.annotation)
        return node

    def _clean(self, node: ast.FunctionDef | ast.ClassDef) -> None:
        """A docstring alone is body enough, its lines without a margin."""
        doc = ast.get_docstring(node)
        if doc:
            # a line of text and the margin of the closing quotes, as in the rest of the package
            node.body[0] = ast.Expr(ast.Constant(doc))
            node.body = [one for one in node.body if not _is_ellipsis(one)]


def _is_ellipsis(node: ast.stmt) -> bool:
    return (
        isinstance(node, ast.Expr)
        and isinstance(node.value, ast.Constant)
        and node.value.value is ...
    )


def _type(annotation: ast.expr, taken: bool = False) -> ast.expr:
    """The annotation in short; `taken`: of an argument, which may be anything array-like."""
    text = ast.unparse(annotation)
    for long, short in NAMES.items():
        text = text.replace(long, short)
    if taken:
        text = text.replace("NDArray[np.float64]", "ArrayLike")
    tree = ast.parse(text, mode="eval").body
    return _filled(tree)


def _filled(node: ast.expr) -> ast.expr:
    """Bare containers get the type of what they hold."""
    if ast.unparse(node) in BARE:
        return ast.parse(BARE[ast.unparse(node)], mode="eval").body
    if isinstance(node, ast.Subscript):
        if ast.unparse(node.value) == "Annotated" and isinstance(node.slice, ast.Tuple):
            # arrays: the shape is in the docstring, the caster checks it
            return node.slice.elts[0]
        inner = node.slice.elts if isinstance(node.slice, ast.Tuple) else [node.slice]
        inner = [_filled(one) for one in inner]
        node.slice = ast.Tuple(inner) if isinstance(node.slice, ast.Tuple) else inner[0]
    elif isinstance(node, ast.BinOp):
        node.left, node.right = _filled(node.left), _filled(node.right)
    return node


def _formatted(text: str) -> str:
    words = [sys.executable, "-m", "ruff", "--config", str(TARGET.parents[2] / "pyproject.toml")]
    for more in (["check", "--select", "F401,I", "--fix", "--quiet"], ["format", "--quiet"]):
        command = [*words[:3], *more, *words[3:], "--stdin-filename", str(TARGET), "-"]
        done = subprocess.run(command, input=text, capture_output=True, text=True)
        if done.returncode != 0 or not done.stdout:
            raise SystemExit(f"ruff failed:\n{done.stderr}{done.stdout}")
        text = done.stdout
    # mutable, so without a hash: the annotation that type checkers know
    unhashable = "__hash__: ClassVar[None]  # type: ignore[assignment]"
    return re.sub(r"__hash__: .*None.*", unhashable, text)


def main() -> None:
    """Writes or checks the stub."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--check", action="store_true", help="write nothing, exit 1 if outdated")
    wanted = generated()
    if not parser.parse_args().check:
        TARGET.write_text(wanted, encoding="utf-8")
    elif TARGET.read_text(encoding="utf-8") != wanted:
        raise SystemExit(f"{TARGET} is not up to date; remedy: make stubs")


if __name__ == "__main__":
    main()
