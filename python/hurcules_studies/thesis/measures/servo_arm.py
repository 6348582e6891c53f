"""P01, P04, P08, P09: the servo on an arm of two joints in a vertical plane, in MuJoCo.

Upper arm 0.4 m with 30 kg in its middle, lower arm 11.5 kg at 0.30 m, the load 0.44 m from the
elbow, rotors 2.6 and 0.9 kg m^2: the shoulder pitch and the elbow of the rescue robot. No model and
no feed-forward; gains for a triple pole at 30 and 50 rad/s of joints that feel 10 and 2.5 kg m^2.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import mujoco
import numpy as np

import hurcules
from hurcules_studies.thesis.claim import Finding, Plot, line
from hurcules_studies.thesis.measures.problems import Array
from hurcules_studies.thesis.measures.registry import measures
from hurcules_studies.thesis.measures.servo_theory import Appendix

DT = 1e-3  # [s]
INERTIA, BANDWIDTH = np.array([10.0, 2.5]), np.array([30.0, 50.0])  # [kg m^2], [rad/s]

ARM = """
<mujoco>
  <compiler angle="radian"/>
  <option timestep="0.001" integrator="implicitfast"/>
  <worldbody><body>
    <joint name="shoulder" axis="0 -1 0" armature="2.6"/>
    <inertial pos="0.2 0 0" mass="30" diaginertia="0.001 0.001 0.001"/>
    <body pos="0.4 0 0">
      <joint name="elbow" axis="0 -1 0" armature="0.9"/>
      <inertial pos="0.3 0 0" mass="11.5" diaginertia="0.001 0.5 0.5"/>
      <body name="load" pos="0.44 0 0"><inertial pos="0 0 0" mass="{load}"
        diaginertia="0.001 0.001 0.001"/></body>
    </body>
  </body></worldbody>
  <actuator><motor joint="shoulder"/><motor joint="elbow"/></actuator>
</mujoco>
"""


@dataclass(frozen=True)
class Run:
    """time (ticks,) [s]; error (ticks, 2) [rad]."""

    time: Array
    error: Array

    def largest(self, start: float = 1.0, end: float = np.inf) -> float:
        """Largest error between two times, by default after the first second."""
        return float(np.abs(self.error[(self.time >= start) & (self.time < end)]).max())


def gains(K_scale: float = 1.0, gamma: float = 1.0) -> hurcules.JointPidOptions:
    """K + 1 / gamma^2 = 3 omega J at K_scale = gamma = 1, K_P = omega, K_I = omega^2 / 3."""
    return hurcules.JointPidOptions(
        K=K_scale * (3.0 * BANDWIDTH * INERTIA - 1.0),
        K_P=BANDWIDTH,
        K_I=BANDWIDTH**2 / 3.0,
        gamma=gamma,
        max_torque=[1e9, 1e9],
        dt=DT,
    )


def moved(t: float, seconds: float) -> tuple[Array, Array]:
    """Lifting and lowering until a time, then rest: position [rad] and velocity [rad/s]."""
    phase, rate = 0.5 * min(t, seconds), 0.5 * (t < seconds)
    way = np.array([0.4, -0.5])
    return np.array([0.3, 1.0]) + way * np.sin(phase), way * np.cos(phase) * rate


def run(
    options: hurcules.JointPidOptions,
    load: float = 30.0,
    seconds: float = 12.0,
    moving: float = np.inf,
    disturbance: float = 0.0,
    disturbed: float = np.inf,
) -> Run:
    """Follows the motion.

    Args:
        options: of the servo.
        load: [kg].
        seconds: of the run.
        moving: [s] the reference rests from then on.
        disturbance: [N m] amplitude on both joints, at 1 Hz.
        disturbed: [s] none from then on.
    """
    model = mujoco.MjModel.from_xml_string(ARM.format(load=max(load, 1e-3)))
    data = mujoco.MjData(model)
    pid = hurcules.JointPid(options)
    data.qpos[:], data.qvel[:] = moved(0.0, moving)
    time = np.asarray(DT * np.arange(round(seconds / DT)), dtype=np.float64)
    errors = np.zeros((time.size, 2))
    for i, t in enumerate(time):
        q, qd = moved(float(t), moving)
        errors[i] = q - data.qpos
        data.ctrl[:] = pid.compute(errors[i], qd - data.qvel)
        push = disturbance * np.sin(2 * np.pi * t) * (t < disturbed)
        data.qfrc_applied[:] = push
        mujoco.mj_step(model, data)
    return Run(time, errors)


def picture(title: str, runs: dict[str, Run], joint: int = 0) -> Plot:
    """Errors of a joint."""
    lines = [line(label, one.time, 1e3 * one.error[:, joint]) for label, one in runs.items()]
    return Plot(title, "time [s]", "error [mrad]", lines)


@measures("P01")
def tracks() -> Finding:
    """The torque against the optimal law u = -R^-1 B' P x of the appendix, then the arm."""
    one = Appendix.random(1)
    diagonals = {"K": one.K.diagonal(), "K_P": one.K_P.diagonal(), "K_I": one.K_I.diagonal()}
    options = hurcules.JointPidOptions(**diagonals, gamma=0.7, max_torque=[1e9] * 3, dt=0.01)
    pid, rng = hurcules.JointPid(options), np.random.default_rng(5)
    for _ in range(20):
        position, velocity = rng.uniform(-0.1, 0.1, 3), rng.uniform(-0.5, 0.5, 3)
        torque = pid.compute(position, velocity)
    x = np.concatenate([pid.integral, position, velocity])
    wanted = (one.K + np.eye(3) / 0.7**2) @ one.B.T @ one.P @ x
    arm = run(gains(), seconds=17.0, moving=12.0)
    return Finding(
        {
            "law": float(np.abs(torque - wanted).max() / np.abs(wanted).max()),
            "error": arm.largest(1.0),
            "rest": arm.largest(16.9),
        },
        plots=[
            picture("Shoulder pitch, 30 kg", {"": arm}),
            picture("Elbow, 30 kg", {"": arm}, 1),
        ],
    )


