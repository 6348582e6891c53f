"""Missions as TOML: what is read is what is written, and every mistake is told with its row.

Strategy: a small table on an arm of two joints, with and without one thing wrong; the table of the
lift as it comes. What the phases do is tests/cpp/mission/mission_test.cpp's matter, the lift itself
test_lift.py's.
"""

from __future__ import annotations

import re
from collections import Counter
from pathlib import Path
from xml.etree import ElementTree

import mujoco
import pytest

import hurcules
from hurcules import Error, Mission, mjcf

ARM = """
<mujoco>
  <compiler angle="radian"/>
  <worldbody>
    <body name="upper" pos="0 0 1">
      <joint name="j1" axis="0 1 0" range="-3 3" limited="true"/>
      <geom type="capsule" size="0.03" fromto="0 0 0 0.4 0 0" mass="1"/>
      <body name="lower" pos="0.4 0 0">
        <joint name="j2" axis="0 1 0" range="-3 3" limited="true"/>
        <geom type="capsule" size="0.03" fromto="0 0 0 0.4 0 0" mass="1"/>
        <site name="hand" pos="0.4 0 0"/>
      </body>
    </body>
  </worldbody>
  <actuator>
    <motor joint="j1" gear="50" ctrlrange="-1 1"/>
    <motor joint="j2" gear="50" ctrlrange="-1 1"/>
  </actuator>
</mujoco>
"""
ROWS = """
[mission]
name = "wave"
safety = "back"

[[phase]]
name = "up"
note = "waves"
stack = "posture"
posture = "posture"
seconds = 1.0
keys = [{ share = 0.5, j1 = -0.2 }, { share = 1.0, j1 = -0.5, j2 = 0.3 }]
done = ["q/j1 <= -0.45 for 0.1 s"]
within = 3.0
late = ["hold 0.5 s", "back to up, 2 times", "abort"]
trouble = [{ when = "q/j2 >= 2.0", do = ["ask 5.0 s", "lower"] }]

[[phase]]
name = "back"
stack = "posture"
lead.posture = { rate = [0.5, 0.0], way = 0.2 }

[[figure]]
name = "reached_rad"
quantity = "q/j1"
take = "smallest"
phases = ["up"]
most = -0.4
"""


SVG = "http://www.w3.org/2000/svg"


def loop(text: str = ROWS, arm: str = ARM) -> hurcules.Simulation:
    model = mujoco.MjModel.from_xml_string(arm)
    robot = hurcules.Robot(model)
    posture = hurcules.PostureTask("posture", robot)
    controller = hurcules.WholeBodyController(
        robot, None, {"posture": hurcules.Twist(posture, 2.0)}, stacks={"posture": [posture]}
    )
    return hurcules.Simulation(read(text), model=model, controller=controller)


def read(text: str) -> Mission:
    import tomllib

    return Mission.read(tomllib.loads(text))


def test_a_table_runs_in_the_loop_and_its_figures_judge_it() -> None:
    simulation = loop()
    assert simulation.phases == ["up", "back"]
    simulation.step(5000)
    assert simulation.success, simulation.reason
    assert simulation.figures()["reached_rad"] == pytest.approx(-0.5, abs=0.02)
    assert simulation.data.joint("j1").qpos[0] == pytest.approx(-0.3, abs=0.02)
    assert simulation.mission == "wave"
    failed = loop(ROWS.replace("most = -0.4", "most = -0.9"))
    failed.step(5000)
    assert not failed.success
    assert failed.reason.startswith("reached_rad is -0.")


def test_the_same_table_gives_the_same_bits_from_a_snapshot() -> None:
    one, other = loop(), loop()
    one.step(700)
    other.restore(one.state())
    one.step(300)
    other.step(300)
    assert one.phase == other.phase
    assert (one.state() == other.state()).all()


