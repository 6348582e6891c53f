"""K05, K07, K14, K18: both hands go down onto the ground, in the physics (section 5.6.2, 5.7.2).

The operator takes the ground to lie 30 mm lower than it does. K05 and K07 by accelerations, as in
the thesis, with the gains of K02 to K04; K14 and K18 in the velocity form. The thesis' simulation
has rigid elbows, the robot has springs: both are measured.
"""

from __future__ import annotations

from functools import cache

import numpy as np
from numpy.typing import NDArray

from hurcules import ForceGains, ForceLoop
from hurcules_studies.thesis.claim import Finding, Note, Plot, line
from hurcules_studies.thesis.measures.force_ideal import G
from hurcules_studies.thesis.measures.force_loops import DESIRED, settling
from hurcules_studies.thesis.measures.force_second_order import second
from hurcules_studies.thesis.measures.press_robot import Log, PressRobot, Setting, ramped
from hurcules_studies.thesis.measures.press_scene import Surface
from hurcules_studies.thesis.measures.registry import measures

DOWN = 0.02  # [m/s]
BEGIN, END = 1.5, 7.0  # [s]
DEPTH = 0.068  # [m] of the reference's way: 38 mm to the ground, 30 mm into it
PI_INTEGRAL = 0.3  # [m/s/N] the best one of K06
WINDOW = 20  # ticks
STILL = 1.0  # [s] at the end, for steady values
RIGID = 5e3  # [N/m] of the ground under rigid elbows


def lowered(setting: Setting, speed: float = DOWN, end: float = END) -> Log:
    """Both hands down by DEPTH."""
    robot = PressRobot(setting)
    robot.settle()
    arrive = BEGIN + DEPTH / speed + 0.3  # the ramps of the speed take 0.3 s
    return robot.follow(lambda _: 0.0, ramped(-speed, BEGIN, arrive), end)


@cache
def by_law(name: str, springs: bool = True) -> Log:
    """With a law of section 5.4, or "none"."""
    loops = {
        "P": second(ForceLoop.Position),
        "PI": second(ForceLoop.PositionIntegral, PI_INTEGRAL),
        "velocity": second(ForceLoop.Velocity),
        "none": second(ForceLoop.Velocity),
    }
    surface = Surface(springs=springs)
    return lowered(Setting(surface, loops[name], G, force=name != "none", f_max=1e6))


def pressed(log: Log) -> NDArray[np.float64]:
    """(ticks,) [N] of the left hand on the ground as the physics has it, mean of 20 ms."""
    return np.convolve(log.contact[:, 0, 2], np.ones(WINDOW) / WINDOW, "same")


def steady(log: Log) -> float:
    """Mean reading at the end [N]."""
    return float(log.force[log.part(log.time[-1] - STILL), 0].mean())


def picture(title: str, logs: dict[str, Log], start: float = 3.0) -> Plot:
    """Readings of the left hand."""
    lines = []
    for label, log in logs.items():
        part = log.part(start)
        lines.append(line(label, log.time[part], log.force[part, 0]))
    return Plot(title, "time [s]", "force read [N]", lines, levels=(DESIRED,))


@measures("K05")
def without_force_control() -> Finding:
    """Forces at the end; the laws beside it."""
    names = ("P", "PI", "velocity", "none")
    logs = {name: by_law(name) for name in names}
    rigid = by_law("none", springs=False)
    part = logs["velocity"].part(logs["velocity"].touched())
    time = logs["velocity"].time[part]
    settled = settling(time - time[0], logs["velocity"].force[part, 0], DESIRED, 0.05)
    return Finding(
        {
            "none": -steady(logs["none"]),
            "rigid": -float(pressed(rigid).min()),
            "velocity": abs(steady(logs["velocity"]) - DESIRED),
        },
        [
            Note("P ends at", steady(logs["P"]), "N"),
            Note("PI ends at", steady(logs["PI"]), "N"),
            Note("PI swings by (dry friction of the joints)", swing(logs["PI"]), "N"),
            Note("velocity loop within 5 % after", settled, "s"),
        ],
        [
            picture("With springs", {name: logs[name] for name in names[:3]}),
            picture("None, with springs", {"none": logs["none"]}),
            Plot(
                "None, rigid elbows",
                "time [s]",
                "force on the ground [N]",
                [line("", rigid.time[:-WINDOW], pressed(rigid)[:-WINDOW])],
            ),
        ],
    )


@measures("K07")
def references_change() -> Finding:
    """Commanded joints against those of the same motion where there is no ground."""
    velocity, none = by_law("velocity"), by_law("none")
    free = none.q  # motion alone knows nothing of a ground: see `changed_none`
    after = velocity.part(velocity.touched() + 0.5)
    joints = [velocity.of(name) for name in ("HIP", "LSP", "LEB")]
    lines = [
        line(f"{velocity.names[j]} {label}", log.time, log.q[:, j], style)
        for j in joints
        for label, log, style in (("with", velocity, "line"), ("without", none, "dashed"))
    ]
    touch = velocity.touched()
    reference = _alone()
    return Finding(
        {
            "with": float(np.abs(velocity.q - free)[after].max()),
            "without": float(np.abs(none.q - reference).max()),
        },
        plots=[Plot("Commanded joints", "time [s]", "[rad]", lines, marks=(touch,))],
    )


@cache
def _alone() -> NDArray[np.float64]:
    """The commanded joints of the same motion, of arms that pass through the ground."""
    log = lowered(Setting(Surface(untouched=True), second(ForceLoop.Velocity), G, force=False))
    return log.q


