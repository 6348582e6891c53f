"""Force tasks that weigh the tool at rest before they press."""

from __future__ import annotations

import hurcules

__all__ = ["rest_and_tare"]


def rest_and_tare(simulation: hurcules.Simulation, *presses: hurcules.ForceTask) -> None:
    """The robot comes to rest in 0.5 s without them, then they take their tare, and are on."""
    for press in presses:
        press.enable(False)
    simulation.step(round(0.5 / simulation.dt))
    for press in presses:
        press.tare()
    simulation.step(round(0.15 / simulation.dt))
    for press in presses:
        press.enable(True)
