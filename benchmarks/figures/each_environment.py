"""Writes docs/each_environment.md, a section an environment, and draws its pictures.

The text of a section is that of the class; the pictures are of its expert.

Run:  python benchmarks/figures/each_environment.py [--pictures]
      python benchmarks/figures/each_environment.py --check
"""

from __future__ import annotations

import argparse
import inspect
import sys
from importlib import import_module
from pathlib import Path

import gymnasium
import imageio.v3 as imageio

import hurcules_envs
from hurcules_envs.registry import usual_rate

DOCS = Path(__file__).resolve().parents[2] / "docs"
SEED = 3
# by name: the step of the expert's episode that is drawn, or the picture that there is
SHOWN: dict[str, int | str] = {
    "Reach-v0": 12, "ReachPrecise-v0": 20, "Drive-v0": 15, "Press-v0": 60, "Valve-v0": 30,
    "Door-v0": 70, "Carry-v0": 45, "Stretch-v1": 40, "Lift-v0": "lift.jpg",
    "Rescue-v0": "rescue.jpg", "Casualty-v0": "casualty.jpg", "Dispose-v0": "disposal.jpg",
    "Stretch-v0": "stretch.png",
}  # fmt: skip
HEAD = """# Each environment

What is seen, commanded, rewarded, wanted, and what differs between episodes. This page is the text
of the classes (`python benchmarks/figures/each_environment.py`); what they have in common stands in
[environments.md](environments.md): keywords, `info`, [randomisation](environments.md#randomisation)
of robot and world by options, vectors, training, how often experts and policies succeed.
"""


def section(name: str) -> str:
    """Heading, picture, limit and the text of the class."""
    spec = gymnasium.spec(f"Hurcules/{name}")
    module, kind = spec.kwargs.get("environment", spec.entry_point).split(":")
    of = getattr(import_module(module), kind)
    steps = spec.max_episode_steps or 0
    rate = usual_rate(spec, of.rate) if "environment" in spec.kwargs else 50.0  # of Stretch-v0
    limit = f"{steps:,} steps, {steps / rate:g} s"
    twin = name.replace("-", "Joint-")
    known = f"Hurcules/{twin}" in hurcules_envs.ENVIRONMENTS
    beside = f"; joints as the action: `{twin}`" if known else ""
    shown = SHOWN[name]
    picture = shown if isinstance(shown, str) else f"environments/{name}.jpg"
    return (
        f"## {name}\n\n![{name}]({picture})\n\n{of.task_description} Cut after {limit}{beside}.\n\n"
        f"{inspect.cleandoc(of.__doc__ or '')}\n"
    )


def page() -> str:
    """The whole of it, the old one last."""
    names = [name.split("/")[1] for name in hurcules_envs.ENVIRONMENTS if "Joint" not in name]
    return "\n".join([HEAD, *map(section, sorted(names, key="Stretch-v0".__eq__))])


def draw(name: str, step: int) -> None:
    """A picture of the expert's episode."""
    env = gymnasium.make(
        f"Hurcules/{name}", fidelity="fast", render_mode="rgb_array", width=480, height=272
    ).unwrapped
    env.reset(seed=SEED)
    for _ in range(step):
        env.step(env.environment.expert(env.numbers)[0].astype("float32"))
    imageio.imwrite(DOCS / "environments" / f"{name}.jpg", env.render(), quality=85)
    env.close()


def main() -> int:
    """Writes or checks the page."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true", help="whether it is what it should be")
    parser.add_argument("--pictures", nargs="*", metavar="NAME", help="draw these, or all")
    given = parser.parse_args()
    path = DOCS / "each_environment.md"
    if given.check:
        same = path.read_text(encoding="utf-8") == page()
        print("as the classes say" if same else f"{path}: the classes say something else")
        return not same
    path.write_text(page(), encoding="utf-8")
    if given.pictures is not None:
        (DOCS / "environments").mkdir(exist_ok=True)
        for name, shown in SHOWN.items():
            if isinstance(shown, int) and name in (given.pictures or SHOWN):
                draw(name, shown)
    return 0


if __name__ == "__main__":
    sys.exit(main())
