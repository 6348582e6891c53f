"""The packages that only film, plots and report need: the extra `hurcules[report]`."""

from importlib.util import find_spec

__all__ = ["EXTRA", "REMEDY", "missing", "without"]

# module -> package
EXTRA = {
    "matplotlib": "matplotlib",
    "PIL": "pillow",
    "jinja2": "jinja2",
    "imageio": "imageio",
    "imageio_ffmpeg": "imageio-ffmpeg",
}
REMEDY = "pip install 'hurcules[report]'"


def missing() -> list[str]:
    """Those modules that are not installed."""
    return [module for module in EXTRA if find_spec(module) is None]


def without() -> str:
    """What a run says where something is missing; "" where nothing is."""
    lost = [EXTRA[module] for module in missing()]
    if not lost:
        return ""
    verb = "is" if len(lost) == 1 else "are"
    return f"{', '.join(lost)} {verb} not installed; remedy: {REMEDY}"
