"""Does the commanded velocity jump? Arms of six joints on paths through singularities, by default.

Run:  python benchmarks/jumps.py [--dt 0.001 0.002 0.005] [--seeds 3] [--only wrist] [--out FILE]

The stack is `limits < hand < posture`, eight seconds along five paths:

elbow   the place goes out of reach and comes back inside, through the stretched elbow
wrist   the orientation passes the aligned wrist, exactly or 1 or 10 mrad beside it, place kept
base    the place passes over the axis of the base, exactly or 1 or 10 mm beside it
limit   the pose wants a joint 0.3 rad beyond its limit, again and again
rows    the hand's level gains the orientation and loses it, every half second, by `set_stack`

Lengths of the arm, speed of the path and posture are drawn. `change` is the largest change of a
joint's velocity in one tick over what `max_acceleration` allows; `at the limit` the share of ticks
that take more than 0.999 of it. `law alone` is the largest change [rad/s] in one tick with a
hundredfold `max_acceleration`: it goes down with dt where the law itself does not jump. `sigma` is
the smallest singular value of the hand's Jacobian on the way, `switches` how often a joint came
to its limit or left it, both as a check that the path goes where it says.
"""

from __future__ import annotations

import argparse
import json
from pathlib import Path

import mujoco
import numpy as np

import hurcules
from hurcules import JointLimits, OrientationTask, PositionTask, PostureTask, Stack, StackLevel

ARM = """
<mujoco>
  <compiler angle="radian"/>
  <default><geom type="capsule" size="0.03" contype="0" conaffinity="0"/></default>
  <worldbody>
    <body>
      <joint name="j1" axis="0 0 1" range="-6 6"/>
      <geom fromto="0 0 0 0 0 {foot}"/>
      <body name="shoulder" pos="0 0 {foot}">
        <joint name="j2" axis="0 1 0" range="-2.5 2.5"/>
        <geom fromto="0 0 0 0 0 {upper}"/>
        <body pos="0 0 {upper}">
          <joint name="j3" axis="0 1 0" range="-2.8 2.8"/>
          <geom fromto="0 0 0 0 0 {fore}"/>
          <body name="wrist" pos="0 0 {fore}">
            <joint name="j4" axis="0 0 1" range="-6 6"/>
            <geom size="0.02" fromto="0 0 0 0 0 0.02"/>
            <body>
              <joint name="j5" axis="0 1 0" range="-2 2"/>
              <geom size="0.02" fromto="0 0 0 0 0 0.05"/>
              <body>
                <joint name="j6" axis="0 0 1" range="-6 6"/>
                <geom size="0.02" fromto="0 0 0.05 0 0 0.1"/>
                <site name="hand" pos="0 0 0.1"/>
              </body>
            </body>
          </body>
        </body>
      </body>
    </body>
  </worldbody>
</mujoco>
"""
PATHS = ("elbow", "wrist", "base", "limit", "rows")
SPATIAL = ("wrist", "limit", "rows")  # whose hand is led in 6-D
BESIDE = (0.0, 1e-3, 1e-2)  # [m] or [rad], how near a path comes
SECONDS, AMPLE, BEYOND = 8.0, 100.0, 0.3  # [s], times the limit, [rad]


def turn(axis: int, angle: float) -> np.ndarray:
    """R (3, 3) about a coordinate axis."""
    c, s = np.cos(angle), np.sin(angle)
    i, j = (axis + 1) % 3, (axis + 2) % 3
    R = np.eye(3)
    R[i, i] = R[j, j] = c
    R[i, j], R[j, i] = -s, s
    return R


class Way:
    """Where the hand shall be at a time.

    Args:
        name: one of PATHS.
        seed: of the arm, the posture and the speed.
    """

    def __init__(self, name: str, seed: int) -> None:
        rng = np.random.default_rng(seed)
        lengths = dict(zip(("foot", "upper", "fore"), rng.uniform(0.3, 0.5, 3), strict=True))
        text = ARM.format(**lengths)
        self.model, free = (mujoco.MjModel.from_xml_string(text) for _ in range(2))
        self.name, self.beside = name, BESIDE[seed % len(BESIDE)]
        self.rate = 2.0 * np.pi / rng.uniform(4.0, 8.0)  # [rad/s]
        self.twin = hurcules.Robot(free)
        bent = 0.5 if name == "base" else 1.2  # with its hand above the shoulder
        self.start = np.array([0.0, 0.4, bent, 0.3, 0.6, 0.0]) + 0.1 * rng.normal(size=6)
        if name == "base":
            self.start[4] = 0.0  # else the wrist moves across as well
        if name == "limit":
            self.model.jnt_range[1, 1] = self.start[1] + BEYOND
        self.twin.set_configuration(self.start)
        self.place = self.twin.position("hand").copy()
        self.out = self.place - self.twin.position("shoulder")
        self.reach = (lengths["upper"] + lengths["fore"] + 0.1) / np.linalg.norm(self.out)

    def at(self, time: float) -> tuple[np.ndarray, np.ndarray]:
        """Place (3,) [m] and R (3, 3) of the hand."""
        s = 0.5 * (1.0 - np.cos(self.rate * time))  # 0 to 1 and back
        q = self.start.copy()
        if self.name in ("wrist", "limit"):
            joint = 4 if self.name == "wrist" else 1
            q[joint] += s * (-2.0 * q[4] if self.name == "wrist" else 2.0 * BEYOND)
        self.twin.set_configuration(q)
        place, rotation = self.twin.position("hand").copy(), self.twin.orientation("hand").copy()
        if self.name == "wrist":
            rotation = rotation @ turn(0, self.beside * np.sin(np.pi * s))
        elif self.name == "elbow":
            place = self.place + s * (1.2 * self.reach - 1.0) * self.out
        elif self.name == "base":
            place = self.place.copy()
            place[0] *= 1.0 - 2.0 * s
            place[1] += np.sin(np.pi * s) ** 2 * (self.beside - place[1])
        elif self.name == "rows":
            place = self.place + 0.1 * s * np.array([1.0, -1.0, 0.5])
            rotation = turn(2, 0.4 * s) @ rotation
        return place, rotation


