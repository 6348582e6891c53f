"""The commands `hurcules train`, `evaluate` and `record`."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import asdict
from functools import partial
from hashlib import sha256
from itertools import chain, count
from pathlib import Path
from typing import Annotated, Any

import gymnasium
import typer
from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn, TimeRemainingColumn

import hurcules
from hurcules.cli import results_in
from hurcules.interrupts import as_ctrl_c
from hurcules.output import Output
from hurcules.plugins import PolicyOptions
from hurcules.validation import require_known
from hurcules_envs import evaluation
from hurcules_envs.endings import Ending
from hurcules_envs.imitation import ask_expert
from hurcules_envs.policy import Policy
from hurcules_envs.randomisation import NAMES
from hurcules_envs.registry import fidelities_of, full_id, spec_of
from hurcules_envs.run_folder import ALGORITHMS
from hurcules_envs.running import environment_of, run_policy, settings_of

__all__ = ["evaluate", "record", "train"]

ENVIRONMENT = "Reach-v0, Drive-v0, ... or module:Own/Name-v0."

Fidelity = Annotated[
    str | None,
    typer.Option(help="exact, fast or kinematic.", show_default="the fastest that there is"),
]
Robot = Annotated[str | None, typer.Option(help="rescue, manipulation or a path.")]
Frame = Annotated[
    list[str] | None, typer.Option(help="Of a hand, where --robot is a path; twice for two.")
]
Rate = Annotated[
    float | None,
    typer.Option(help="Of the policy [Hz].", show_default="the environment's", min=1.0),
]
Vary = Annotated[
    list[str] | None,
    typer.Option(help="What differs between episodes: friction=0.6,1.2; several times."),
]
Set = Annotated[
    list[str] | None,
    typer.Option("--set", help="Another option of it: terrain=stairs; several times."),
]


def train(
    environment: Annotated[str, typer.Argument(help=ENVIRONMENT)],
    algo: Annotated[str, typer.Option(help="ppo, sac or her.")] = "ppo",
    steps: Annotated[int, typer.Option(help="Of all episodes together.", min=0)] = 100_000,
    envs: Annotated[int, typer.Option(help="Episodes side by side.", min=1)] = 16,
    seed: Annotated[int, typer.Option(help="Of networks and episodes.", min=0)] = 0,
    fidelity: Fidelity = None,
    robot: Robot = None,
    frame: Frame = None,
    action: Annotated[str | None, typer.Option(help="twist, delta, pose or joint.")] = None,
    sparse: Annotated[bool, typer.Option("--sparse", help="No shaped reward.")] = False,
    rate: Rate = None,
    vary: Vary = None,
    settings: Set = None,
    demonstrations: Annotated[
        int, typer.Option(help="Episodes of the scripted expert; PPO starts as its clone.", min=0)
    ] = 0,
    out: Annotated[Path | None, results_in("out/train/ENVIRONMENT")] = None,
    ray: Annotated[
        str | None,
        typer.Option(help="Address of a Ray cluster, auto, or local: PPO by RLlib."),
    ] = None,
    judge: Annotated[int, typer.Option(help="Episodes of the evaluation, in exact.", min=1)] = 100,
    video: Annotated[bool, typer.Option(help="Film an episode of the evaluation.")] = True,
) -> None:
    """Train a policy that commands a robot in task space, then judge it in the full physics.

    Goes on where an earlier run in the same folder was stopped. Writes policy.onnx, policy.zip,
    checkpoint.zip, settings.json, evaluation.json, and in episode a film with its figures.

    For example `hurcules train Reach-v0 --fidelity kinematic --steps 80000`, or
    `hurcules train Door-v0 --demonstrations 50 --steps 20000`
    """
    name = _known(environment)
    if steps == 0 and not demonstrations:
        raise hurcules.Error("--steps: wanted 1 or more, or --demonstrations to clone; got 0")
    fastest = next(reversed(fidelities_of(name)), None)
    options = _given(
        fidelity=fidelity or fastest, robot=robot, frames=frame or None, action=action,
        sparse=sparse or None, rate=rate, **_ranges(vary),
    ) | settings_of(settings)  # fmt: skip
    folder = out or Path("out", "train", name.split("/")[-1])
    if ray is not None:
        if demonstrations:
            raise hurcules.Error("--demonstrations: not with --ray")
        if algo != "ppo":
            raise hurcules.Error(f"--ray: wanted --algo ppo, got {algo}")
        _on_cluster(ray, name, steps, folder, options, envs, seed)
        _show(folder, judge, video, Console())
        return
    # told before PyTorch is loaded, which takes seconds
    require_known("algorithm", algo, ALGORITHMS)
    gymnasium.make(name, **options).close()
    with _told():
        from hurcules_envs import training
    wanted = training.TrainOptions(
        environment=name, algorithm=algo, steps=steps, episodes=envs, seed=seed, options=options,
        out=folder, demonstrations=demonstrations,
    )  # fmt: skip
    console = Console()
    columns = [
        TextColumn("{task.description}"), BarColumn(), TextColumn("{task.completed:,} steps"),
        TextColumn("success {task.fields[success]:.0%} exploring"), TimeElapsedColumn(),
        TimeRemainingColumn(),
    ]  # fmt: skip
    bar = Progress(*columns, console=console)
    task = bar.add_task(f"{algo} on {name.split('/')[-1]}", total=steps, success=0.0)
    with _shown_late(bar) as update:
        try:
            training.train(wanted, lambda n, share: update(completed=n, success=share))
        except KeyboardInterrupt:
            if (folder / "checkpoint.zip").exists():
                console.print(f"{folder}: the same command goes on from here")
            raise
    if steps and not bar.tasks[task].completed:
        console.print(f"{folder}: its {steps:,} steps were done already", soft_wrap=True)
    _show(folder, judge, video, console)


def _show(folder: Path, judge: int, video: bool, console: Console) -> None:
    """How what was trained does in the full physics, and a film of the first episode of these."""
    _judge(str(folder), None, judge, {"fidelity": "exact"}, None, console)
    if video:
        first = PolicyOptions(
            str(folder), seed=evaluation.SEED, out=folder / "episode", replaces=True
        )
        run_policy(first, console)


def _on_cluster(
    address: str, name: str, steps: int, folder: Path, options: dict[str, Any], envs: int, seed: int
) -> None:
    with _told():
        from hurcules_envs import rllib
    console = Console()

    def tell(done: int, mean: float) -> None:
        words = "no episode is over yet" if math.isnan(mean) else f"mean return {mean:.2f}"
        console.print(f"{done:>9,} steps   {words}")

    try:
        rllib.train(
            name, address, steps, folder, options, episodes=envs, seed=seed, progress=tell
        )  # fmt: skip
    except KeyboardInterrupt:
        if (folder / "rllib").exists():
            console.print(f"{folder}: the same command goes on from here")
        raise


def evaluate(
    policy: Annotated[
        str, typer.Argument(help="An ONNX file, a folder that train wrote, or Reach-v0.")
    ],
    environment: Annotated[
        str | None, typer.Argument(help="For files that do not say it.", show_default="its own")
    ] = None,
    fidelity: Annotated[str, typer.Option(help="exact, fast or kinematic.")] = "exact",
    robot: Robot = None,
    frame: Frame = None,
    camera: Annotated[
        list[str] | None, typer.Option(help="Whose pictures the policy sees; several times.")
    ] = None,
    rate: Rate = None,
    vary: Vary = None,
    settings: Set = None,
    episodes: Annotated[int, typer.Option(help="How many.", min=1)] = 100,
    out: Annotated[Path | None, results_in("the folder of the policy, or out/ENVIRONMENT")] = None,
) -> None:
    """Judge a policy: success with its 95 % interval, endings, return, cost, falls, self-contact.

    Runs without PyTorch. Writes evaluation.json, beside that of other settings evaluation-2.json.

    For example `hurcules evaluate out/train/Reach-v0 --robot manipulation`, or
    `hurcules evaluate Drive-v0`
    """
    chosen = _given(
        fidelity=fidelity, robot=robot, frames=frame or None, cameras=camera or None, rate=rate,
        **_ranges(vary),
    ) | settings_of(settings)  # fmt: skip
    _judge(policy, environment, episodes, chosen, out, Console())


def record(
    environment: Annotated[str, typer.Argument(help=ENVIRONMENT)],
    policy: Annotated[
        str, typer.Option(help="expert, an ONNX file, a folder, or Reach-v0.")
    ] = "expert",
    episodes: Annotated[int, typer.Option(help="How many.", min=1)] = 100,
    seed: Annotated[int, typer.Option(help="Of the first one.", min=0)] = 0,
    fidelity: Annotated[
        str | None, typer.Option(help="exact, fast or kinematic.", show_default="exact")
    ] = None,
    robot: Robot = None,
    frame: Frame = None,
    camera: Annotated[
        list[str] | None, typer.Option(help="Whose pictures are recorded too; several times.")
    ] = None,
    rate: Rate = None,
    vary: Vary = None,
    settings: Set = None,
    form: Annotated[str, typer.Option("--format", help="minari, robomimic or lerobot.")] = "minari",
    author: Annotated[
        str | None, typer.Option(help="In the data set's name.", show_default="expert or policy")
    ] = None,
    out: Annotated[Path | None, results_in("out/data")] = None,
) -> None:
    """Record episodes as a data set for imitation, of Minari, robomimic or LeRobot.

    A recording that was stopped goes on where it was.

    For example `hurcules record Drive-v0 --episodes 100 --format robomimic`
    """
    from hurcules_envs import recording

    name, kind, source = _known(environment), "expert", ""
    options = _given(
        fidelity=fidelity or ("exact" if fidelities_of(name) else None), cameras=camera or None,
        robot=robot, frames=frame or None, rate=rate, **_ranges(vary),
    ) | settings_of(settings)  # fmt: skip
    act: Any = _expert
    check: Any = _require_expert
    if policy == "operator":
        raise hurcules.Error(
            "--policy: no operator sits here; who records a person gives a function that reads a "
            "stick or keys to hurcules_envs.recording.record, "
            "see docs/environments.md#recorded-by-a-person"
        )
    if policy != "expert":
        network, kind = Policy(policy), "policy"
        source = sha256(network.path.read_bytes()).hexdigest()
        _, options = environment_of(network, name, **options)
        act, check = lambda _, seen: network.one(seen), partial(_require_fit, network)
    said = ""
    bar = Progress()
    bar.add_task(f"{kind} in {name}", total=episodes)

    def show(done: int, succeeded: int) -> None:
        nonlocal said
        said = f"{succeeded} of {done} episodes succeeded"
        update(completed=done)

    with _shown_late(bar) as update, as_ctrl_c():
        folder = out or Path("out", "data")
        try:
            identifier = recording.record(
                name, act, episodes, folder, seed=seed, author=author or kind, source=source,
                form=form, check=check, **options, progress=show,
            )  # fmt: skip
        except KeyboardInterrupt as stopped:
            bar.console.print(*getattr(stopped, "__notes__", ()))
            raise
    Console().print(said)
    Console().print(f"{identifier} in {folder}" if form == "minari" else identifier)


def _expert(env: Any, seen: Any) -> Any:
    if hasattr(env, "operator_action"):  # of a mission
        return env.operator_action()
    try:
        return ask_expert(env.spec.id, env, (1, *env.action_space.shape))[0]
    except hurcules.Error as error:
        raise hurcules.Error(f"{error}: give --policy FOLDER") from None


def _require_expert(env: Any) -> None:
    """An expert for the action of this environment."""
    _expert(env, env.reset(seed=0)[0])


def _require_fit(policy: Policy, env: Any) -> None:
    policy.check(env.spec.id, env.observation_space, env.action_space)


def _judge(
    source: str,
    environment: str | None,
    episodes: int,
    chosen: dict[str, Any],
    out: Path | None,
    console: Console,
) -> None:
    policy = Policy(source)
    name, options = environment_of(policy, environment, **chosen)
    beside = Path(source) if Path(source).is_dir() else Path("out", name.split("/")[-1])
    output = Output(out or beside, ())
    try:
        with as_ctrl_c():
            result = evaluation.evaluate(policy, name, episodes, **options)
    except KeyboardInterrupt:
        console.print("no figures: episodes run side by side, and not all of them were over")
        raise
    judged = {"environment": name, "options": options}
    output.write_json(_free(output.folder, judged), asdict(result) | judged)
    words = ", ".join(f"{key} {value}" for key, value in options.items())
    console.print(f"{name} ({words}), {episodes} episodes")
    console.print(f"  success        {result.success:.0%} ({result.low:.0%} to {result.high:.0%})")
    counted = ", ".join(f"{n} {Ending[name].text}" for name, n in result.endings.items())
    console.print(f"  endings        {counted}")
    console.print(f"  return         {result.mean_return:.2f}, mean")
    console.print(f"  cost           {result.mean_cost:.2f}, mean")
    console.print(f"  steps          {result.mean_length:.0f}, mean")
    console.print(f"  falls          {result.falls:.0%}")
    console.print(f"  over a limit   {1e3 * result.limit_excess:.1f} mrad at most, measured")
    console.print(f"  self-contact   {result.self_contacts:.2%} of the steps")
    console.print(f"  {output.saved[0]}")


def _free(folder: Path, judged: dict[str, Any]) -> str:
    """The name of an evaluation that takes no other one's place, that of the training say."""

    def is_free(name: str) -> bool:
        try:
            there = json.loads((folder / name).read_text())
        except (OSError, ValueError):
            return True
        return all(there.get(key) == value for key, value in judged.items())

    names = chain(["evaluation.json"], (f"evaluation-{i}.json" for i in count(2)))
    return next(filter(is_free, names))


