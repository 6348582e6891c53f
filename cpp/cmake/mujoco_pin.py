"""The run-time requirements of the wheel: those in pyproject.toml, and MuJoCo as pinned there."""

import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any


def dynamic_metadata(settings: Mapping[str, Any], _project: Mapping[str, Any]) -> dict[str, Any]:
    """Called by scikit-build-core with the [[tool.dynamic-metadata]] table of pyproject.toml."""
    pyproject = tomllib.loads(Path("pyproject.toml").read_text(encoding="utf-8"))
    build = pyproject["build-system"]["requires"]
    pin = [requirement for requirement in build if requirement.startswith("mujoco==")]
    return {"dependencies": pin + settings["dependencies"]}
