"""The packages that not everybody needs: the extras of pyproject.toml, and what is without them."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from importlib.metadata import PackageNotFoundError, requires
from importlib.util import find_spec

__all__ = ["FOR", "importing", "missing", "names", "packages", "remedy", "without"]

# what each is for
FOR = {
    "report": "film and report",
    "train": "hurcules train",
    "urdf": "meshes of URDF",
    "data": "hurcules record",
}
# the modules of packages that are not called alike
_MODULES = {"pillow": "PIL", "pycollada": "collada"}


def names() -> list[str]:
    """The extras, as the package's metadata has them."""
    return list(dict.fromkeys(re.findall(r'extra == "(.+?)"', " ".join(_requirements()))))


def packages(extra: str) -> list[str]:
    """Those of an extra, as the package's metadata has them."""
    wanted = [one for one in _requirements() if f'extra == "{extra}"' in one]
    return [re.split(r"[^\w.-]", one, maxsplit=1)[0] for one in wanted]


def _requirements() -> list[str]:
    try:
        return requires("hurcules") or []
    except PackageNotFoundError:  # sources without an installation
        return []


def missing(extra: str = "report") -> list[str]:
    """Those of them that are not installed."""
    return [
        package
        for package in packages(extra)
        if find_spec(_MODULES.get(package, package.replace("-", "_"))) is None
    ]


def remedy(extra: str = "report") -> str:
    """What installs them."""
    return f"pip install 'hurcules[{extra}]'"


def without() -> str:
    """What a run says where something of film and report is missing; "" where nothing is."""
    lost = missing()
    if not lost:
        return ""
    verb = "is" if len(lost) == 1 else "are"
    return f"{', '.join(lost)} {verb} not installed; remedy: {remedy()}"


@contextmanager
def importing(install: str) -> Iterator[None]:
    """Around imports of what not everybody has.

    Args:
        install: the command that installs it.

    Raises:
        ImportError: as it was raised inside, with this command.
    """
    try:
        yield
    except ImportError as error:
        text = f"{error}; remedy: {install}"
        raise type(error)(text, name=error.name, path=error.path) from error