def test_a_lead_goes_by_what_is_seen_as_its_phase_begins() -> None:
    seen = ROWS.replace(
        "lead.posture = { rate = [0.5, 0.0], way = 0.2 }",
        'seconds = 1.0\nlead.posture = { by = [0.1, 0.0], to = ["q/j2", ""] }',
    )
    simulation = loop(seen)
    while simulation.phase == "up":
        simulation.step(1)
    j1, j2 = (float(simulation.data.joint(name).qpos[0]) for name in ("j1", "j2"))
    assert j2 == pytest.approx(0.3, abs=0.02)
    simulation.step(300)
    copy = loop(seen)
    copy.restore(simulation.state())  # what was seen is part of the state
    for one in (simulation, copy):
        one.step(5000)
        assert one.data.joint("j1").qpos[0] == pytest.approx(j1 + 0.1 + j2, abs=0.02)
    assert copy.data.qpos.tolist() == simulation.data.qpos.tolist()


def test_a_rate_holds_a_quantity_in_the_phases_that_say_so() -> None:
    held = ROWS.replace("lead.posture = { rate = [0.5, 0.0], way = 0.2 }", "seconds = 2.0")
    held += """
[[lead]]
channel = "posture"
rate = [0.5, 0.0]
hold = "q/j1"
at = -0.1
span = 0.1
phases = ["back"]
"""
    simulation = loop(held)
    simulation.step(5000)
    assert simulation.success, simulation.reason
    assert simulation.data.joint("j1").qpos[0] == pytest.approx(-0.1, abs=0.005)
    assert read(held).table() == read(read(held).toml()).table()
    twice = held.replace('phases = ["back"]\n', 'phases = ["back", "back"]\n')
    with pytest.raises(Error, match="phase 'back' leads it already"):
        read(twice)
    with pytest.raises(Error, match="lead of 'posture': no phase 'home'"):
        read(held.replace('phases = ["back"]', 'phases = ["home"]'))


def test_a_condition_asks_for_a_thing_that_nobody_commands() -> None:
    """A ball falls past z = 0.3 m after sqrt(2 0.2 m / g), with -sqrt(2 g 0.2 m)."""
    ball = '<body name="ball" pos="1 0 0.5"><freejoint/><geom size="0.02"/></body></worldbody>'
    speed = '<sensor><framelinvel name="speed" objtype="body" objname="ball"/></sensor></mujoco>'
    scene = ARM.replace("</worldbody>", ball).replace("</mujoco>", speed)
    fallen = ROWS.replace(
        'done = ["q/j1 <= -0.45 for 0.1 s"]',
        'done = ["position/ball/z <= 0.3"]',
    ).replace("q/j2 >= 2.0", "contact_force/lower >= 1")
    fallen = fallen.replace("seconds = 1.0", "seconds = 0.1").replace('"q/j1"', '"sensor/speed/2"')
    simulation = loop(fallen.replace("most = -0.4", "most = -1.9"), scene)
    while simulation.phase == "up":
        simulation.step(1)
    assert simulation.time == pytest.approx((2 * 0.2 / 9.81) ** 0.5, abs=0.005)
    speed_then = -((2 * 9.81 * 0.2) ** 0.5)
    assert simulation.figures()["reached_rad"] == pytest.approx(speed_then, abs=0.05)
    log = simulation.log()
    assert log["position/ball/z"][-1] == pytest.approx(simulation.data.body("ball").xpos[2])
    assert {"position/ball/x", "sensor/speed/0", "contact_force/lower"} <= set(log)
    simulation.step(1000)
    assert simulation.success, simulation.reason
    for wrong, wanted in (
        ("position/bal/z", "'position/bal/z': frame 'bal' does not exist; there are: .*ball"),
        ("position/ball/w", "frame 'ball/w' does not exist"),
        ("position/ball", "phase 'up': quantity 'position/ball' does not exist"),
        ("sensor/speed/7", "quantity 'sensor/speed/7' does not exist"),
        ("joint/j3", "joint 'j3' does not exist; there are: j1, j2"),
    ):
        with pytest.raises(Error, match=wanted):
            loop(fallen.replace("position/ball/z", wrong), scene)


def test_a_joint_rests_behind_its_brake_in_the_phases_that_say_so() -> None:
    stiff = 'frictionloss="0.1" solimpfriction="0.9999 0.9999 0.001 0.5 2"'
    rubbing = ARM.replace('axis="0 1 0"', f'axis="0 1 0" {stiff}')
    rubbing = rubbing.replace('ctrlrange="-1 1"', 'ctrlrange="-1 1" forcerange="-50 50"')
    braked = ROWS.replace('name = "up"', 'name = "rest"\nstack = "posture"\nseconds = 0.5\n'
                          'brakes = ["j1", "j2"]\n\n[[phase]]\nname = "up"')  # fmt: skip
    simulation = loop(braked, rubbing)
    simulation.step(200)
    assert simulation.phase == "rest"
    assert simulation.controller.torque.tolist() == [0.0, 0.0]
    assert abs(simulation.data.qvel).max() < 0.01
    simulation.step(300)
    assert simulation.phase == "up"
    assert abs(simulation.controller.torque).min() > 0.1


