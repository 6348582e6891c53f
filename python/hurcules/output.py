"""The folder that a run writes to: whole files or none, and a clear word when the disk says no."""

from __future__ import annotations

import json
import math
import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from reprlib import Repr
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from hurcules._core import Error

__all__ = [
    "Output",
    "WriteError",
    "compiled",
    "differing",
    "plain",
    "whole",
    "write_whole",
    "writing",
]

_SHORT = Repr()
_SHORT.maxdict = _SHORT.maxlist = 100
_SHORT.maxstring = _SHORT.maxother = 40


class WriteError(Error):
    """A file could not be written; the text says why, and which files were."""


@contextmanager
def writing(path: Path) -> Iterator[None]:
    """What is done inside writes this file.

    Raises:
        WriteError: the file could not be written.
    """
    try:
        yield
    except OSError as error:
        raise WriteError(f"cannot write {path}: {error.strerror}") from error


def compiled(model: mujoco.MjModel) -> bytes:
    """What a file of MuJoCo's own (.mjb) holds of a model."""
    content = np.empty(mujoco.mj_sizeModel(model), np.uint8)
    mujoco.mj_saveModel(model, None, content)
    return content.tobytes()


def write_whole(path: Path, contents: bytes) -> None:
    """Writes a file under another name beside it and renames it when it is whole.

    Raises:
        WriteError: the file could not be written; one of this name is as it was.
    """
    with writing(path), whole(path) as part:
        part.write_bytes(contents)


@contextmanager
def whole(path: Path) -> Iterator[Path]:
    """Another name beside a file, renamed to it in the end; after an error nothing is left.

    The folder is made, where there is none.
    """
    with suppress(FileExistsError):  # a file in its place: what writes is told so
        path.parent.mkdir(parents=True, exist_ok=True)
    part = path.with_name(f"part-{os.getpid()}-{path.name}")  # two runs may share a folder
    try:
        yield part
        part.replace(path)
    finally:
        part.unlink(missing_ok=True)


def differing(there: Mapping[str, Any], now: Mapping[str, Any]) -> list[str]:
    """What two runs were made of where that differs, in words.

    Args:
        there: of an earlier run.
        now: of another; what is not named here may be anything there.
    """
    return [
        f"{name} (there {_SHORT.repr(there.get(name))}, now {_SHORT.repr(mine)})"
        for name, mine in now.items()
        if there.get(name) != mine
    ]


class Output:
    """A folder for results.

    Attributes:
        folder: the folder; it exists and can be written.
        saved: the files written so far.
        replaces: the earlier run whose files give way to those of this one, in words; "": there
            is none.
    """

    def __init__(
        self,
        folder: Path,
        names: Sequence[str],
        made_of: Mapping[str, Any] | None = None,
        named: bool = True,
    ) -> None:
        """Makes the folder.

        Args:
            folder: for the results.
            names: of files that an earlier run may have left there: they are removed before the
                first one is written, not sooner.
            made_of: what the run is made of, as its summary.json says it: in a folder that was
                asked for only the same run takes the place of an earlier one.
            named: whether it was asked for; False: it is the usual one, where the last run lies.

        Raises:
            Error: the folder cannot be made or written, or holds another run.
        """
        self.folder = folder
        self.saved: list[Path] = []
        self._earlier = [folder / name for name in names]
        try:
            folder.mkdir(parents=True, exist_ok=True)
            probe = folder / ".probe"
            probe.touch()
            probe.unlink()
        except OSError as error:
            reason = "it is a file" if folder.is_file() else error.strerror
            raise Error(f"--out: cannot write to {folder}: {reason}") from error
        self.replaces = ""
        if made_of is None or not any(path.exists() for path in self._earlier):
            return
        others = _others(folder, plain(made_of))
        if others and named:
            raise Error(f"--out: {folder} holds another run: {others}; give another folder")
        which = "another run" if others else "the same run"
        self.replaces = f"takes the place of {which} in {folder}" + f": {others}" * bool(others)

    def write(self, name: str, writer: Callable[[Path], None]) -> Path:
        """Writes a file under another name and renames it when it is whole.

        Args:
            name: of the file.
            writer: writes everything to the path that it is given.

        Returns:
            The file.

        Raises:
            WriteError: disk full, no permission, ...
        """
        path = self.folder / name
        try:
            while self._earlier:
                self._earlier.pop().unlink(missing_ok=True)
            with whole(path) as part:
                writer(part)
        except OSError as error:
            # an encoder's failure has no strerror but many lines, the last of which tells
            reason = error.strerror or str(error).strip().splitlines()[-1]
            raise WriteError(f"cannot write {path}: {reason}; {self.told()}") from error
        self.saved.append(path)
        return path

    def write_json(self, name: str, content: dict[str, Any]) -> Path:
        """Writes plain data as JSON; raises as `write`."""
        text = json.dumps(content, indent=2, ensure_ascii=False, allow_nan=False) + "\n"
        return self.write(name, lambda path: void(path.write_text(text, encoding="utf-8")))

    def write_arrays(self, name: str, arrays: dict[str, NDArray[np.float64]]) -> Path:
        """Writes arrays as a compressed .npz; raises as `write`."""
        channels: dict[str, Any] = dict(arrays)

        def save(path: Path) -> None:
            with path.open("wb") as file:
                np.savez_compressed(file, **channels)

        return self.write(name, save)

    def told(self) -> str:
        """What was saved, in words."""
        names = ", ".join(path.name for path in self.saved)
        return f"saved in {self.folder}: {names}" if names else "nothing was saved"


def _others(folder: Path, made_of: Mapping[str, Any]) -> str:
    """What the run of a folder was made of where that differs; "": it is the same."""
    try:
        there = dict(json.loads((folder / "summary.json").read_text(encoding="utf-8")))
    except (OSError, ValueError, TypeError):
        return "no summary.json tells of its files"
    return ", ".join(differing(there, made_of))


def plain(value: Any) -> Any:
    """NumPy's numbers as Python's; what is not finite as None, for JSON has no word for it."""
    if isinstance(value, dict):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [plain(item) for item in value]
    if isinstance(value, bool | np.bool_):
        return bool(value)
    if isinstance(value, int | np.integer):
        return int(value)
    if isinstance(value, float | np.floating):
        return float(value) if math.isfinite(value) else None
    return value


def void(_: object) -> None:
    """Drops a result."""
