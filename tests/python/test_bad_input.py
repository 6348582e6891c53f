"""Wrong input through the Python face: one clear line each, with what was wanted and what came.

The command line's own lines are in test_cli.py, the solver's and the robot's own cases in theirs.
"""

from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import mujoco
import numpy as np
import pytest

import hurcules
from hurcules import rhqp

ONE, NAN = np.ones(1), np.array([np.nan])
ARM = """<mujoco><worldbody><body><joint name="elbow" range="-60 60"/><geom size="0.1"/>
<site name="hand"/></body></worldbody></mujoco>"""


def robot() -> hurcules.Robot:
    return hurcules.Robot(mujoco.MjModel.from_xml_string(ARM))


def simulation() -> hurcules.Simulation:
    return hurcules.Simulation("stretch", record=False)


def arm_model() -> mujoco.MjModel:
    text = ARM.replace("</mujoco>", '<actuator><motor joint="elbow"/></actuator></mujoco>')
    return mujoco.MjModel.from_xml_string(text)


def whole_body() -> hurcules.WholeBodyController:
    arm = hurcules.Robot(arm_model())
    hand = hurcules.PositionTask("hand", arm, "hand")
    return hurcules.WholeBodyController(arm, [hand], {"hand": hurcules.Twist(hand, 1.0)})


def controller(method: str) -> Any:
    options = hurcules.VelocityControllerOptions(solver=rhqp.SolverOptions(method=method))
    return hurcules.VelocityController(robot(), options)


