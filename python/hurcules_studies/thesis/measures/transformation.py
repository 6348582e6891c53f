"""H04, P06, H13: one run of the rescue robot from driving to standing, to the ground, and back.

The scripts of hurcules.postures with 120 kg on the scoops, in the physics with brakes and drive
trains, so that one run tells balance, torque, control errors, time and energy. H13 adds the way.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache

import numpy as np

import hurcules
from hurcules import postures
from hurcules.postures import Result
from hurcules_studies.thesis.claim import Finding, Note, Plot, line
from hurcules_studies.thesis.measures.problems import Array
from hurcules_studies.thesis.measures.registry import measures
from hurcules_studies.thesis.measures.rig import Load, on_the_scoops, scene, start, take
from hurcules_studies.thesis.measures.rover import DRIVING_SPEED, Powered, Rover, Trip, flat

MASS = 120.0  # [kg] Table 4.1
HOLD = 20.0  # [s] that the load is carried, standing
SAMPLE = 10  # steps between two looks
# parts of the robot whose motors lift: all but belts, bed and grippers
LIFTING = ("KN", "HIP", "WST", "NK", "SP", "SR", "SY", "EB")


@dataclass(frozen=True)
class Run:
    """What the transformation took.

    Attributes:
        before, lifted, after: results of the moves until the load is taken, with it off the
            ground until it is carried, and back to driving.
        time: (samples,) [s].
        height: (samples,) [m] of the load's underside over the ground.
        torque: (samples, motors) share of the peak.
        error: (samples, motors) [rad] reference minus measured; those of belts and bed are left
            out.
        joints: names of these motors.
        begin, end: [s] of the lift.
        energy: [J] from the battery; standby, open brakes and motors.
        work: [J] of the motors.
    """

    before: list[Result]
    lifted: list[Result]
    after: list[Result]
    time: Array
    height: Array
    torque: Array
    error: Array
    joints: list[str]
    begin: float
    end: float
    energy: float
    work: float

    @property
    def moves(self) -> list[Result]:
        """All of them."""
        return [*self.before, *self.lifted, *self.after]


@cache
def run() -> Run:
    """The whole transformation with the load."""
    load = Load(MASS, "LR", on_the_scoops())
    model = scene("rescue", {"load": load})
    data, player = start(model, "rescue", "drive", ["load"])
    powered = Powered(model, player.simulation.plant)
    kept = [i for i, joint in enumerate(player.joints) if joint.lstrip("LR").startswith(LIFTING)]
    peak = player.peak[kept]
    places = [int(model.joint(player.joints[i]).qposadr[0]) for i in kept]
    foot = load.position[2]
    rows: list[tuple[float, Array, Array]] = []
    height: list[float] = []

    def watch() -> None:
        powered.read()
        if round(data.time / model.opt.timestep) % SAMPLE == 0:
            error = player.reference[kept] - data.qpos[places]
            rows.append((data.time, player.controller.torque[kept] / peak, error))
            height.append(float(data.body("load").xpos[2]) - foot)

    player.watch = watch
    before = player.play([*postures.stand_up("rescue"), *postures.lower("rescue")])
    take(model, data, "rescue", "load", load.hands)
    begin = float(data.time)
    lifted = [*player.play(postures.lift("rescue")), player.wait(HOLD, "carry")]
    end = float(data.time)
    after = player.play(postures.fold_back("rescue"))
    time, torque, error = (np.array(column) for column in zip(*rows, strict=True))
    joints = [player.joints[i] for i in kept]
    taken = (begin, end, powered.energy, powered.work)
    return Run(before, lifted, after, time, np.array(height), torque, error, joints, *taken)


def picture(title: str, label: str, values: Array, joints: Sequence[str]) -> Plot:
    """Of some joints, with the lift between marks."""
    one = run()
    lines = [line(name, one.time, values[:, one.joints.index(name)]) for name in joints]
    return Plot(title, "time [s]", label, lines, marks=(one.begin, one.end))


@measures("H04")
def lifts_120_kg() -> Finding:
    """From the ground to the carrying pose, held for 20 s; then on to the driving pose."""
    one = run()
    carried = (one.time > one.end - HOLD + 1.0) & (one.time < one.end)
    motors = np.abs(one.torque[(one.time > one.begin) & (one.time < one.end)])
    worst = int(motors.max(axis=0).argmax())
    heights = [line("underside of the load", one.time, one.height)]
    return Finding(
        {
            "height": float(one.height[carried].min()),
            "saturated": int(np.sum(np.any(motors >= 1.0, axis=1))),
            "margin": min(result.margin for result in one.lifted),
            "collisions": sum(len(result.collisions) for result in one.lifted),
            "whole_margin": min(result.margin for result in one.moves),
        },
        [
            Note(f"largest share of a peak torque, at {one.joints[worst]}", float(motors.max())),
            Note(
                "the same, whole transformation",
                max(result.torque[joint] for result in one.moves for joint in one.joints),
            ),
            Note("geoms of the robot that met, whole transformation",
                 sum(len(result.collisions) for result in one.moves)),
        ],
        [
            Plot("Load", "time [s]", "[m]", heights, marks=(one.begin, one.end)),
            picture("Torques", "share of the peak", one.torque, ("LKN", "HIP", "LSP", "LEB")),
        ],
    )  # fmt: skip


@measures("P06")
def errors_under_120_kg() -> Finding:
    """Every joint that lifts, from when the load is taken to the end of the carrying."""
    one = run()
    during = (one.time > one.begin) & (one.time < one.end)
    arms = [i for i, name in enumerate(one.joints) if name[1:] in ("SP", "SR", "SY", "EB")]
    errors = np.abs(one.error[during])
    worst = int(errors.max(axis=0).argmax())
    return Finding(
        {"arms": float(errors[:, arms].max()), "all": float(errors.max())},
        [Note(f"the worst is {one.joints[worst]}", float(errors[:, worst].max()), "rad")],
        [
            picture("Control errors, arms", "[mrad]", 1e3 * one.error, ("LSP", "LSR", "LEB")),
            picture("Legs and hip", "[mrad]", 1e3 * one.error, ("LKN", "RKN", "HIP")),
        ],
    )


# §4.5: 400 m on a round trip, seven times within two hours
MISSIONS, WAY, HOURS = 7, 400.0, 2.0


@cache
def ways() -> tuple[Trip, Trip]:
    """There, and back with the load on the bed."""
    there, back = (Rover(flat(load), raised=load > 0.0).drive(WAY) for load in (0.0, MASS))
    return there, back


@measures("H13")
def two_hours() -> Finding:
    """Seven missions: 400 m there and 400 m back with 120 kg, and the transformation between.

    What is left of the two hours the robot works: as many watts as the transformation takes.
    """
    there, back = ways()
    one = run()
    driving = MISSIONS * (there.seconds + back.seconds)
    standing = MISSIONS * float(one.time[-1])
    power = one.energy / float(one.time[-1])
    rest = 3600.0 * HOURS - driving - standing
    battery = hurcules.Battery()
    battery.draw(MISSIONS * (there.energy + back.energy) / driving, driving)
    after_driving = battery.charge
    battery.draw(power, standing + rest)
    return Finding(
        {
            "time": (driving + standing) / 3600.0,
            "charge": battery.charge,
            "way": min(there.metres, back.metres),
        },
        [
            Note("400 m at 20 km/h", there.energy, "J"),
            Note("the same with 120 kg", back.energy, "J"),
            Note("a transformation with its load", one.energy, "J"),
            Note("power while it works", power, "W"),
            Note("charge after all the driving", after_driving),
        ],
        remark=f"Battery of 6.2 kWh, assumed: 60 kg. Driven at {3.6 * DRIVING_SPEED:.0f} km/h "
        "against 6 % of the weight as rolling resistance. §4.5 says 400 m on a round trip; here "
        "400 m each way.",
    )
