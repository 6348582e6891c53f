"""Shared by all tests: where the checkout is, and what make built there."""

from pathlib import Path

import pytest

import hurcules  # noqa: F401  before any test imports MuJoCo: it chooses the OpenGL

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="session")
def root() -> Path:
    """The checkout."""
    return ROOT


@pytest.fixture(scope="session")
def build(root: Path) -> Path:
    """The CMake build folder that `make` filled."""
    folder = root / "build" / "make"
    if not (folder / "CMakeCache.txt").is_file():
        pytest.skip("no build/make here; remedy: make setup")
    return folder
