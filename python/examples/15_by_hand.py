"""A person leads a hand by a stick whose link is lost, in the middle of a mission; then once more.

The stick sends 50 times a second, mostly late, and is silent for half a second. What the person
does is kept as the calls that were made: they give the same bits again.

Run:  python python/examples/15_by_hand.py
"""

import numpy as np

import hurcules

PERIOD = 0.02  # [s] of the operator's loop
STALE = 0.1  # [s] what is older than this is not done any more


def stick() -> list[tuple[float, list[float]]]:
    """(arrival [s], velocity [m/s]) of each message of three seconds; none from 1.0 to 1.5 s."""
    sent = np.arange(0.0, 3.0, PERIOD)
    late = np.random.default_rng(0).exponential(0.005, sent.size)
    return [(a, [0.04, 0.0, 0.0]) for a in np.sort(sent + late) if not 1.0 < a < 1.5]


def main() -> None:
    """Leads the hand and hands the robot back, then does it all again."""
    simulation = hurcules.Simulation("stretch", record=False)
    calls = []

    def do(name, *given):
        calls.append((name, given))
        return getattr(simulation, name)(*given)

    do("step", 14000)  # the mission
    do("pause")  # it stands still
    start, messages, held = simulation.data.site("L_tcp").xpos[0], stick(), 0
    for now in np.arange(0.0, 3.0, PERIOD):  # of a real stick: by the clock
        come = [message for message in messages if message[0] <= now]
        fresh = bool(come) and now - come[-1][0] < STALE
        do("step", 20, {"left_hand": come[-1][1]} if fresh else None)  # None: the robot holds
        held += not fresh
    print(f"by hand: {simulation.data.site('L_tcp').xpos[0] - start:.2f} m ahead")
    print(f"link lost: held for {held * PERIOD:.2f} s")
    for level in simulation.controller.diagnostics():
        for short in level.shortfalls:
            print(" ", short)  # what gives way, and why
    do("resume")  # its phase begins anew from here
    do("step", 2000)

    again = hurcules.Simulation("stretch", record=False)
    for name, given in calls:
        getattr(again, name)(*given)
    same = np.array_equal(again.state(), simulation.state())
    print(f"{simulation.time:.0f} s, phase {simulation.phase}; again, the same bits: {same}")


if __name__ == "__main__":
    main()