@cache
def rigid(compliance: float, bandwidth: float) -> Log:
    """Velocity form, rigid elbows on ground of 5 kN/m, a servo of another bandwidth."""
    surface = Surface(stiffness=RIGID, springs=False)
    gains = ForceGains(compliance=compliance)
    return lowered(Setting(surface, gains, RIGID, bandwidth=bandwidth, f_max=1e6), end=6.0)


def loops(slower: float, fed_forward: bool, late: float) -> NDArray[np.bool_]:
    """Whether each of 27000 loops of servo, mass, ground and force law has an unstable pole.

    The servo has a triple pole w: F / M = 3 w (v - x') + 3 w^2 e + w^3 int e, e = r - x, with v the
    speed of its reference or 0; the ground is f = G x, the law r' = -C f(t - late). Times s^2, with
    c = C G and the delay as (1 - late s / 2) / (1 + late s / 2):

        s^4 + 3 w s^3 + (3 w^2 + G / M) s^2 + w^3 s + delay (3 w c s^2 + 3 w^2 c s + w^3 c) = 0

    Args:
        slower: bandwidth of the servo over w.
        fed_forward: whether the servo is told the speed of its reference.
        late: [s] by which the reading is late.
    """
    w, M, G_, c = (
        values.ravel()
        for values in np.meshgrid(
            slower * np.geomspace(5.0, 60.0, 15),  # [rad/s]
            np.geomspace(1.0, 300.0, 15),  # [kg] felt at the tip
            np.array([1e3, 5e3, 2e4]),  # [N/m]
            np.geomspace(0.5, 2000.0, 40),  # [1/s] C G
            indexing="ij",
        )
    )
    none = np.zeros_like(w)
    plant = np.array([none, none + 1.0, 3 * w, 3 * w**2 + G_ / M, w**3, none])
    law = np.array([none, none, none, 3 * w * c * fed_forward, 3 * w**2 * c, w**3 * c])
    # times s is one place to the left
    whole = plant + law + 0.5 * late * (np.roll(plant, -1, 0) - np.roll(law, -1, 0))
    whole = whole if late else whole[1:]
    companion = np.zeros((w.size, len(whole) - 1, len(whole) - 1))
    companion[:, 0] = -(whole[1:] / whole[0]).T
    companion[:, range(1, len(whole) - 1), range(len(whole) - 2)] = 1.0
    return np.asarray(np.linalg.eigvals(companion).real.max(axis=1) > 0.0)


def swing(log: Log) -> float:
    """Deviation of the force in the last second [N]."""
    return float(log.force[log.part(log.time[-1] - STILL), 0].std())


@measures("K14")
def bandwidths() -> Finding:
    """Swings of the force over C G and over the servo's bandwidth; settling over C with springs."""
    rates = (5.0, 20.0, 50.0, 150.0)  # C G [1/s]
    swings = {
        bandwidth: [swing(rigid(rate / RIGID, bandwidth)) for rate in rates]
        for bandwidth in (1.0, 0.4)
    }
    slow, fast = (
        lowered(Setting(gains=ForceGains(compliance=C), environment=G), end=6.5)
        for C in (0.002, 0.02)
    )
    arrive = []
    for log in (slow, fast):
        part = log.part(log.touched())
        time = log.time[part]
        arrive.append(settling(time - time[0], log.force[part, 0], DESIRED, 0.1))
    measured = loops(1.0, False, 0.0)
    return Finding(
        {
            "slower": swings[1.0][0],
            "faster": swings[1.0][3],
            "lower_bandwidth": swings[0.4][3] / swings[1.0][3],
            "too_small": arrive[0] / arrive[1],
        },
        [
            Note(f"C G = {rate:g} 1/s, bandwidth x {bandwidth:g}: swing", value, "N")
            for bandwidth, values in swings.items()
            for rate, value in zip(rates, values, strict=True)
        ]
        + [
            Note("loops of 27000 with an unstable pole", float(loops(1.0, True, 0.0).sum())),
            Note("the same, reading 2 ms late", float(loops(1.0, True, 2e-3).sum())),
            Note("the same, damping on the measured speed", float(measured.sum())),
            Note(
                "more of these at 0.4 times the bandwidth",
                float((loops(0.4, False, 0.0) & ~measured).sum()),
            ),
        ],
        [
            Plot(
                "Swing of the force, rigid elbows on 5 kN/m",
                "C G [1/s]",
                "[N]",
                [line(f"bandwidth x {b:g}", rates, values) for b, values in swings.items()],
                log="xy",
            ),
            picture("With springs", {"C = 0.002": slow, "C = 0.02": fast}),
        ],
    )


@measures("K18")
def elbow_spring() -> Finding:
    """Hands come down at 0.05 m/s, with springs and without."""
    gains = ForceGains(compliance=0.01)
    soft = lowered(Setting(gains=gains, environment=G, f_max=1e6), 0.05, 4.0)
    hard = lowered(Setting(Surface(springs=False), gains, environment=5e4, f_max=1e6), 0.05, 4.0)
    peaks = [-float(log.contact[:, :, 2].min()) for log in (soft, hard)]
    window = [log.part(2.0, 3.5) for log in (soft, hard)]
    lines = [
        line(label, log.time[part], log.contact[part, 0, 2])
        for label, log, part in zip(("spring", "rigid"), (soft, hard), window, strict=True)
    ]
    return Finding(
        {
            "spring": peaks[0],
            "ratio": peaks[1] / peaks[0],
            "smooth": abs(steady(soft) - DESIRED),
            "rigid_swing": swing(hard),
        },
        [Note("largest force on the ground, rigid elbows", peaks[1], "N")],
        plots=[
            Plot("Force on the ground", "time [s]", "[N]", lines, levels=(DESIRED,)),
            picture("Reading", {"spring": soft}, 2.0),
        ],
    )
