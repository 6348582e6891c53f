"""The film of a run: two cameras, and strips that say what goes on and what gives way to what."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from contextlib import ExitStack
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from hurcules import extras
from hurcules.legend import level_words, limit_words
from hurcules.rendering import open_renderer, overview_camera, pose

__all__ = ["Frame", "Inset", "Painter", "encode", "film"]

Picture = NDArray[np.uint8]  # (height, width, 3)

WIDTH, HEIGHT = 1280, 720  # multiples of 16, as the encoder wants them
INSET_WIDTH, INSET_HEIGHT = 320, 180
STRIP, NOTE = 64, 40  # heights of the caption and of the note below it [pixels]
# a quarter of MuJoCo's, and one sample a pixel: drawn by software, samples double the time of a
# picture and shadows add half of it; edges and shadows look the same
SHADOW_MAP, SAMPLES = 1024, 0
ACCENT, PAPER, SOFT, INK = (255, 138, 60), (246, 246, 243), (170, 174, 180), (20, 22, 25)


@dataclass(frozen=True)
class Frame:
    """What the film needs to know of one moment."""

    time: float  # [s]
    qpos: NDArray[np.float64]  # (nq)
    phase: str
    active: tuple[str, ...]  # active limits, e.g. ("HIP upper",)
    note: str = ""  # what the phase is for
    yields: tuple[str, ...] = ()  # levels that give way to those above them


@dataclass(frozen=True)
class Inset:
    """A second camera, in a corner."""

    camera: mujoco.MjvCamera | str  # or the name of one of the model
    title: str


class Painter:
    """Draws frames of one model; a context manager, for it holds the renderers."""

    def __init__(
        self,
        model: mujoco.MjModel,
        camera: mujoco.MjvCamera | str | None = None,
        inset: Inset | None = None,
    ) -> None:
        """Opens the renderers.

        Args:
            model: what is drawn.
            camera: for the overview, or the name of one of the model; by default one that stands
                still.
            inset: a second camera; by default the model's head camera, where it has one.

        Raises:
            RendererError: there is no OpenGL that works.
        """
        self._model, self._data = model, mujoco.MjData(model)
        quality = model.vis.quality
        quality.shadowsize = min(SHADOW_MAP, quality.shadowsize)
        quality.offsamples = min(SAMPLES, quality.offsamples)
        self._camera = camera or overview_camera()
        heads = [name for name in _cameras(model) if name.startswith("head")]
        self._inset = inset or (Inset(heads[0], "head camera") if heads else None)
        self._stack = ExitStack()
        self._overview = self._stack.enter_context(open_renderer(model, WIDTH, HEIGHT))
        if self._inset:
            self._small = self._stack.enter_context(open_renderer(model, INSET_WIDTH, INSET_HEIGHT))
        with extras.importing(extras.remedy()):
            import matplotlib
            from PIL import ImageFont

        fonts = Path(matplotlib.get_data_path()) / "fonts" / "ttf"
        self._text = ImageFont.truetype(str(fonts / "DejaVuSans.ttf"), 22)
        self._bold = ImageFont.truetype(str(fonts / "DejaVuSans-Bold.ttf"), 26)

    def __enter__(self) -> Painter:
        return self

    def __exit__(self, *_: object) -> None:
        self._stack.close()

    def picture(self, qpos: NDArray[np.float64]) -> Picture:
        """The overview alone, (720, 1280, 3)."""
        return self.view(qpos, self._camera)

    def view(self, qpos: NDArray[np.float64], camera: mujoco.MjvCamera | str) -> Picture:
        """What any camera sees, (720, 1280, 3)."""
        pose(self._model, self._data, qpos)
        self._overview.update_scene(self._data, camera)
        return self._overview.render()

    def frame(self, frame: Frame, note: str = "") -> Picture:
        """The overview with the inset and the captions, (720, 1280, 3)."""
        from PIL import Image

        image = Image.fromarray(self.picture(frame.qpos))
        if self._inset:
            self._paste(image, self._inset)
        self._write_caption(image, frame, note)
        if frame.note or frame.yields:
            self._write_note(image, frame)
        return np.asarray(image)

    def _paste(self, image: Any, inset: Inset) -> None:
        from PIL import Image, ImageDraw

        self._small.update_scene(self._data, inset.camera)
        self._small.scene.flags[mujoco.mjtRndFlag.mjRND_SHADOW] = False
        left, top = WIDTH - INSET_WIDTH - 24, STRIP + NOTE + 24
        draw = ImageDraw.Draw(image)
        draw.rectangle((left - 3, top - 3, left + INSET_WIDTH + 2, top + INSET_HEIGHT + 2), PAPER)
        image.paste(Image.fromarray(self._small.render()), (left, top))
        draw.rectangle((left, top, left + INSET_WIDTH - 1, top + 29), INK)
        draw.text((left + 10, top + 15), inset.title, PAPER, self._text.font_variant(size=16), "lm")

    def _write_caption(self, image: Any, frame: Frame, note: str) -> None:
        from PIL import ImageDraw

        draw = ImageDraw.Draw(image)
        middle = STRIP // 2
        draw.rectangle((0, 0, WIDTH, STRIP), INK)  # at the top: players lay their buttons below
        draw.text((28, middle), f"{frame.time:5.1f} s", PAPER, self._bold, anchor="lm")
        draw.text((160, middle), f"{frame.phase}   {note}", SOFT, self._text, anchor="lm")
        right = WIDTH - 28.0
        for text in reversed(limit_words(frame.active)):
            width = draw.textlength(text, self._text) + 24
            draw.rounded_rectangle((right - width, middle - 18, right, middle + 18), 6, ACCENT)
            draw.text((right - width / 2, middle), text, INK, self._text, anchor="mm")
            right -= width + 12
        label = "limits" if frame.active else "no active limit"
        draw.text((right, middle), label, SOFT, self._text, anchor="rm")

    def _write_note(self, image: Any, frame: Frame) -> None:
        from PIL import ImageDraw

        draw = ImageDraw.Draw(image)
        middle = STRIP + NOTE // 2
        draw.rectangle((0, STRIP, WIDTH, STRIP + NOTE), PAPER)
        draw.text((160, middle), frame.note, INK, self._text, anchor="lm")
        if frame.yields:
            words = "gives way: " + ", ".join(level_words(name) for name in frame.yields)
            draw.text((WIDTH - 28, middle), words, INK, self._text, anchor="rm")


def film(
    painter: Painter,
    path: Path,
    frames: Sequence[Frame],
    origin: float,
    fps: int,
    note: str,
    progress: Callable[[int], None],
    stopped: Callable[[], bool],
) -> int:
    """Writes an H.264 film, of all frames or until it is stopped, and of one at least.

    Args:
        painter: draws the frames.
        path: the file, .mp4.
        frames: one a picture.
        origin: [s] time that the captions call 0.
        fps: [1/s] pictures a second.
        note: stands in the caption of each frame.
        progress: called after each frame with the number drawn.
        stopped: whether to end early, asked after each frame.

    Returns:
        The number of frames in the film, less than asked for only when stopped.

    Raises:
        OSError: the file cannot be written.
    """
    captioned = (painter.frame(replace(frame, time=frame.time - origin), note) for frame in frames)
    return encode(path, captioned, fps, progress, stopped)


def encode(
    path: Path,
    pictures: Iterable[Picture],
    fps: int,
    progress: Callable[[int], None] = lambda _: None,
    stopped: Callable[[], bool] = lambda: False,
) -> int:
    """Writes pictures (height, width, 3), multiples of 16, as an H.264 film.

    Arguments, result and errors are those of `film`.
    """
    with extras.importing(extras.remedy()):
        import imageio.v2 as imageio

    done = 0
    writer = imageio.get_writer(
        path,
        format="FFMPEG",
        fps=fps,
        codec="libx264",
        quality=None,
        macro_block_size=16,
        output_params=["-crf", "25", "-preset", "veryfast", "-movflags", "+faststart"],
    )
    try:
        for picture in pictures:
            writer.append_data(picture)
            done += 1
            progress(done)
            if stopped():
                break
    finally:
        writer.close()
    return done


def _cameras(model: mujoco.MjModel) -> list[str]:
    return [model.camera(i).name for i in range(model.ncam)]