CASES: dict[str, tuple[Callable[[], Any], str]] = {
    "shape of A": (lambda: rhqp.Level(np.ones((2, 3)), ONE, ONE), r"A .*\(1, 3\).* \(2, 3\)"),
    "NaN in a bound": (lambda: rhqp.Level(np.ones((1, 1)), NAN, ONE), "row 0"),
    "infinite A": (lambda: rhqp.Level(np.full((1, 1), np.inf), ONE, ONE), "row 0"),
    "lower above upper": (lambda: rhqp.Bounds(2 * ONE, ONE), "row 0"),
    "negative rho": (lambda: rhqp.Level(np.ones((1, 1)), ONE, ONE, rho=-1.0), "rho"),
    "unknowns of a level": (
        lambda: rhqp.Solver(2).solve([rhqp.Bounds(ONE, ONE)]),
        r"length 2 .* 1$",
    ),
    "method of the solver": (lambda: controller("magic"), "magic"),
    "mission": (lambda: hurcules.Simulation("nowhere"), "'nowhere' does not exist; .* stretch"),
    "model beside a mission": (
        lambda: hurcules.Simulation("stretch", model=arm_model()),
        "'stretch' has a model and a controller of its own: wanted neither",
    ),
    "setup and rows of a mission": (
        lambda: hurcules.Mission(hurcules.lift.mission().rows, hurcules.lift.mission().setup),  # type: ignore[arg-type]
        "Mission: setup wants a MissionSetup",
    ),
    "log of unequal columns": (
        lambda: simulation().replay(
            {f"command/{name}": ONE for name in simulation().command_names} | {"time": np.zeros(2)}
        ),
        r"\(1,\) of 'command/.*, \(2,\) of 'time': its columns want one length",
    ),
    "model in place of a mission": (
        lambda: hurcules.Simulation(arm_model()),  # type: ignore[arg-type]
        r"by keyword, Simulation\(model=\.\.\., controller=\.\.\.\)",
    ),
    "model in place of a mission, controller of a seed": (
        lambda: hurcules.Simulation(arm_model(), robot()),  # type: ignore[arg-type]
        r"^mission: wanted its name",
    ),
    "period above the horizon": (
        lambda: hurcules.VelocityController(
            robot(), hurcules.VelocityControllerOptions(dt=0.1, gain=1.0)
        ),
        r"one control period dt.* got 0\.05 s at dt = 0\.1 s",
    ),
    "period": (
        lambda: hurcules.VelocityController(robot(), hurcules.VelocityControllerOptions(dt=0.0)),
        r"dt wants a positive time \[s\], 0 came",
    ),
    "stiffness": (
        lambda: hurcules.AccelerationController(
            robot(), hurcules.AccelerationControllerOptions(stiffness=-1.0)
        ),
        r"stiffness wants a number >= 0 \[1/s\^2\], -1 came",
    ),
    "margin of distances": (
        lambda: hurcules.self_collision(robot(), margin=0.2),
        r"margin .* below `most`, 0.15 m, 0.2 came",
    ),
    "target of a task": (
        lambda: hurcules.PositionTask("hand", robot(), "hand").set_target([0.0, np.nan, 0.0]),
        "target of task 'hand' wants finite numbers, number 1 is nan",
    ),
    "rows of a task": (
        lambda: hurcules.CustomTask("own", robot(), 0, lambda _: ([], [])),
        "rows of task 'own' want a number >= 1, 0 came",
    ),
    "start of a reset": (
        lambda: hurcules.Simulation(model=arm_model(), controller=whole_body()).reset(
            0, start=np.zeros(9)
        ),
        "wants 1 numbers?, 9 came",
    ),
    "obstacle": (
        lambda: hurcules.obstacles(robot(), bodies=["crate"]),
        "body 'crate' does not exist; there are: world",
    ),
    "method of a mission": (
        lambda: hurcules.Simulation("lift", method="magic"),
        "method 'magic' does not exist; .* lexicographic",
    ),
    "method beside a controller": (
        lambda: hurcules.Simulation(model=arm_model(), controller=whole_body(), method="hqp"),
        "method: your controller has its own, got 'hqp'",
    ),
    "seed": (lambda: hurcules.Simulation(seed=-1), "got -1"),
    "seed that is no number": (lambda: hurcules.Simulation(seed="x"), "got 'x'"),  # type: ignore[arg-type]
    "seed with a fraction": (lambda: simulation().reset(1.5), "whole number .* got 1.5"),  # type: ignore[arg-type]
    "negative seed of a reset": (lambda: simulation().reset(-1), "whole number .* got -1"),
    "variation": (lambda: hurcules.Simulation(variation=np.nan), "variation: .*>= 0, got nan"),
    "variation that is no number": (lambda: hurcules.Simulation(variation="x"), ">= 0, got 'x'"),  # type: ignore[arg-type]
    "parameter that is no pair": (
        lambda: hurcules.Simulation("casualty", parameters={"offset": 1}),
        "offset wants two numbers, ahead and to the left, got 1",
    ),
    "time that is none": (lambda: hurcules.Simulation(max_seconds=np.nan), "above 0 .*got nan"),
    "time below zero": (lambda: hurcules.Simulation(max_seconds=-1.0), "max_seconds: .*got -1"),
    "sensors that are none": (
        lambda: hurcules.Simulation(sensors=True),  # type: ignore[arg-type]
        "sensors: wanted SensorOptions, got True",
    ),
    "controller that is none": (
        lambda: hurcules.Simulation(model=arm_model(), controller=robot()),  # type: ignore[arg-type]
        r"wanted a WholeBodyController, got Robot\(1",
    ),
    "model of a simulation": (
        lambda: hurcules.Simulation(model=3, controller=whole_body()),  # type: ignore[arg-type]
        "model: wanted a mujoco.MjModel or the path of one, got 3",
    ),
    "specification of a simulation": (
        lambda: hurcules.Simulation(model=mujoco.MjSpec(), controller=whole_body()),  # type: ignore[arg-type]
        r"got <mujoco.* its compile\(\) gives one",
    ),
    "model of dm_control": (
        lambda: hurcules.Simulation(
            model=SimpleNamespace(ptr=arm_model()), controller=whole_body()
        ),  # type: ignore[arg-type]
        "its ptr is one",
    ),
    "physics of dm_control": (
        lambda: hurcules.Simulation(
            model=SimpleNamespace(model=SimpleNamespace(ptr=arm_model())), controller=whole_body()
        ),  # type: ignore[arg-type]
        "its model.ptr is one",
    ),
    "robot of a Physics of dm_control": (
        lambda: hurcules.Robot(SimpleNamespace(model=SimpleNamespace(ptr=arm_model()))),  # type: ignore[arg-type]
        "a SimpleNamespace came; its model.ptr is one$",
    ),
    "robot of an element of dm_control": (
        lambda: hurcules.Robot(SimpleNamespace(model="arm", to_xml_string=str)),  # type: ignore[arg-type]
        r"came; mujoco.MjModel.from_xml_string\(its to_xml_string\(\), .* makes one$",
    ),
    "model as a mission": (
        lambda: hurcules.Simulation("my/arm.xml", controller=whole_body()),
        r"a model of your own goes by keyword, .*; got 'my/arm.xml'",
    ),
    "sensors that it has not": (
        lambda: hurcules.Simulation(
            model=arm_model(), controller=whole_body(), sensors=hurcules.sensors.realistic()
        ),
        r"sensors: the model lacks .*imu_rate.* range \(a site 'lidar'\); .*realistic\(robot\)",
    ),
    "path of a simulation": (
        lambda: hurcules.Simulation(model="/no/such.xml", controller=whole_body()),
        "cannot read /no/such.xml",
    ),
    "half a tick": (lambda: simulation().step(1.5), "whole number of ticks, got 1.5"),  # type: ignore[arg-type]
    "words in a command": (
        lambda: hurcules.Simulation(model=arm_model(), controller=whole_body()).step(
            1, {"hand": "up"}
        ),
        "channel 'hand': wanted numbers, got 'up'",
    ),
    "a task in place of levels": (
        lambda: hurcules.WholeBodyController(robot(), hurcules.PostureTask("posture", robot())),
        "levels want a Stack or a list of tasks, a PostureTask came",
    ),
    "scale of a channel": (
        lambda: hurcules.Twist(hurcules.PostureTask("posture", robot()), "fast"),  # type: ignore[arg-type]
        r"scale of a channel wants real numbers of shape a number or \(k,\)",
    ),
    "mask of a batch": (
        lambda: hurcules.SimulationBatch(simulation(), 2, 1).step(1, None, [True]),
        "one entry for each of its 2 simulations, 1 came",
    ),
    "scene": (lambda: hurcules.models.load(scene="moon"), "'moon' does not exist; .* flat"),
    "robot": (lambda: hurcules.models.load("nobody"), "'nobody' does not exist; .* rescue"),
    "shape of a command": (lambda: simulation().step(1, np.zeros(3)), r"\(11,\), got \(3,\)$"),
    "NaN in a command": (lambda: simulation().step(1, np.full(11, np.nan)), "finite"),
    "ticks": (lambda: simulation().step(-1), "ticks >= 0, got -1"),
    "state of another run": (lambda: simulation().restore(np.zeros(5)), "state|snapshot"),
    "frame": (lambda: robot().position("foot"), "'foot'.*hand"),
    "frame of a task": (lambda: hurcules.PositionTask("t", robot(), "foot"), "'foot'.*hand"),
    "joint": (lambda: robot().coordinate("knee"), "'knee'.*elbow"),
    "keyframe": (lambda: robot().set_keyframe("sitting"), "sitting"),
    "shape of a configuration": (lambda: robot().set_configuration(np.zeros(4)), r"\b1\b.*\b4\b"),
    "NaN in a configuration": (lambda: robot().set_configuration(NAN), "finite|nan|NaN"),
    "model that is none": (lambda: hurcules.Robot(3.0), "float"),  # type: ignore[call-overload]
    "file that is not there": (lambda: hurcules.Robot("/no/such.xml"), "such.xml"),
}


