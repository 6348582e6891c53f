"""`hurcules run --policy`: one episode of a policy, with film and plain figures."""

from __future__ import annotations

import json
import shlex
from collections.abc import Sequence
from inspect import signature
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
from rich.console import Console
from rich.table import Table

import hurcules
from hurcules import extras
from hurcules.interrupts import Interrupts
from hurcules.output import Output, void
from hurcules.plugins import PolicyOptions
from hurcules.rendering import RendererError
from hurcules.run import DONE, FAILED, INTERRUPTED, open_output, progress_bar
from hurcules.video import encode
from hurcules_envs.endings import Ending
from hurcules_envs.evaluation import evaluate
from hurcules_envs.policy import Policy
from hurcules_envs.recording import record
from hurcules_envs.registry import fidelities_of, full_id, native_options, steps_of_episode

__all__ = ["environment_of", "run_policy", "settings_of"]

# what `evaluate` and `record` take beside the options of an environment
TOLD = {*signature(evaluate).parameters, *signature(record).parameters} - {"options"}
FILES = ("summary.json", "episode.npz", "video.mp4")
# of info: what the table shows, its unit, what it is multiplied by, the worst of an episode
FIGURES = (
    ("limit_excess", "over a joint limit, physics", "mrad", 1e3, np.max),
    ("commanded_excess", "over a joint limit, commanded", "mrad", 1e3, np.max),
    ("self_contacts", "self-contacts at once", "", 1.0, np.max),
    ("self_distance", "nearest parts of the robot", "m", 1.0, np.min),
    ("support_margin", "smallest support margin", "m", 1.0, np.min),
)

PHYSICAL = ("limit_excess", "support_margin")


def environment_of(
    policy: Policy, given: str | None, /, **others: Any
) -> tuple[str, dict[str, Any]]:
    """Id and options of the environment that a policy acts in.

    Args:
        policy: what acts.
        given: id that was asked for; None: that of the policy.
        others: options in place of the policy's; with another robot go the frames of the policy's.

    Raises:
        hurcules.Error: neither says which, the two differ, or there is no such environment.
    """
    name = full_id(given) if given else policy.environment
    if not name:
        raise hurcules.Error(f"{policy.path} does not say its environment: name one, Reach-v0 say")
    known = fidelities_of(name)
    if policy.environment and name != policy.environment:
        raise hurcules.Error(
            f"{policy.path}: wanted a policy of {name}, got one of {policy.environment}"
        )
    if not known and others.get("fidelity") == "exact":  # there is no other
        del others["fidelity"]
    own = {
        option: value
        for option, value in policy.options.items()
        if "robot" not in others or option not in ("frames", "joints")
    }
    return name, own | others


def settings_of(given: Sequence[str] | None) -> dict[str, Any]:
    """Options of an environment by name, of NAME=VALUE: a value is JSON, or else a text.

    Raises:
        hurcules.Error: one has no name or no value, or names what is told to a command, not to an
            environment, which judges the rest.
    """
    settings: dict[str, Any] = {}
    for one in given or ():
        name, is_set, value = one.partition("=")
        if not (name.isidentifier() and is_set):
            raise hurcules.Error(f"--set: wanted NAME=VALUE, terrain=stairs say, got {one!r}")
        if name in TOLD:
            raise hurcules.Error(f"--set: '{name}' is no option of an environment")
        try:
            settings[name] = json.loads(value)
        except ValueError:
            settings[name] = value
    return settings


def run_policy(options: PolicyOptions, console: Console) -> int:
    """Runs an episode and writes summary.json, episode.npz and, where it can be drawn, video.mp4.

    Ctrl-C ends the episode; what was recorded is saved all the same.

    Args:
        options: which policy, where.
        console: progress and results go here.

    Returns:
        The exit code: DONE after a success, FAILED, or INTERRUPTED.

    Raises:
        hurcules.Error: there is no such policy, it does not fit the environment, that has no
            native vector, or a folder that was asked for holds another run.
        hurcules.output.WriteError: a file could not be written.
    """
    policy = Policy(options.policy)
    given: dict[str, Any] = {"fidelity": options.fidelity}
    given |= {"robot": options.robot} if options.robot else {}
    given |= {"frames": options.frames} if options.frames else {}
    given |= settings_of(options.settings)
    name, settings = environment_of(policy, options.environment, **given)
    native_options(name, settings)
    lost = extras.without() if options.video else "not asked for (--no-video)"
    steps = steps_of_episode(name, settings)
    mode = None if lost else "rgb_array"
    env = gymnasium.make(name, max_episode_steps=steps, render_mode=mode, **settings)
    policy.check(name, env.observation_space, env.action_space)
    told = {
        "environment": name, "options": settings, "seed": options.seed,
        "policy": str(policy.path), "video": options.video,
    }  # fmt: skip
    folder = options.out or Path("out", name.split("/")[-1])
    named = options.out is not None and not options.replaces
    output = open_output(folder, FILES, told, named, console)
    if lost and options.video:
        console.print(f"no film: {lost}", style="yellow", highlight=False, markup=False)
    with Interrupts() as interrupts:
        episode = _Episode(env, draw=not lost)
        with progress_bar(console) as bar:
            task = bar.add_task(f"run {name}", total=steps, note="")
            episode.reset(options.seed)
            while not (episode.over or interrupts.noted):
                episode.step(policy)
                bar.update(task, completed=len(episode.rewards), note=f"{episode.time:5.1f} s")
            bar.update(task, total=len(episode.rewards))
        summary = episode.summary() | {
            **told, "interrupted": interrupts.noted, "hurcules_version": hurcules.__version__,
        }  # fmt: skip
        _save(episode, summary, output)
        if episode.undrawn:
            console.print(f"no film: {episode.undrawn}", style="yellow", markup=False)
    env.close()
    _report(summary, output, console)
    console.print(
        f"one episode; how often it succeeds: {_judging(options)}", soft_wrap=True, markup=False
    )
    if interrupts.noted:
        return INTERRUPTED
    return DONE if summary["success"] else FAILED


