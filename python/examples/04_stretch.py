"""The first seconds of the mission `stretch`, in the physics: 680 kg on tracks, at 1 kHz.

Run:  python python/examples/04_stretch.py

The whole mission, with film and report: hurcules run stretch
"""

from time import perf_counter

import numpy as np

import hurcules

simulation = hurcules.Simulation("stretch", seed=0)
print("levels:", " < ".join(simulation.levels))

started = perf_counter()
while simulation.time < 6.0 and not simulation.finished:
    simulation.step(1000)
    errors = dict(zip(simulation.levels, simulation.level_errors(), strict=True))
    hands, pelvis = 1000 * errors["hpos"], 1000 * errors["pel"]
    phase = simulation.phase
    print(f"{simulation.time:4.1f} s  {phase:8}  hands {hands:5.2f} mm  pelvis {pelvis:5.2f} mm")
speed = simulation.time / (perf_counter() - started)

log = simulation.log()
settled = log["phase"] > 0  # in the first phase, 2 s, the brakes open and the robot finds its rest
errors = [np.abs(log[name][settled]).max() for name in log if name.startswith("joint_error/")]
print(f"{speed:.1f} x real time, largest joint control error {1000 * max(errors):.1f} mrad")
print("over a joint limit:", simulation.limit_violation()["position_rad"], "rad")
for time, text in simulation.events():
    print(f"{time:6.3f} s  {text}")
