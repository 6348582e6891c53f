"""Runs one peer through one scenario and prints what came out as JSON.

The peer's own environment runs this file; `run.py` calls it.
"""

from __future__ import annotations

import argparse
import importlib
import json
import time

import numpy as np
from problem import DT, SCENARIOS, robot_description, targets


def main() -> None:
    """Runs what the command line asks for."""
    parser = argparse.ArgumentParser()
    parser.add_argument("peer", help="module NAME_peer.py")
    parser.add_argument("scenario", choices=SCENARIOS)
    parser.add_argument("--option", type=json.loads, default={}, help="arguments of the peer")
    parser.add_argument("--ticks", type=int, default=1600)
    arguments = parser.parse_args()
    urdf, joints = robot_description()
    peer = importlib.import_module(f"{arguments.peer}_peer").Peer(urdf, joints, **arguments.option)
    start = peer.start_poses()
    wanted = [targets(arguments.scenario, start, i * DT) for i in range(arguments.ticks)]
    times, failed, way = np.empty(arguments.ticks), 0, [peer.q.copy()]
    for i, aim in enumerate(wanted):
        begin = time.perf_counter()
        peer.aim(aim)
        done = peer.tick()
        times[i] = time.perf_counter() - begin
        failed += not done
        way.append(peer.q.copy())
    path = np.array(way)
    answer = {
        "name": peer.name,
        "microseconds": (1e6 * times).tolist(),
        "failed": failed,
        "q": path.tolist(),
        "aim": {hand: [pose[0].tolist(), pose[1].tolist()] for hand, pose in wanted[-1].items()},
    }
    print(json.dumps(answer))


if __name__ == "__main__":
    main()
