"""Phases that set what a channel sets: targets that stand, that follow, and forces that are kept.

Strategy: a carriage on two slides, whose hand's place is its coordinates to the last digit; numbers
come from where the things stand that it goes to.
"""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np
import pytest

import hurcules

SCENE = """<mujoco><option timestep="0.002" gravity="0 0 0"/>
  <worldbody>
    <body><joint name="x" type="slide" axis="1 0 0" range="-2 2"/><geom size="0.05" mass="1"/>
      <body><joint name="z" type="slide" axis="0 0 1" range="-2 2"/><geom size="0.05" mass="1"/>
        <site name="hand"/></body></body>
    <body name="train" pos="0.3 0 0.2"><joint name="rail" type="slide" axis="1 0 0"/>
      <geom size="0.02" contype="0" conaffinity="0"/></body>
    <body name="late" mocap="true"/>
  </worldbody>
  <actuator><motor joint="x"/><motor joint="z"/></actuator></mujoco>"""
OVER = ["position/train/x", "position/train/z"]


def simulation(
    *phases: dict[str, Any], channel: str = "target", scale: float = 0.2, **options: Any
) -> hurcules.Simulation:
    model = mujoco.MjModel.from_xml_string(SCENE)
    robot = hurcules.Robot(model, joints=["x", "z"])
    hand = hurcules.PositionTask("hand", robot, "hand", axes=[[1, 0, 0], [0, 0, 1]])
    kinds = {
        "target": hurcules.Target(hand),
        "twist": hurcules.Twist(hand, scale),
        "delta": hurcules.Delta(hand, scale),
    }
    controller = hurcules.WholeBodyController(robot, [hand], {channel: kinds[channel]})
    rows = [{"stack": "stack", **phase} for phase in phases]
    mission = hurcules.Mission.read(
        {"mission": {"name": "carriage"}, "phase": rows, **options.pop("table", {})}
    )
    return hurcules.Simulation(
        mission, model=model, controller=controller, variation=0.0, **options
    )


def hand_of(made: hurcules.Simulation) -> np.ndarray:
    return np.asarray(made.data.site("hand").xpos[[0, 2]])


WAIT = {"name": "wait", "seconds": 1.0}


def value(numbers: list[float], **more: Any) -> dict[str, Any]:
    return {"name": "go", "seconds": 2.0, "lead": {"target": {"value": numbers, **more}}}


def test_a_target_is_where_the_phase_says_and_stays_there() -> None:
    made = simulation(WAIT, value([0.4, -0.1]), {**WAIT, "name": "stay"})
    made.step(500)
    assert hand_of(made) == pytest.approx([0.0, 0.0], abs=1e-6)  # nobody set one yet
    while not made.finished:
        made.step(7)
    assert hand_of(made) == pytest.approx([0.4, -0.1], abs=1e-4)
    assert made.success


def test_a_phase_waits_for_its_own_target() -> None:
    """The error is small as the second phase begins: that to the target of the first."""
    arrived = {"done": ["measured_error/hand <= 0.002"]}
    first = {"name": "there", "lead": {"target": {"value": [0.4, -0.1]}}, **arrived}
    second = {"name": "back", "lead": {"target": {"value": [0.1, 0.1]}}, **arrived}
    made = simulation(first, second)
    made.step(20000)
    assert hand_of(made) == pytest.approx([0.1, 0.1], abs=0.003)


def test_a_target_is_set_whatever_the_calls_are_cut_to() -> None:
    ends = []
    for ticks in (1, 13, 5000):
        made = simulation(WAIT, value([0.4, -0.1], to=OVER, follow=True))
        made.data.qvel[2] = 0.05
        while not made.finished:
            made.step(ticks)
        ends.append(made.state())
    assert np.array_equal(ends[0], ends[1])
    assert np.array_equal(ends[0], ends[2])


@pytest.mark.parametrize("follow", [False, True])
def test_a_thing_is_looked_at_once_or_followed(follow: bool) -> None:
    """The train goes on at 0.1 m/s from x = 0.3 m: 0.3 m at the start, 0.5 m after 2 s."""
    made = simulation(value([0.0, 0.1], to=OVER, follow=follow))
    made.data.qvel[2] = 0.1
    made.step(999)
    wanted = 0.5 if follow else 0.3
    # what is followed is a target that steps: it lags by its speed over the gain
    assert hand_of(made) == pytest.approx([wanted, 0.3], abs=0.03 if follow else 1e-3)