def test_what_is_saved_is_what_was_loaded(tmp_path: Path) -> None:
    for mission in (read(ROWS), Mission.load(mjcf.folder() / "missions" / "lift.toml")):
        mission.save(tmp_path / "copy.toml")
        copy = Mission.load(tmp_path / "copy.toml")
        assert copy.setup == mission.setup
        assert copy.rows == mission.rows
        assert copy.table() == mission.table()
    assert "trouble" in read(ROWS).toml()


def test_the_table_is_printed() -> None:
    text = read(ROWS).table()
    assert "1  up  [posture]  1 s\n     waves\n" in text
    assert "within 3 s: hold 0.5 s, then back to 'up', 2 times, then abort" in text
    assert "if q/j2 >= 2: ask 5 s, then lower" in text
    assert "lower goes to 'back'" in text


# up, aside, back: the rows stand in another order
AROUND = ROWS.replace("seconds = 1.0", 'seconds = 1.0\nnext = "aside"', 1).replace(
    "[[figure]]",
    '[[phase]]\nname = "aside"\nstack = "posture"\nseconds = 0.1\nnext = "back"\n\n[[figure]]',
    1,
)


def test_a_phase_goes_on_to_the_row_that_it_names(tmp_path: Path) -> None:
    with pytest.raises(Error, match="phase 'up', next: the rows behind it go round for ever"):
        read(AROUND)
    mission = read(AROUND.replace('name = "back"', 'name = "back"\nlast = true'))
    mission.save(tmp_path / "around.toml")
    assert Mission.load(tmp_path / "around.toml") == mission
    assert "1  up  [posture]  1 s  (then 'aside')\n" in mission.table()
    texts = [text.text or "" for text in drawn(mission, "text")]
    assert {"on to aside", "on to back"} <= set(texts)


def drawn(mission: Mission, element: str) -> list[ElementTree.Element]:
    """What its drawing has of this element of SVG."""
    return list(ElementTree.fromstring(mission.drawing()).iter(f"{{{SVG}}}{element}"))


def test_the_table_is_drawn() -> None:
    texts = [text.text or "" for text in drawn(read(ROWS), "text")]
    for wanted in (
        "1  up",
        "waves",
        "posture, 1 s",
        "q/j1 ≤ -0.45 for 0.1 s",
        "longer than 3 s: hold 0.5 s, back to up (2 times), end",
        "q/j2 ≥ 2: ask 5 s, lower",
        "posture, posture 0.2",
        "the end",
    ):
        assert wanted in texts
    # a way back to the first phase and one to the way to safety: as many junctions as troubles
    junctions = Counter(circle.get("fill") for circle in drawn(read(ROWS), "circle"))
    assert sorted(junctions.values()) == [1, 1, 1]  # and the end


@pytest.mark.parametrize("name", ["lift", "casualty", "crossing", "disposal"])
def test_a_drawing_has_every_phase_once_and_nothing_beside_the_page(name: str) -> None:
    mission = Mission.load(mjcf.folder() / "missions" / f"{name}.toml")
    page = ElementTree.fromstring(mission.drawing())
    width, height = float(page.attrib["width"]), float(page.attrib["height"])
    names = [text.text for text in drawn(mission, "text") if text.get("class") == "name"]
    wanted = [f"{k}  {row.name}" for k, row in enumerate(mission.rows.phases, 1)]
    assert names == [name, *wanted]
    numbers = [
        tuple(map(float, pair.split(",")))
        for line in drawn(mission, "polyline")
        for pair in line.attrib["points"].split()
    ]
    assert all(0 < x < width and 0 < y < height for x, y in numbers)
    # no bar lies on another: those of a column end before the next begins
    bars: dict[float, list[tuple[float, float]]] = {}
    for line in drawn(mission, "polyline"):
        (x, upper), (_, lower) = (map(float, p.split(",")) for p in line.attrib["points"].split())
        if line.get("stroke-width") == "3" and upper < lower:
            bars.setdefault(x, []).append((upper, lower))
    for column in bars.values():
        ends = [edge for bar in sorted(column) for edge in bar]
        assert ends == sorted(ends)