class Run:
    """The arm along a path.

    Args:
        path: where to.
        dt: [s].
        ample: a hundredfold acceleration.
        accelerations: by `AccelerationController`.
    """

    def __init__(self, path: Way, dt: float, ample: bool, accelerations: bool) -> None:
        kinds = (hurcules.VelocityControllerOptions, hurcules.AccelerationControllerOptions)
        options = kinds[accelerations](dt=dt)
        options.max_acceleration *= AMPLE if ample else 1.0
        kinds = (hurcules.VelocityController, hurcules.AccelerationController)
        self.path, self.dt, self.allowed = path, dt, options.max_acceleration * dt
        self.robot = hurcules.Robot(path.model)
        self.robot.set_configuration(path.start)
        self.controller = kinds[accelerations](self.robot, options)
        self.limits = JointLimits("limits", self.robot)
        self.hand = PositionTask("hand", self.robot, "hand")
        self.turn = OrientationTask("turn", self.robot, "hand")
        self.posture = PostureTask("posture", self.robot)
        self.changes, self.sigma, self.switches = np.zeros(round(SECONDS / dt)), np.inf, 0

    def go(self) -> dict[str, float]:
        """What came out."""
        spatial = self.path.name in SPATIAL
        self.stack(spatial)
        last, sides, every = np.zeros(6), np.zeros(6, dtype=bool), round(0.5 / self.dt)
        for tick in range(len(self.changes)):
            if self.path.name == "rows" and tick % every == every - 1:
                spatial = not spatial
                self.stack(spatial)
            place, rotation = self.path.at(tick * self.dt)
            self.hand.set_target(place)
            self.turn.set_target(rotation)
            self.controller.step(self.robot)
            now = self.controller.velocity.copy()
            q = self.robot.configuration
            active = np.minimum(q - self.limits.lower, self.limits.upper - q) < 1e-3
            self.changes[tick] = np.abs(now - last).max()
            self.switches += int((active != sides).sum())
            last, sides = now, active
            if tick % 10 == 0:
                tasks = [self.hand, self.turn] if spatial else [self.hand]
                J = np.vstack([task.jacobian for task in tasks])
                self.sigma = min(self.sigma, float(np.linalg.svd(J, compute_uv=False)[-1]))
        return {
            "change": float(self.changes.max() / self.allowed),
            "at_limit": float((self.changes > 0.999 * self.allowed).mean()),
            "jump": float(self.changes.max()),
            "sigma": self.sigma,
            "switches": self.switches,
        }

    def stack(self, spatial: bool) -> None:
        """With the orientation or without."""
        level = StackLevel("hand", [self.hand, self.turn] if spatial else [self.hand])
        self.controller.set_stack(Stack([self.limits, level, self.posture]))


def examine(name: str, seed: int, dt: float, accelerations: bool) -> dict[str, object]:
    """A row: one path of one arm."""
    path = Way(name, seed)
    row = Run(path, dt, False, accelerations).go()
    row["law"] = Run(path, dt, True, accelerations).go()["jump"]
    del row["jump"]
    form = "accelerations" if accelerations else "velocities"
    return {"path": name, "seed": seed, "dt": dt, "by": form, **row}


def main() -> None:
    """Prints the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--dt", type=float, nargs="+", default=[0.001, 0.002, 0.005], help="[s]")
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--only", default="", help="part of a path's name")
    parser.add_argument("--out", type=Path, help="a JSON file")
    options = parser.parse_args()
    every = []
    titles = ["path", "by", "dt [ms]", "change", "at the limit", "law alone", "sigma", "switches"]
    print("| " + " | ".join(titles) + " |", "|---" * len(titles) + "|", sep="\n")
    for name in (path for path in PATHS if options.only in path):
        for accelerations in (False, True):
            for dt in options.dt:
                rows = [examine(name, seed, dt, accelerations) for seed in range(options.seeds)]
                every += rows
                worst = {key: max(row[key] for row in rows) for key in ("change", "law")}
                share = np.mean([row["at_limit"] for row in rows])
                print(
                    f"| {name} | {rows[0]['by']} | {1e3 * dt:g} | {worst['change']:.6f} "
                    f"| {100 * share:.2f} % | {worst['law']:.4f} "
                    f"| {min(row['sigma'] for row in rows):.0e} "
                    f"| {sum(row['switches'] for row in rows)} |",
                    flush=True,
                )
    if options.out:
        options.out.write_text(json.dumps(every, indent=1) + "\n")


if __name__ == "__main__":
    main()