def test_a_command_on_top_takes_the_place_of_what_is_set() -> None:
    made = simulation({**value([0.4, -0.1]), "seconds": 6.0}, adds_command=True)
    made.step(1000, {"target": [-0.2, 0.2]})
    assert hand_of(made) == pytest.approx([-0.2, 0.2], abs=1e-3)
    made.step(1900)
    assert hand_of(made) == pytest.approx([0.4, -0.1], abs=1e-3)


@pytest.mark.parametrize("entry", [0, 1])
def test_a_place_that_nobody_knows_is_as_good_as_late(entry: int) -> None:
    """The margin of a robot that cannot tip over is no number."""
    unknown = ["monitor/static_margin_m" if entry == k else "" for k in range(2)]
    for follow in (False, True):
        made = simulation(value([0.1, 0.1], to=unknown, follow=follow))
        made.step(5000)
        assert made.reason == "phase 'go': took too long: monitor/static_margin_m is no number"
        made.restore(made.state())
        assert made.reason.endswith("is no number")
    late = {"within": 2.5, "late": ["back to wait", "abort"]}
    made = simulation(WAIT, {**value([0.1, 0.1], to=unknown), **late})
    made.step(5000)
    assert [text for _, text in made.events()].count("phase wait") == 2


def test_a_long_way_to_what_is_seen_takes_its_time() -> None:
    """0.3 m at 0.2 m/s by a way whose peak is 1.875 times its mean: 2.8 s in place of 1 s."""
    lead = {"lead": {"twist": {"by": [0.0, 0.0], "to": OVER}}}
    late = {"within": 1.1, "late": ["abort"]}
    made = simulation({"name": "go", "seconds": 1.0, **lead, **late}, channel="twist", scale=0.2)
    while not made.finished:
        made.step(1)
    assert made.success  # within grows too
    assert made.time == pytest.approx(1.875 * 0.3 / 0.2, abs=0.01)
    assert hand_of(made) == pytest.approx([0.3, 0.2], abs=2e-3)


def test_without_physics_it_sees_where_its_hand_is() -> None:
    lead = {"name": "go", "seconds": 0.5, "lead": {"target": {"value": [0.4, 0.0]}}}
    done = {"done": ["position/hand/x >= 0.39"], "within": 5.0, "late": ["abort"]}
    made = simulation({**lead, **done}, physics=False)
    made.step(5000)
    assert (made.success, made.reason) == (True, "completed")


def test_a_run_says_what_did_not_come_true() -> None:
    late = {"done": ["position/train/z >= 0.5"], "within": 1.5, "late": ["back to wait", "abort"]}
    made = simulation({**WAIT, **late})
    made.step(5000)
    words = "phase 'wait': took too long"
    assert made.reason == f"{words}: position/train/z >= 0.5 is not true, it is 0.2"
    told = ["phase wait", f"{words}; back to wait", f"{words}; abort"]
    assert [text for _, text in made.events()] == told
    endless = {"name": "wait", "done": ["position/train/z >= 0.5"]}
    made = simulation(endless, max_seconds=0.5)
    made.step(5000)
    assert made.reason.startswith("time is up at 0.500 s in phase")
    assert made.reason.endswith("in phase 'wait': position/train/z >= 0.5 is not true, it is 0.2")
    states = made.state()
    made.reset()
    made.restore(states)
    assert made.reason.startswith("time is up")


@pytest.mark.parametrize(
    ("phase", "channel", "wanted"),
    [
        ({"lead": {"target": {"rate": [1.0, 0.0]}}}, "target", "sets something: it wants `value`"),
        ({"lead": {"target": {"by": [1.0, 0.0]}}}, "target", "sets something: it wants `value`"),
        ({"lead": {"twist": {"value": [1.0, 0.0]}}}, "twist", "it wants `rate` or `by`"),
        ({"lead": {"delta": {"rate": [0.1, 0.0]}}}, "delta", "wants a Twist or a Target"),
        ({"lead": {"target": {"value": [1.0, 0.0], "follow": True}}}, "target", "`to` follow"),
        ({"lead": {"target": {"value": [1.0]}}}, "target", "wants 2 finite numbers, 1 came"),
        ({"lead": {"target": {"value": [1.0, 0.0], "by": [1.0, 0.0]}}}, "target", "one of them"),
        ({"within": 3.0}, "target", "within wants `late`"),
        (
            {"within": 3.0, "late": ["abort"], "done": ["q/x >= 1 for 5 s"]},
            "target",
            "is always late: 'q/x >= 1 for 5 s' cannot be true within 3 s",
        ),
        ({"done": ["position/hand/w >= 1"]}, "target", "phase 'go', quantity .*its /x, /y or /z"),
    ],
)
def test_a_mistake_is_told(phase: dict[str, Any], channel: str, wanted: str) -> None:
    with pytest.raises(hurcules.Error, match=wanted):
        simulation({"name": "go", "seconds": 1.0, **phase}, channel=channel)