@measures("P04")
def twice_the_performance() -> Finding:
    """K and 4 K, gamma large so that K alone decides."""
    runs = {f"{scale:g} K": run(gains(scale, gamma=1e3)) for scale in (1.0, 4.0)}
    first, second = runs.values()
    ratio = second.largest() / first.largest()
    return Finding(
        {"ratio": ratio, "square_root": ratio}, plots=[picture("Shoulder pitch, 30 kg", runs)]
    )


@measures("P08")
def bounded() -> Finding:
    """A disturbance of 1 Hz on both joints for 12 s; motion and disturbance end, 5 s of rest."""
    runs = {
        f"{torque:g} N m": run(
            gains(), seconds=17.0, moving=12.0, disturbance=torque, disturbed=12.0
        )
        for torque in (0.0, 50.0, 100.0)
    }
    free, half, full = runs.values()

    def by_disturbance(one: Run) -> float:
        return float(np.abs(one.error - free.error)[1000:12000].max())

    return Finding(
        {
            "growth": by_disturbance(full) / by_disturbance(half),
            "late": full.largest(8.0, 12.0) / full.largest(4.0, 8.0),
            "moving": free.largest(1.0, 12.0),
            "after": full.largest(16.9),
        },
        plots=[picture("Shoulder pitch, disturbed until 12 s", runs)],
    )


@measures("P09")
def smaller_gamma() -> Finding:
    """Errors over gamma; Q of the appendix with and without gamma."""
    gammas = (1.0, 0.3, 0.1, 0.05)
    runs = {f"gamma = {gamma:g}": run(gains(gamma=gamma)) for gamma in gammas}
    errors = [one.largest() for one in runs.values()]
    one = Appendix.random(3)
    changed = max(float(np.abs(one.Q(gamma) - one.Q()).max()) for gamma in gammas)
    return Finding(
        {
            "falling": sum(a <= b for a, b in pairwise(errors)),
            "q_changed": changed / float(np.abs(one.Q()).max()),
            "ratio": errors[-1] / errors[0],
        },
        plots=[picture("Shoulder pitch, 30 kg", runs)],
    )
