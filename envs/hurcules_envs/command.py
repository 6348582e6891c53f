"""The commands `hurcules train` and `hurcules evaluate`."""

from __future__ import annotations

import json
from dataclasses import asdict
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn, TimeRemainingColumn

import hurcules
from hurcules.cli import results_in

__all__ = ["evaluate", "train"]

MISSING = "training wants Stable-Baselines3 and PyTorch: pip install 'hurcules[train]'"

Fidelity = Annotated[
    str | None, typer.Option(help="exact, fast or kinematic.", show_default="kinematic")
]
Robot = Annotated[str | None, typer.Option(help="rescue, manipulation or a path.")]


def train(
    environment: Annotated[str, typer.Argument(help="Reach-v0, Drive-v0, ...")],
    algo: Annotated[str, typer.Option(help="ppo, sac or her.")] = "ppo",
    steps: Annotated[int, typer.Option(help="Of all episodes together.")] = 100_000,
    envs: Annotated[int, typer.Option(help="Episodes side by side.")] = 16,
    seed: Annotated[int, typer.Option(help="Of networks and episodes.")] = 0,
    fidelity: Fidelity = None,
    robot: Robot = None,
    action: Annotated[str | None, typer.Option(help="twist, delta, pose or joint.")] = None,
    out: Annotated[Path | None, results_in("out/train/ENVIRONMENT")] = None,
    judge: Annotated[int, typer.Option(help="Episodes of the evaluation, in exact.")] = 100,
) -> None:
    """Train a policy that commands a robot in task space, then judge it in the full physics.

    Goes on where an earlier run in the same folder was stopped. Writes policy.zip, checkpoint.zip,
    settings.json and evaluation.json.

    For example `hurcules train Reach-v0 --fidelity kinematic --steps 80000`
    """
    training = _training()
    name = _full(environment)
    options = _given(fidelity=fidelity or "kinematic", robot=robot, action=action)
    folder = out or Path("out", "train", name.split("/")[-1])
    wanted = training.TrainOptions(
        environment=name, algorithm=algo, steps=steps, episodes=envs, seed=seed, options=options,
        out=folder,
    )  # fmt: skip
    console = Console()
    columns = [
        TextColumn("{task.description}"), BarColumn(), TextColumn("{task.completed:,} steps"),
        TextColumn("success {task.fields[success]:.0%}"), TimeElapsedColumn(),
        TimeRemainingColumn(),
    ]  # fmt: skip
    with Progress(*columns, console=console) as bar:
        task = bar.add_task(f"{algo} on {name}", total=steps, success=0.0)
        training.train(wanted, lambda n, share: bar.update(task, completed=n, success=share))
    _judge(folder, judge, "exact", None, console)


def evaluate(
    folder: Annotated[Path, typer.Argument(help="That train wrote.")],
    fidelity: Annotated[str, typer.Option(help="exact, fast or kinematic.")] = "exact",
    robot: Robot = None,
    episodes: Annotated[int, typer.Option(help="How many.")] = 100,
) -> None:
    """Judge a trained policy: success with its 95 % interval, falls, limits, self-contact.

    For example `hurcules evaluate out/train/Reach-v0 --robot manipulation`
    """
    _judge(folder, episodes, fidelity, robot, Console())


def _judge(folder: Path, episodes: int, fidelity: str, robot: str | None, console: Console) -> None:
    training = _training()
    model, settings = training.load_policy(folder)
    options = settings["options"] | _given(fidelity=fidelity, robot=robot)
    result = training.evaluate(
        lambda seen: model.predict(seen, deterministic=True)[0],
        settings["environment"],
        episodes,
        **options,
    )
    figures = asdict(result) | {"environment": settings["environment"], "options": options}
    path = folder / "evaluation.json"
    path.write_text(json.dumps(figures, indent=2) + "\n")
    words = ", ".join(f"{name} {value}" for name, value in options.items())
    console.print(f"{settings['environment']} ({words}), {episodes} episodes")
    console.print(f"  success        {result.success:.0%} ({result.low:.0%} to {result.high:.0%})")
    console.print(f"  falls          {result.falls:.0%}")
    console.print(f"  over a limit   {1e3 * result.limit_excess:.1f} mrad at most, measured")
    console.print(f"  self-contact   {result.self_contacts:.2%} of the steps")
    console.print(f"  {path}")


def _training() -> Any:
    try:
        from hurcules_envs import training
    except ImportError as error:
        raise hurcules.Error(f"{MISSING} ({error})") from error
    return training


def _full(name: str) -> str:
    name = name.removeprefix("hurcules_envs:")
    return name if name.startswith("Hurcules/") else f"Hurcules/{name}"


def _given(**options: str | None) -> dict[str, str]:
    return {name: value for name, value in options.items() if value is not None}