@pytest.mark.parametrize("case", CASES)
def test_wrong_input_gives_one_clear_line(case: str) -> None:
    call, says = CASES[case]
    with pytest.raises(hurcules.Error, match=says) as caught:
        call()
    assert "\n" not in str(caught.value)
    assert len(str(caught.value)) < 400


def test_broken_mjcf_gives_mujocos_text_and_the_file(tmp_path: Path) -> None:
    path = tmp_path / "broken.xml"
    path.write_text("<mujoco><worldbdy/></mujoco>")
    with pytest.raises(hurcules.Error, match="worldbdy"):
        hurcules.Robot(path)


def test_tasks_are_not_ordered_by_comparison() -> None:
    arm = robot()
    a, b = hurcules.PostureTask("a", arm), hurcules.PositionTask("b", arm, "hand")
    with pytest.raises(TypeError, match=r"Stack\(\[a, b, c\]\)"):
        assert a < b
    assert repr(hurcules.Stack([a, b])) == "a < b"


def test_a_point_of_another_size_is_told() -> None:
    # pybind11's list of signatures came
    robot = hurcules.Robot(hurcules.models.load("rescue", "flat"))
    for task in (
        hurcules.GazeTask("look", robot, "head_wide"),
        hurcules.PoseTask("hand", robot, "L_tcp"),
    ):
        with pytest.raises(hurcules.Error, match=r"target of task '\w+' wants 3 numbers, 2 came"):
            task.set_target([1.0, 2.0])
        with pytest.raises(hurcules.Error, match=r"real numbers of shape \(3,\)"):
            task.set_target("ahead")


@pytest.mark.parametrize(
    ("thing", "name", "value", "wanted"),
    [
        (lambda: hurcules.Phase(name="go", stack="arms"), "seconds", "2", "float, got '2'"),
        (lambda: hurcules.Phase(name="go", stack="arms"), "leads", 3, "Sequence[Lead], got 3"),
        (lambda: hurcules.Lead(channel="arm"), "rate", "up", "numbers (m,), got 'up'"),
        (hurcules._core.SimulationOptions, "seed", -1, "int, got -1"),
        (lambda: hurcules.PositionTask("hand", robot(), "hand"), "max_lead", None, "float, got "),
    ],
)
def test_an_attribute_says_what_it_wants_and_what_came(
    thing: Callable[[], Any], name: str, value: object, wanted: str
) -> None:
    made = thing()
    before = getattr(made, name)
    with pytest.raises(hurcules.Error) as told:
        setattr(made, name, value)
    assert f": {name} wants {wanted}" in str(told.value)
    assert np.array_equal(getattr(made, name), before)
    setattr(made, name, before)


def test_no_attribute_answers_with_a_list_of_overloads() -> None:
    """The setters of all compiled classes, by what they say of themselves."""
    said = {}
    for kind in vars(hurcules._core).values():
        for name, member in vars(kind).items() if isinstance(kind, type) else ():
            if isinstance(member, property) and member.fset:
                with pytest.raises(hurcules.Error) as told:
                    member.fset(object(), object())
                said[kind.__name__, name] = str(told.value)
    assert len(said) > 150
    for (owner, name), text in said.items():
        assert text.startswith(f"{owner}: {name} wants ") and "typing" not in text, text
