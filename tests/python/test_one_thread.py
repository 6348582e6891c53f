"""What works without the interpreter's lock is refused to a second thread, which may read it."""

import threading
from collections.abc import Callable
from typing import Any

import mujoco
import numpy as np

import hurcules


def refusals(work: Callable[[], Any], calls: int) -> list[str]:
    """What two threads that both work so often are told."""
    told: list[str] = []

    def go() -> None:
        for _ in range(calls):
            try:
                work()
            except hurcules.Error as error:
                told.append(str(error))

    threads = [threading.Thread(target=go) for _ in range(2)]
    for one in threads:
        one.start()
    for one in threads:
        one.join()
    return told


def test_two_threads_do_not_step_one_simulation() -> None:
    simulation = hurcules.Simulation("stretch", record=False)
    told = refusals(lambda: simulation.step(20), 30)
    assert set(told) == {
        "this Simulation is at work in another thread; one thread at a time may use it"
    }
    assert round(simulation.time / simulation.dt) == 20 * (60 - len(told))
    simulation.step(1)


def test_a_display_reads_what_another_thread_steps() -> None:
    # log() read rows that were being added: the process crashed
    simulation = hurcules.Simulation("stretch")
    done: list[int] = []
    loop = threading.Thread(target=lambda: done.append(simulation.step(4000)))
    loop.start()
    lengths = []
    while loop.is_alive():
        log = simulation.log()
        assert len({len(values) for values in log.values()}) == 1
        lengths.append(len(log["time"]))
        simulation.state(), simulation.level_errors(), simulation.controller.diagnostics()
    loop.join()
    assert done == [4000]
    assert lengths == sorted(lengths)
    assert any(0 < length < 4000 for length in lengths)  # it rests for readers on the way


def test_nor_one_batch_nor_one_mjdata() -> None:
    batch = hurcules.SimulationBatch(hurcules.Simulation("stretch", record=False), n=2, threads=1)
    told = refusals(lambda: batch.step(20), 30)
    assert all("this SimulationBatch is at work" in one for one in told) and told
    model = hurcules.models.load("rescue")
    data = mujoco.MjData(model)
    told = refusals(lambda: hurcules.step(model, data, n=20), 30)
    assert all("this MjData is at work" in one for one in told) and told


def test_two_controllers_do_not_lead_one_robot_at_the_same_time() -> None:
    robot = hurcules.Robot(hurcules.models.load("rescue"))
    postures = iter([hurcules.PostureTask("posture", robot) for _ in range(2)])
    own = threading.local()

    def step() -> None:
        if not hasattr(own, "controller"):
            own.controller = hurcules.VelocityController(robot)
            own.controller.set_stack(hurcules.Stack([next(postures)]))
        own.controller.step(robot)

    for one in refusals(step, 2000):
        assert one.startswith("this controller or Robot is at work in another thread")
    assert np.isfinite(robot.configuration).all()
