"""The command `hurcules`: run a mission, reproduce claims, list what there is, and more."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.console import Console
from rich.markup import escape
from rich.table import Table
from typer.core import TyperGroup

import hurcules
from hurcules import own_simulation, plugins
from hurcules._core import Error
from hurcules.mission_table import Mission
from hurcules.outlet import outlet
from hurcules.output import WriteError, write_whole
from hurcules.plugins import MethodOptions, Methods, PolicyOptions
from hurcules.rhqp import method_names
from hurcules.run import FAILED, INTERRUPTED, RunOptions, run
from hurcules.seeds import run_seeds
from hurcules.table_missions import TABLE_MISSIONS, table_mission, write_table
from hurcules.validation import require_known

__all__ = ["main", "results_in"]

USAGE = 2  # exit code of wrong usage


class _Commands(TyperGroup):
    """A Ctrl-C is told, where typer ends by its exit code alone."""

    def make_context(self, *arguments: Any, **more: Any) -> Any:
        with _told_stop():
            return super().make_context(*arguments, **more)

    def invoke(self, *arguments: Any, **more: Any) -> Any:
        with _told_stop():
            return super().invoke(*arguments, **more)


@contextmanager
def _told_stop() -> Iterator[None]:
    try:
        yield
    except KeyboardInterrupt as stopped:
        raise typer.Abort from stopped


app = typer.Typer(
    cls=_Commands,
    add_completion=False,
    no_args_is_help=True,
    rich_markup_mode="markdown",
    help="Hurcules: a 680 kg rescue robot on tracks, simulated in MuJoCo, controlled at 1 kHz.",
)


def _version(wanted: bool) -> None:
    if wanted:
        print(hurcules.__version__)
        raise typer.Exit


def _folder(text: str) -> Path:
    if not text.strip():  # Path("") would be the folder one stands in
        raise typer.BadParameter(f"wanted the name of a folder, got {text!r}")
    return Path(text)


def results_in(default: str) -> Any:
    """The option --out."""
    return typer.Option(
        parser=_folder, metavar="<path>", help="Folder for the results.", show_default=default
    )


@app.callback()
def _options(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Show the version.")
    ] = False,
) -> None:
    """Keeps `hurcules` a command with subcommands."""


_METHODS, _POLICIES = "Test methods", "Policies"  # where their options stand in the help
_MISSION_OPTIONS = ("seconds", "method", "sensors", "variation", "seeds")
_METHOD_OPTIONS = ("robot", "repetitions", "pace", "workers")


_WITH_PARAMETERS = {"allow_extra_args": True, "ignore_unknown_options": True}


@app.command("run", context_settings=_WITH_PARAMETERS)
def run_mission(
    context: typer.Context,
    mission: Annotated[
        str,
        typer.Argument(
            help="A mission, test method or environment of `hurcules list`, a table (.toml), or a "
            "file of Python with a function `simulation`."
        ),
    ] = "stretch",
    policy: Annotated[
        str | None,
        typer.Option(help="Run an episode of this policy: an ONNX file, a folder, or Reach-v0."),
    ] = None,
    seed: Annotated[int, typer.Option(help="Random numbers: what differs between runs.")] = 0,
    out: Annotated[Path | None, results_in("out/MISSION")] = None,
    seconds: Annotated[
        float | None, typer.Option(help="Stop after this time [s].", show_default="to the end")
    ] = None,
    method: Annotated[
        str, typer.Option(help=f"Solver of the hierarchy: {', '.join(method_names())}.")
    ] = "lexicographic",
    sensors: Annotated[
        bool, typer.Option("--sensors", help="Sensors with noise, bias, delay and resolution.")
    ] = False,
    variation: Annotated[
        float, typer.Option(help="How much differs between seeds; 0: nothing.")
    ] = 1.0,
    video: Annotated[bool, typer.Option("--video/--no-video", help="Write video.mp4.")] = True,
    seeds: Annotated[
        int | None,
        typer.Option(
            help="Run so many seeds, from --seed up, without film: `runs.jsonl`, `.txt`, `.png`.",
            show_default="one run",
        ),
    ] = None,
    workers: Annotated[
        int, typer.Option(help="Processes of --seeds or a test method; they change no result.")
    ] = 1,
    robot: Annotated[
        str, typer.Option(help="Which robot is tested, or acts.", rich_help_panel=_METHODS)
    ] = "rescue",
    repetitions: Annotated[
        int, typer.Option(help="Repetitions at each setting.", rich_help_panel=_METHODS)
    ] = 10,
    pace: Annotated[
        float | None,
        typer.Option(
            help="Driving speed [m/s].", rich_help_panel=_METHODS, show_default="the method's own"
        ),
    ] = None,
    fidelity: Annotated[
        str,
        typer.Option(help="Of a policy: exact, fast or kinematic.", rich_help_panel=_POLICIES),
    ] = "exact",
    frame: Annotated[
        list[str] | None,
        typer.Option(
            help="Of a hand, where --robot is a file; twice for two.", rich_help_panel=_POLICIES
        ),
    ] = None,
    settings: Annotated[
        list[str] | None,
        typer.Option(
            "--set",
            help="Another option of the policy's environment: terrain=stairs; several times.",
            rich_help_panel=_POLICIES,
        ),
    ] = None,
) -> None:
    """Simulate a mission; write `summary.json`, `report.html`, `video.mp4` and `log.npz`.

    A test method tries harder and harder settings until one fails. Its parameter's name selects
    settings instead, and other parameters of its scene may follow (degrees, m). A policy acts for
    one episode of its environment; `hurcules evaluate` tells how often it succeeds.

    A folder of --out that holds another run is refused; the usual one holds the last run.

    Exit status: 0 done, 1 the mission failed (`summary.json` says why), with --seeds one of them,
    2 wrong usage, 130 Ctrl-C.

    For example `hurcules run`, or with more words:

    - `hurcules run stretch --seed 7 --out /tmp/seven`

    - `hurcules run stretch --seconds 5 --no-video`

    - `hurcules run --sensors`

    - `hurcules run casualty --mass 120`

    - `hurcules run crossing --terrain road --rise 0.1 --ground 7`

    - `hurcules run lift --mass 90 --offset 0.05,-0.1 --yaw 0.2 --friction 0.6 --pose back`

    - `hurcules run disposal --mass 20 --offset 0.05,-0.1 --yaw 0.2 --friction 0.8`

    - `hurcules mission lift --out my.toml`, then, changed, `hurcules run my.toml --mass 90`

    - `hurcules run my_robot.py --seed 3`: the simulation that its function `simulation` returns

    - `hurcules run lift --seeds 20 --workers 2`: the same again goes on where it was cut off

    - `hurcules run e2803 --angle 30 --repetitions 10 --workers 4`

    - `hurcules run --policy Drive-v0 --seed 3`
    """
    _require_no_option(mission)
    if policy is not None:
        _refuse(context, ("seeds",), "not with --policy; `hurcules evaluate` judges many episodes")
        _refuse(context, (*_MISSION_OPTIONS, *_METHOD_OPTIONS[1:]), "not with --policy")
        if context.args:
            raise Error(f"unexpected argument: {context.args[0]}")
        if seed < 0:
            raise Error(f"--seed: wanted 0 or more, got {seed}")
        environment = mission if _was_given(context, "mission") else None
        other = robot if _was_given(context, "robot") else None
        wanted = PolicyOptions(
            policy, environment, fidelity, other, frame or (), seed, out, video, settings or ()
        )
        raise typer.Exit(_policy_runner()(wanted, Console()))
    _refuse(context, ("fidelity", "frame", "settings"), "for policies")
    if methods := _methods(mission):
        _refuse(context, _MISSION_OPTIONS, f"for missions; '{mission}' is a test method")
        words = tuple(context.args)
        asked = MethodOptions(mission, words, robot, repetitions, seed, pace, workers, out, video)
        raise typer.Exit(methods.run(asked, Console()))
    titles = [name for methods in plugins.method_groups() for name in methods.titles()]
    if any(one == mission or one.endswith(f"/{mission}") for one in plugins.environments()):
        raise Error(f"{mission} is an environment, which wants --policy")
    if own_simulation.is_own(mission):
        own = ("method", "sensors", "variation")
        _refuse(context, own, f"for missions by name; {mission} has its own")
    elif table_mission(mission) is None:
        require_known("mission or test method", mission, [*hurcules.missions(), *titles])
    _refuse(context, _METHOD_OPTIONS[:-1], f"for test methods; '{mission}' is a mission")
    parameters = _parameters(mission, context.args)
    options = RunOptions(mission, seed, out, seconds, method, video, sensors, parameters, variation)
    if seeds is None:
        _refuse(context, ("workers",), "for test methods and --seeds")
        raise typer.Exit(run(options, Console()))
    if video and _was_given(context, "video"):
        raise Error("--video: of one run, not with --seeds; --seed says which, without --seeds")
    raise typer.Exit(run_seeds(options, seeds, workers, Console()))


def _parameters(mission: str, words: Sequence[str]) -> dict[str, Any]:
    """What the words that are left say of a mission."""
    if own_simulation.is_own(mission):
        return own_simulation.parameters_of(mission, words)
    rows = table_mission(mission)
    parameters = rows.parameters_of(words) if rows else {}
    if words and not parameters:
        kind = "no such option" if words[0].startswith("-") else "unexpected argument"
        raise Error(f"{kind}: {words[0]}; '{mission}' has no options of its own")
    return parameters


def _require_no_option(name: str) -> None:
    if name.startswith("-"):  # the first unknown option took the name's place
        raise Error(
            f"no such option: {name.partition('=')[0]} (a mission's or method's follow its name)"
        )


def _policy_runner() -> Callable[[PolicyOptions, Console], int]:
    runner = plugins.policy_runner()
    if runner is None:
        raise Error("--policy: no package that runs policies is installed (hurcules_envs does)")
    return runner


def _methods(name: str) -> Methods | None:
    """Whoever knows the test method of this name."""
    return next((one for one in plugins.method_groups() if name in one.titles()), None)


def _refuse(context: typer.Context, names: Sequence[str], why: str) -> None:
    for name in names:
        if _was_given(context, name):
            option = next(one for one in context.command.params if one.name == name)
            raise Error(f"{max(option.opts, key=len)}: {why}")


def _was_given(context: typer.Context, name: str) -> bool:
    source = context.get_parameter_source(name)
    return source is not None and source.name == "COMMANDLINE"


def _plain_table() -> Table:
    """Columns without lines; what is too long goes on below, whole."""
    table = Table(box=None, show_header=False, padding=(0, 3, 0, 0))
    for _ in range(3):
        table.add_column(overflow="fold")
    return table


@app.command("list")
def list_all() -> None:
    """List missions, test methods, scenes, models and environments.

    For example `hurcules list`.
    """
    rows = {
        "missions": hurcules.missions(),
        **{
            methods.kind: [f"{name} ({title})" for name, title in methods.titles().items()]
            for methods in plugins.method_groups()
        },
        "scenes": hurcules.models.scenes(),
        "models": hurcules.models.names(),
        "environments": plugins.environments(),
    }
    table = _plain_table()
    for kind, names in rows.items():
        table.add_row(f"[bold]{kind}", "\n".join(names))
    Console().print(table)


@app.command("mission", context_settings=_WITH_PARAMETERS)
def show_mission(
    context: typer.Context,
    name: Annotated[
        str, typer.Argument(help="A mission of `hurcules list` that is a table, or a TOML file.")
    ] = "casualty",
    out: Annotated[
        Path | None,
        typer.Option(
            help="File to write: `.svg`, a drawing; `.toml`, to load from; `.txt`, as printed; "
            "`.table`, what `hurcules-sim` runs, and its model beside it.",
            show_default="print it",
        ),
    ] = None,
) -> None:
    """Print the table of a mission, or write it to a file.

    With `.table` the options of the mission may follow, as in `hurcules run`.

    For example `hurcules mission`, or:

    - `hurcules mission disposal --out disposal.svg`

    - `hurcules mission my_mission.toml`, for `hurcules run my_mission.toml`

    - `hurcules mission lift --mass 90 --out lift.table`, then `hurcules-sim lift.table --seed 3`
    """
    _require_no_option(name)
    if name.endswith(".toml"):
        table = Mission.load(name)
    else:
        require_known("table of a mission", name, list(TABLE_MISSIONS))
        table = TABLE_MISSIONS[name].table()
    texts = {".svg": table.drawing, ".toml": table.toml, ".txt": table.table}
    if out is not None:
        require_known("kind of file", out.suffix, [*texts, ".table"])
        if out.suffix == ".table" and (mission := table_mission(name)):
            write_table(name, mission, mission.parameters_of(context.args), out)
            print(out)
            return
    if context.args:
        table_file = Path(name).with_suffix(".table").name
        raise Error(
            f"{context.args[0]}: of the scene, which --out {table_file} writes with the phases; "
            "what is printed, and other files, hold the phases alone"
        )
    if out is None:
        print(table.table(), end="")
        return
    write_whole(out, texts[out.suffix]().encode())
    print(out)


@app.command("view", context_settings=_WITH_PARAMETERS)
def view_model(
    context: typer.Context,
    name: Annotated[
        str, typer.Argument(help="A mission, model or scene of `hurcules list`, or an MJCF file.")
    ] = "stretch",
    seed: Annotated[int, typer.Option(help="Random numbers of a mission.")] = 0,
    seconds: Annotated[
        float | None, typer.Option(help="Close the window after this time [s].", min=0.0)
    ] = None,
) -> None:
    """Show a mission, model or scene in MuJoCo's viewer, in real time.

    The options of a mission may follow, as in `hurcules run`.

    Exit status: 0 when the window was closed, 2 wrong usage or no display.

    For example `hurcules view`, or with more words:

    - `hurcules view casualty --mass 90`

    - `hurcules view rescue`

    - `hurcules view my_robot.xml`

    - `hurcules view my_robot.py`, as for `hurcules run`
    """
    from hurcules.view import view

    _require_no_option(name)
    view(name, seed, seconds, _parameters(name, context.args))


@app.command("export")
def export_model(
    name: Annotated[str, typer.Argument(help="A model of `hurcules list`.")] = "rescue",
    scene: Annotated[str, typer.Option(help="A scene of `hurcules list`.")] = "flat",
    out: Annotated[
        Path | None,
        typer.Option(
            help="File to write; meshes go to the folder `assets` beside it.",
            show_default="out/NAME.xml",
        ),
    ] = None,
    actuators: Annotated[
        str, typer.Option(help="`motor`, torques; `position`, servos that hold the robot up.")
    ] = "motor",
    mjx: Annotated[bool, typer.Option("--mjx", help="Leave out what MJX does not take.")] = False,
) -> None:
    """Write a robot in a scene as one MJCF file, for other programs.

    With `--actuators position` it stands in any viewer. Such programs know nothing of our tracks:
    the belts have no traction there.

    For example `hurcules export rescue --actuators position`, or:

    - `hurcules export manipulation --scene stairs --out /tmp/stairs.xml`

    - `hurcules export rescue --mjx --actuators position`
    """
    from hurcules.export import export

    print(export(out or Path("out", f"{name}.xml"), name, scene, actuators=actuators, mjx=mjx))


@app.command("doctor")
def doctor() -> None:
    """Say what this machine has and lacks, with the remedy.

    Exit status 1 when something is broken, 0 when at most something optional is missing.

    For example `hurcules doctor`.
    """
    from hurcules.doctor import examine

    console = Console()
    colours = {"ok": "green", "lacks": "yellow", "broken": "red"}
    findings = examine()
    table = _plain_table()
    for finding in findings:
        detail = escape(finding.detail)
        detail += escape(f"\nremedy: {finding.remedy}") if finding.remedy else ""
        mark = f"[{colours[finding.status]}]{finding.status}"
        table.add_row(f"[bold]{finding.what}", mark, detail)
    console.print(table)
    raise typer.Exit(FAILED if any(f.status == "broken" for f in findings) else 0)


def _complete() -> typer.Typer:
    """The commands, with those that other packages add."""
    known = {command.name for command in app.registered_commands}
    for name, function in plugins.commands().items():
        if name not in known:
            app.command(name)(function)
    return app


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs the command line; every failure is one line.

    Args:
        arguments: without the program's name; by default those of this process.

    Returns:
        The exit code.
    """
    with outlet() as said:
        code = _call(arguments)
        said.flush()
    return _complain(said.lost, code or FAILED) if said.lost else code


