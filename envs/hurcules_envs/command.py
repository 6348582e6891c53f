"""The commands `hurcules train`, `evaluate` and `record`."""

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

__all__ = ["evaluate", "record", "train"]

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
    ray: Annotated[
        str | None,
        typer.Option(help="Address of a Ray cluster, auto, or local: PPO by RLlib."),
    ] = None,
    judge: Annotated[int, typer.Option(help="Episodes of the evaluation, in exact.")] = 100,
) -> None:
    """Train a policy that commands a robot in task space, then judge it in the full physics.

    Goes on where an earlier run in the same folder was stopped. Writes policy.zip, checkpoint.zip,
    settings.json and evaluation.json.

    For example `hurcules train Reach-v0 --fidelity kinematic --steps 80000`
    """
    name = _full(environment)
    options = _given(fidelity=fidelity or "kinematic", robot=robot, action=action)
    folder = out or Path("out", "train", name.split("/")[-1])
    if ray is not None:
        return _on_cluster(ray, name, steps, folder, options, envs, seed)
    training = _training()
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


def _on_cluster(
    address: str, name: str, steps: int, folder: Path, options: dict[str, str], envs: int, seed: int
) -> None:
    try:
        from hurcules_envs import rllib
    except ImportError as error:
        raise hurcules.Error(f"--ray wants RLlib: pip install 'ray[rllib]' ({error})") from error
    console = Console()
    checkpoint = rllib.train(
        name, address, steps, folder, options, episodes=envs, seed=seed,
        progress=lambda done, mean: console.print(f"{done:>9,} steps   mean return {mean:.2f}"),
    )  # fmt: skip
    console.print(f"{checkpoint}")


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


def record(
    environment: Annotated[str, typer.Argument(help="Reach-v0, Drive-v0, ...")],
    policy: Annotated[str, typer.Option(help="expert, or a folder that train wrote.")] = "expert",
    episodes: Annotated[int, typer.Option(help="How many.")] = 100,
    seed: Annotated[int, typer.Option(help="Of the first one.")] = 0,
    fidelity: Annotated[str, typer.Option(help="exact, fast or kinematic.")] = "exact",
    out: Annotated[Path | None, results_in("out/data")] = None,
) -> None:
    """Record episodes as a Minari data set for imitation.

    For example `hurcules record Drive-v0 --episodes 100`
    """
    from hurcules_envs import recording

    name, author = _full(environment), "expert"
    act: Any = _expert
    if policy != "expert":
        model, _ = _training().load_policy(Path(policy))
        act, author = (lambda _, seen: model.predict(seen, deterministic=True)[0]), "policy"
    with Progress() as bar:
        task = bar.add_task(f"{author} in {name}", total=episodes)
        folder = out or Path("out", "data")
        identifier = recording.record(
            name, act, episodes, folder, seed=seed, author=author, fidelity=fidelity,
            progress=lambda done: bar.update(task, completed=done),
        )  # fmt: skip
    Console().print(f"{identifier} in {folder}")


def _expert(env: Any, seen: Any) -> Any:
    if not hasattr(env.environment, "expert"):
        raise hurcules.Error(f"{env.spec.id} has no expert: give --policy FOLDER")
    return env.environment.expert(env.numbers)[0]


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