def test_the_table_of_the_docs_is_the_missions_own(root: Path) -> None:
    mission = Mission.load(root / "models" / "missions" / "casualty.toml")
    for kind, text in (("svg", mission.drawing()), ("txt", mission.table())):
        assert (root / "docs" / f"casualty.{kind}").read_text(encoding="utf-8") == text


def test_a_user_adds_a_phase_as_the_docs_say(root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(root)
    page = (root / "docs" / "loop.md").read_text(encoding="utf-8")
    found = re.search(r"```python\n([^`]*a phase of your own[^`]*)```", page)
    assert found
    assert len([line for line in found[1].splitlines() if line.strip()]) <= 10
    names: dict[str, hurcules.Simulation] = {}
    exec(found[1], names)
    simulation = names["simulation"]
    assert simulation.phases[:2] == ["wait", "settle"]
    simulation.step(1990)
    assert simulation.phase == "wait"
    simulation.step(20)
    assert simulation.phase == "settle"


def test_a_user_adds_a_phase() -> None:
    mission = read(ROWS)
    wait = hurcules.Phase(name="wait", stack="posture", seconds=0.5)
    rows = hurcules.MissionTable(
        phases=[*mission.rows.phases, wait], safety="back", measures=mission.rows.measures
    )
    assert Mission(mission.setup, rows).rows.phases[-1].name == "wait"


def test_rows_of_another_table_and_monitors_of_many_phases(tmp_path: Path) -> None:
    (tmp_path / "wave.toml").write_text(ROWS)
    own = """
[mission]
name = "twice"
safety = "back"

[[phase]]
name = "before"
stack = "posture"
seconds = 1.0
last = true

[[phase]]
include = "wave.toml"
rows = ["up", "back"]

[[monitor]]
when = "q/j1 >= 1.5"
do = ["back to up", "abort"]
phases = ["before", "up"]
"""
    (tmp_path / "twice.toml").write_text(own)
    mission = Mission.load(tmp_path / "twice.toml")
    rows = mission.rows.phases
    assert [row.name for row in rows] == ["before", "up", "back"]
    assert rows[1:] != read(ROWS).rows.phases
    assert [len(row.troubles) for row in rows] == [1, 2, 0]
    assert rows[0].last and not rows[1].last
    mission.rows.phases[0].note = 'two lines\n"of" C:\\text, \t\x01\x7f ü'
    mission.save(tmp_path / "saved.toml")
    assert Mission.load(tmp_path / "saved.toml") == mission
    for old, new, wanted in (
        (
            'phases = ["before", "up"]',
            'phases = ["down"]',
            "no phase 'down'; there are: before",
        ),
        ('rows = ["up", "back"]', 'rows = ["up"]', "the names of two of its phases"),
        ('rows = ["up", "back"]', 'rows = ["back", "up"]', "'back' comes after 'up'"),
        ("wave.toml", "wvae.toml", "wvae.toml"),
    ):
        (tmp_path / "twice.toml").write_text(own.replace(old, new))
        with pytest.raises(Error) as raised:
            Mission.load(tmp_path / "twice.toml")
        assert wanted in str(raised.value)


def test_conditions_and_reactions_are_read_from_text() -> None:
    one = hurcules.Condition.read("monitor/static_margin_m <= 0.05 for 0.3 s")
    assert (one.quantity, one.above, one.value) == ("monitor/static_margin_m", False, 0.05)
    assert one.seconds == 0.3
    two = hurcules.Reaction.read("back to set down, 3 times")
    assert (two.kind, two.phase, two.times) == ("back", "set down", 3)
    for text in ("", "q/j1 > 3", "q/j1 >= much"):
        with pytest.raises(Error, match="wanted 'QUANTITY >= NUMBER'"):
            hurcules.Condition.read(text)
    for text in ("", "retreat", "hold", "lower, many times"):
        with pytest.raises(Error, match="wanted 'back to PHASE'"):
            hurcules.Reaction.read(text)


@pytest.mark.parametrize(
    "old, new, wanted",
    [
        (
            'stack = "posture"\nposture',
            'stack = "pasture"\nposture',
            "stack 'pasture' does not exist",
        ),
        ("j2 = 0.3", "j9 = 0.3", "coordinate 'j9' does not exist; there are: j1, j2"),
        ("q/j1 <= -0.45", "q/j7 <= -0.45", "quantity 'q/j7' does not exist"),
        ("within = 3.0", "within = 0.0", "within wants a time above 0"),
        ("back to up", "back to top", "phase 'top' does not exist; there are: up, back"),
        (', "abort"]', "]", "a way to safety"),
        ("lead.posture", "lead.pasture", "channel 'pasture' does not exist"),
        ("rate = [0.5, 0.0]", "rate = [0.5]", "wants 2 finite numbers, 1 came"),
        ("rate = [0.5, 0.0]", "rate = [2.5, 0.0]", "at most 2 a second, a rate of 2.5 came"),
        (", way = 0.2", "", "never ends"),
        ("seconds = 1.0", "secnds = 1.0", "no entry 'secnds'"),
        ('safety = "back"', 'safety = "home"', "phase 'home' does not exist"),
        ('take = "smallest"', 'take = "least"', "take 'least' does not exist"),
        (
            "rate = [0.5, 0.0], way = 0.2",
            'by = [0.0, 0.0], to = ["q/j1"]',
            "quantities to go to, 1",
        ),
        ("rate = [0.5, 0.0]", 'rate = [0.5, 0.0], to = ["", "q/j1"]', "quantities to go to, 2"),
        ("way = 0.2", 'hold = "q/j1"', "a span above 0"),
        ("way = 0.2", 'hold = "q/j9", span = 0.1, way = 0.2', "quantity 'q/j9' does not exist"),
        ("seconds = 1.0", 'seconds = 1.0\nbrakes = ["j1"]', "brake 'j1' does not exist"),
        ("way = 0.2", "way = 0.2, brake = true", "brake wants a quantity to hold"),
        (
            "way = 0.2",
            'way = 0.2, hold = "q/j1", span = 0.1, brake = true',
            "leads no joints whose brakes",
        ),
    ],
)
def test_a_mistake_is_told_with_its_row(old: str, new: str, wanted: str) -> None:
    assert old in ROWS
    with pytest.raises(Error, match=r"phase|figure|safety") as raised:
        loop(ROWS.replace(old, new, 1))
    assert wanted in str(raised.value)


def test_a_file_that_is_none_is_told(tmp_path: Path) -> None:
    with pytest.raises(Error, match=r"nothing\.toml"):
        Mission.load(tmp_path / "nothing.toml")
    (tmp_path / "bad.toml").write_text("[mission")
    with pytest.raises(Error, match=r"bad\.toml"):
        Mission.load(tmp_path / "bad.toml")


def test_included_rows_bring_their_monitors_and_figures_are_included_by_name(
    tmp_path: Path,
) -> None:
    watched = """
[[monitor]]
when = "q/j1 >= 1.5"
do = ["abort"]
phases = ["up", "back"]

[[figure]]
name = "j1"
quantity = "q/j1"
most = 2.0
"""
    (tmp_path / "wave.toml").write_text(ROWS + watched)
    own = """
[mission]
name = "again"
safety = "back"

[[phase]]
include = "wave.toml"
rows = ["up", "back"]

[[figure]]
include = "wave.toml"
names = ["NAME"]
"""
    (tmp_path / "again.toml").write_text(own.replace("NAME", "j1"))
    mission, whole = Mission.load(tmp_path / "again.toml"), Mission.load(tmp_path / "wave.toml")
    assert mission.rows.phases == whole.rows.phases[:2]
    assert [row.troubles[-1].when.quantity for row in mission.rows.phases] == ["q/j1", "q/j1"]
    assert [(one.name, one.most) for one in mission.rows.measures] == [("j1", 2.0)]
    (tmp_path / "again.toml").write_text(own.replace("NAME", "j2"))
    with pytest.raises(Error, match=r"figure 1, include of 'wave.toml': figure 'j2' does not .*j1"):
        Mission.load(tmp_path / "again.toml")