def test_a_value_alone_ends_nothing() -> None:
    with pytest.raises(hurcules.Error, match="never ends"):
        simulation({"name": "go", "lead": {"target": {"value": [0.4, 0.0]}}})


@pytest.mark.parametrize(
    ("names", "wanted"),
    [
        (["reach_m", "reach_m"], "two figures are called 'reach_m'"),
        (["power_W"], "figure 'power_W': every run has one of this name"),
    ],
)
def test_each_figure_has_its_own_name(names: list[str], wanted: str) -> None:
    figures = [{"name": name, "quantity": "q/x"} for name in names]
    with pytest.raises(hurcules.Error, match=wanted):
        simulation(WAIT, table={"figure": figures})


def test_a_thing_that_comes_near_is_seen() -> None:
    """From (0.3, 0.2) at 0.1 m/s along x: 0.5 m away where x = sqrt(0.5^2 - 0.2^2) m."""
    near = {"name": "wait", "done": ["distance/hand/train >= 0.5"]}
    made = simulation(near)
    made.data.qvel[2] = 0.1
    made.step(5000)
    assert made.success
    assert made.time == pytest.approx(((0.25 - 0.04) ** 0.5 - 0.3) / 0.1, abs=0.01)
    assert made.log()["distance/hand/train"][0] == pytest.approx(0.13**0.5, abs=1e-3)
    with pytest.raises(hurcules.Error, match="distance of two frames 'hand/tram' does not exist"):
        simulation({**near, "done": ["distance/hand/tram >= 0.5"]})


def test_a_fall_is_watched_on_any_robot() -> None:
    head = {"name": "carriage", "max_tilt": 0.5}
    assert simulation(WAIT, table={"mission": head}).step(5000) == 500
    low = {**head, "fall_frame": "hand", "min_height": 0.2}
    made = simulation(WAIT, table={"mission": low})
    made.step(5000)
    assert made.reason.startswith("fell over at ")
    with pytest.raises(hurcules.Error, match="min_height wants a fall_frame whose height it is"):
        simulation(WAIT, table={"mission": {**head, "min_height": 0.2}})


def test_a_condition_that_holds_too_shortly_is_told_so() -> None:
    """The train is at x = 0.4 m after 1 s; 0.5 s later the phase is late."""
    done = "position/train/x >= 0.4 for 1 s"
    made = simulation({"name": "go", "done": [done], "within": 1.5, "late": ["abort"]})
    made.data.qvel[2] = 0.1
    made.step(5000)
    assert made.reason == f"phase 'go': took too long: {done} has not been true for so long"


def test_a_target_of_zero_is_set_by_hand_too() -> None:
    made = simulation(value([0.4, 0.0]))  # in 2 s
    made.step(500)
    made.pause()
    made.step(100, {"target": [0.0, 0.0]})
    made.resume()  # somebody moved it: its phase begins anew
    made.step(5000)
    assert made.time == pytest.approx(1.0 + 0.2 + 2.0, abs=0.01)


def test_values_are_saved_as_they_were_read(tmp_path: Any) -> None:
    mission = hurcules.Mission.read(
        {
            "mission": {"name": "carriage"},
            "phase": [{"stack": "stack", **value([0.1, 0.25], to=OVER, follow=True)}],
        }
    )
    mission.save(tmp_path / "carriage.toml")
    again = hurcules.Mission.load(tmp_path / "carriage.toml")
    lead = again.rows.phases[0].leads[0]
    assert (lead.value.tolist(), list(lead.to), lead.follow) == ([0.1, 0.25], OVER, True)
    assert "target set to 0.1 0.25 + position/train/x + position/train/z, followed" in again.table()


def test_the_world_is_pressed_by_what_lies_on_it() -> None:
    """A ball of 0.5 kg on a plane: 4.905 N."""
    text = SCENE.replace('gravity="0 0 0"', "").replace(
        '<body name="late" mocap="true"/>',
        '<geom type="plane" size="5 5 1" pos="0 0 -3"/>'
        '<body name="ball" pos="0 0 -2.95"><freejoint/><geom size="0.05" mass="0.5"/></body>',
    )
    model = mujoco.MjModel.from_xml_string(text)
    robot = hurcules.Robot(model, joints=["x", "z"])
    controller = hurcules.WholeBodyController(robot, [hurcules.PostureTask("posture", robot)])
    made = hurcules.Simulation(model=model, controller=controller)
    read = hurcules.Quantities(made, ["contact_force/world", "contact_force/ball"])
    made.step(2000)
    assert made.read(read) == pytest.approx([4.905, 4.905], rel=1e-3)