def _call(arguments: Sequence[str] | None) -> int:
    try:
        return _complete()(arguments, standalone_mode=False) or 0
    except typer.TyperException as error:
        return _complain(
            _with_value(error, sys.argv[1:] if arguments is None else arguments), USAGE
        )
    except WriteError as error:
        return _complain(str(error), FAILED)
    except Error as error:
        return _complain(str(error), USAGE)
    except (KeyboardInterrupt, typer.Abort):
        return _complain("interrupted", INTERRUPTED)


def _with_value(error: typer.TyperException, words: Sequence[str]) -> str:
    """What typer says, and the value that came, or what there is, where it does not say that."""
    text = error.format_message()
    if text.startswith("No such command"):
        names = ", ".join(str(command.name) for command in app.registered_commands)
        return f"{text.rstrip('.')}; there are: {names}"
    options = getattr(getattr(error, "param", None), "opts", [])
    if isinstance(error, typer.BadParameter) and "got" not in text:
        for option, value in zip(words, [*words[1:], ""], strict=True):
            name, _, inside = option.partition("=")
            if name in options:
                return f"{text}, got {inside or value!r}"
    return text


def _complain(text: str, code: int) -> int:
    if text:  # without arguments there is the help, and no complaint
        print(f"hurcules: error: {' '.join(text.split())}", file=sys.stderr)
    return code