def _known(environment: str) -> str:
    """The id of an environment that exists."""
    name = full_id(environment)
    spec_of(name)
    return name


@contextmanager
def _shown_late(bar: Progress) -> Iterator[Callable[..., None]]:
    """Updates the task of a bar, which is shown at the first: what was asked is right then."""
    with ExitStack() as shown:

        def update(**told: Any) -> None:
            if not bar.live.is_started:
                shown.enter_context(bar)
            bar.update(bar.task_ids[0], **told)

        yield update


@contextmanager
def _told() -> Iterator[None]:
    """Around what wants packages that not everybody has: who lacks one is told how to get it."""
    try:
        yield
    except ImportError as error:
        raise hurcules.Error(str(error)) from error


def _given(**options: Any) -> dict[str, Any]:
    return {name: value for name, value in options.items() if value is not None}


def _ranges(given: list[str] | None) -> dict[str, list[float]]:
    """Ranges by name of NAME=NUMBER or NAME=LEAST,MOST; `randomisation` judges the numbers."""
    ranges = {}
    for one in given or []:
        name, _, numbers = one.partition("=")
        require_known("--vary", name, NAMES)
        try:
            ends = [float(number) for number in numbers.split(",")]
            low, high = ends * 2 if len(ends) == 1 else ends
        except ValueError:
            raise hurcules.Error(f"--vary: wanted {name}=LEAST,MOST, got {one!r}") from None
        ranges[name] = [low, high]
    return ranges