def _judging(options: PolicyOptions) -> str:
    """The command that judges this policy in this setting."""
    words = ["hurcules", "evaluate", options.policy]
    words += [options.environment] if options.environment else []
    words += ["--fidelity", options.fidelity] if options.fidelity != "exact" else []
    words += ["--robot", options.robot] if options.robot else []
    for frame in options.frames:
        words += ["--frame", frame]
    for setting in options.settings:
        words += ["--set", setting]
    return shlex.join(words)


class _Episode:
    """What happens in an episode, kept."""

    def __init__(self, env: gymnasium.Env[Any, Any], draw: bool) -> None:
        self._env, self._draw = env, draw
        self.undrawn = ""  # why there are no pictures
        self.over, self.success, self.failed, self.time = False, False, False, 0.0
        self.ending = Ending.Running
        self.pictures: list[Any] = []
        self.states: list[Any] = []  # qpos (nq,)
        self.actions: list[Any] = []
        self.rewards: list[float] = []
        self.infos: list[dict[str, Any]] = []

    def reset(self, seed: int) -> None:
        self._seen, _ = self._env.reset(seed=seed)
        self._picture()

    def step(self, policy: Policy) -> None:
        action = policy.one(self._seen)
        self._seen, reward, terminated, truncated, info = self._env.step(action)
        self.over, self.ending = terminated or truncated, Ending.of(info, truncated)
        self.success, self.failed, self.time = info["is_success"], info["failed"], info["time"]
        self.actions.append(action)
        self.rewards.append(float(reward))
        self.infos.append(info)
        self._picture()

    def summary(self) -> dict[str, Any]:
        """Plain numbers."""
        worst = {key: float(fold([i[key] for i in self.infos])) for key, *_, fold in FIGURES}
        terms = [key for key in self.infos[0] if key.startswith("reward_")]
        reached = [i["time"] for i in self.infos if i["is_success"]]
        return {
            "success": bool(self.success), "failed": bool(self.failed), "ending": self.ending.name,
            "steps": len(self.rewards),
            "simulated_seconds": float(self.time), "success_s": min(reached, default=None),
            "return": sum(self.rewards), "cost": float(sum(info["cost"] for info in self.infos)),
            **{key: float(sum(info[key] for info in self.infos)) for key in terms}, **worst,
        }  # fmt: skip

    def _picture(self) -> None:
        env: Any = self._env.unwrapped
        self.states.append(env.qpos)
        if self._draw and not self.undrawn:
            try:
                self.pictures.append(env.render())
            except RendererError as error:
                self.undrawn = str(error)


def _save(episode: _Episode, summary: dict[str, Any], output: Output) -> None:
    output.write_json("summary.json", summary)
    arrays = {"qpos": episode.states, "actions": episode.actions, "rewards": episode.rewards}
    arrays |= {key: [info[key] for info in episode.infos] for key in episode.infos[0]}
    output.write_arrays("episode.npz", {n: np.asarray(v, float) for n, v in arrays.items()})
    if episode.pictures:
        fps = round(len(episode.rewards) / episode.time)
        output.write("video.mp4", lambda path: void(encode(path, episode.pictures, fps)))


def _report(summary: dict[str, Any], output: Output, console: Console) -> None:
    """The end in plain figures, and where everything lies."""
    table = Table(box=None, padding=(0, 3, 0, 0), show_header=False)
    table.add_column()
    table.add_column(justify="right")
    if not summary["interrupted"]:
        table.add_row("ending", Ending[summary["ending"]].text)
    if summary["success_s"] is not None:
        table.add_row("succeeded after", f"{summary['success_s']:.1f} s")
    table.add_row("return", f"{summary['return']:.2f}")
    table.add_row("cost", f"{summary['cost']:g}")
    known = summary["options"].get("fidelity") != "kinematic"  # what only the physics says
    for key, label, unit, factor, _ in FIGURES:
        if key in PHYSICAL and not known:
            continue
        table.add_row(label, f"{factor * summary[key]:.3g} {unit}".rstrip())
    ends = {"success": "success", "failed": "failed", "interrupted": "interrupted"}
    end = next((word for key, word in ends.items() if summary[key]), "no success")
    time = f"{summary['simulated_seconds']:.1f} s, {summary['steps']} steps"
    colour = "bold green" if summary["success"] else "bold"
    console.print(f"\n{end}, {time}", style=colour)
    console.print(table)
    for path in output.saved:
        console.print(f"  {path}", highlight=False, soft_wrap=True)
