"""Tasks and answers that users of other packages look for, on arms written here.

Strategy: the short programs that the documentation promises, counted in lines; weights, gains,
damping and tasks in Python against what a hand can reckon; numbers that say nothing are refused, or
the controller brakes within its limit and names them. Not tested here: derivatives of the tasks
(tests/cpp/tasks/every_task_test.cpp).
"""

from __future__ import annotations

import inspect

import mujoco
import numpy as np
import pytest

import hurcules
from hurcules import rhqp

ARM = """
<mujoco>
  <compiler angle="radian"/>
  <default><joint range="-2.6 2.6" limited="true"/><geom size="0.03"/></default>
  <worldbody>
    {arms}
  </worldbody>
</mujoco>
"""


def arm(side: str, y: float) -> str:
    """Six joints and a hand."""
    return f"""<body pos="0 {y} 0.8"><joint name="{side}1" axis="0 0 1"/><geom/>
      <body><joint name="{side}2" axis="0 1 0"/><geom/>
        <body pos="0.35 0 0"><joint name="{side}3" axis="0 1 0"/><geom/>
          <body pos="0.3 0 0"><joint name="{side}4" axis="1 0 0"/><geom/>
            <body><joint name="{side}5" axis="0 1 0"/><geom/>
              <body><joint name="{side}6" axis="1 0 0"/><geom pos="0.1 0 0"/>
                <site name="{side}_hand" pos="0.1 0 0"/></body></body></body></body></body>
      </body>"""


@pytest.fixture
def model() -> mujoco.MjModel:
    return mujoco.MjModel.from_xml_string(ARM.format(arms=arm("l", 0.2) + arm("r", -0.2)))


def lines(function: object) -> int:
    """Statements of a function, a line each."""
    body = inspect.getsource(function).splitlines()[1:]
    return sum(bool(line.strip()) and not line.strip().startswith(('"""', "#")) for line in body)


def lead_a_pose(model: mujoco.MjModel, position: np.ndarray, turn: np.ndarray) -> hurcules.Robot:
    robot = hurcules.Robot(model)
    hand = hurcules.PoseTask("hand", robot, "l_hand")
    hand.set_target(position, turn)
    controller = hurcules.VelocityController(robot)
    controller.set_stack(hurcules.Stack([hand, hurcules.PostureTask("posture", robot)]))
    for _ in range(8000):
        controller.step(robot)
    return robot


def lead_two_hands(model: mujoco.MjModel, targets: dict[str, np.ndarray]) -> hurcules.Robot:
    robot = hurcules.Robot(model)
    hands = [hurcules.PositionTask(name, robot, name) for name in targets]
    for hand in hands:
        hand.set_target(targets[hand.name])
    posture = hurcules.PostureTask("posture", robot)
    controller = hurcules.VelocityController(robot)
    controller.set_stack(hurcules.Stack([*hands, posture]))
    for _ in range(5000):
        controller.step(robot)
    return robot


def reachable(model: mujoco.MjModel, frame: str, seed: int) -> tuple[np.ndarray, np.ndarray]:
    robot = hurcules.Robot(model)
    robot.set_configuration(np.random.default_rng(seed).uniform(-0.8, 0.8, robot.size))
    return robot.position(frame), robot.orientation(frame)


def test_a_pose_takes_eight_lines(model: mujoco.MjModel) -> None:
    assert lines(lead_a_pose) <= 8
    for seed in range(3):
        position, turn = reachable(model, "l_hand", seed)
        robot = lead_a_pose(model, position, turn)
        assert np.linalg.norm(robot.position("l_hand") - position) < 1e-5
        assert np.abs(robot.orientation("l_hand") - turn).max() < 1e-4


def test_two_hands_take_twelve_lines(model: mujoco.MjModel) -> None:
    assert lines(lead_two_hands) <= 12
    names = ["l_hand", "r_hand"]
    targets = {name: reachable(model, name, 5)[0] for name in names}
    robot = lead_two_hands(model, targets)
    for name in names:
        assert np.linalg.norm(robot.position(name) - targets[name]) < 1e-4


def test_a_hand_keeps_its_pose_in_the_other_hand(model: mujoco.MjModel) -> None:
    robot = hurcules.Robot(model)
    robot.set_configuration([0.3, 0.4, -0.9, 0.1, 0.6, 0.0, -0.3, 0.4, -0.9, -0.1, 0.6, 0.0])
    held = hurcules.RelativePoseTask("held", robot, "l_hand", "r_hand")
    carry = hurcules.PositionTask("carry", robot, "r_hand")
    controller = hurcules.VelocityController(robot)
    controller.set_stack(hurcules.Stack([held, carry]))
    before = robot.position("r_hand")
    for _ in range(2000):
        carry.advance([0.0, 0.0, 0.05], 1e-3)
        controller.step(robot)
        held.update(robot)
        assert np.abs(held.error).max() < 1e-4
    np.testing.assert_allclose(robot.position("r_hand") - before, [0.0, 0.0, 0.1], atol=1e-3)


def settle(robot: hurcules.Robot, stack: list[object], ticks: int = 6000) -> None:
    controller = hurcules.VelocityController(robot)
    controller.set_stack(hurcules.Stack(stack))
    for _ in range(ticks):
        controller.step(robot)


@pytest.mark.parametrize("by", ["velocities", "accelerations"])
def test_weights_share_what_cannot_be_met(model: mujoco.MjModel, by: str) -> None:
    # two wishes for one coordinate: the squares of w_i (q - q_i) are least at their weighted mean
    robot = hurcules.Robot(model, joints=["l1"])
    near, far = (hurcules.PostureTask(name, robot) for name in ("near", "far"))
    near.set_target([0.0])
    far.set_target([0.1])
    near.set_weights([1.0])
    far.set_weights([2.0])
    make = hurcules.VelocityController if by == "velocities" else hurcules.AccelerationController
    controller = make(robot)
    controller.set_stack(hurcules.Stack([hurcules.StackLevel("both", [near, far], rho=0.0)]))
    for _ in range(6000):
        controller.step(robot)
    assert robot.configuration[0] == pytest.approx(0.1 * 4 / 5, abs=1e-3)
    far.set_weights([0.0])
    for _ in range(6000):
        controller.step(robot)
    assert robot.configuration[0] == pytest.approx(0.0, abs=1e-3)


@pytest.mark.parametrize("make", [hurcules.VelocityController, hurcules.AccelerationController])
def test_a_loop_may_give_its_tasks_in_each_tick(model: mujoco.MjModel, make: type) -> None:
    # as mink and Pink do; each time it went over to a new stack, and never arrived
    robots = [hurcules.Robot(model) for _ in range(2)]
    target, _ = reachable(model, "l_hand", 1)
    for robot, always in zip(robots, (False, True), strict=True):
        hand = hurcules.PositionTask("hand", robot, "l_hand")
        tasks = [hand, hurcules.PostureTask("posture", robot)]
        hand.set_target(target)
        controller = make(robot)
        controller.set_stack(tasks)
        for _ in range(3000):
            if always:
                controller.set_stack(tasks)
            controller.step(robot)
        assert hand.error == pytest.approx(np.zeros(3), abs=1e-4)
    np.testing.assert_array_equal(robots[0].configuration, robots[1].configuration)


def test_one_number_is_for_all_rows(model: mujoco.MjModel) -> None:
    robot = hurcules.Robot(model)
    posture = hurcules.PostureTask("posture", robot)
    posture.set_weights(0.3)
    assert posture.weights == pytest.approx(np.full(robot.size, 0.3))
    limits = hurcules.JointLimits("limits", robot)
    limits.set_max_velocities(0.7)
    assert limits.max_velocity == pytest.approx(np.full(robot.size, 0.7))


def test_a_gain_is_the_rate_of_its_row(model: mujoco.MjModel) -> None:
    robot = hurcules.Robot(model, joints=["l1", "r1"])
    posture = hurcules.PostureTask("posture", robot)
    posture.set_target([0.01, 0.01])
    posture.set_gain([2.0, 10.0])
    settle(robot, [posture], 300)
    left = 0.01 - robot.configuration
    # the acceleration limit of the first ticks costs a little
    assert left[0] / 0.01 == pytest.approx(np.exp(-2.0 * 0.3), abs=0.02)
    assert left[1] / 0.01 == pytest.approx(np.exp(-10.0 * 0.3), abs=0.02)


def test_damping_brings_the_rest_to_rest(model: mujoco.MjModel) -> None:
    robot = hurcules.Robot(model)
    hand = hurcules.PositionTask("hand", robot, "l_hand")
    hand.set_target(reachable(model, "l_hand", 2)[0])
    damping = hurcules.DampingTask("damping", robot)
    controller = hurcules.VelocityController(robot)
    controller.set_stack(hurcules.Stack([hand, damping]))
    for _ in range(5000):
        controller.step(robot)
    assert np.linalg.norm(hand.error) < 1e-4
    assert np.abs(controller.velocity).max() < 1e-3
    assert robot.configuration[6:] == pytest.approx(0.0, abs=1e-12), "the other arm moved"


def test_a_task_in_python_is_a_task(model: mujoco.MjModel) -> None:
    robot = hurcules.Robot(model)

    def height(robot: hurcules.Robot) -> tuple[list[float], np.ndarray]:
        return [robot.position("l_hand")[2]], robot.position_jacobian("l_hand")[2:]

    task = hurcules.CustomTask("height", robot, 1, height)
    task.set_target([0.6])
    settle(robot, [task, hurcules.PostureTask("posture", robot)])
    assert robot.position("l_hand")[2] == pytest.approx(0.6, abs=1e-4)
    with pytest.raises(hurcules.Error, match=r"'wrong': jacobian wants shape \(1, 12\), \(1, 3\)"):
        hurcules.CustomTask("wrong", robot, 1, lambda robot: ([0.0], np.zeros((1, 3))))
    with pytest.raises(hurcules.Error, match=r"task 'wrong': .*value, jacobian"):
        hurcules.CustomTask("wrong", robot, 1, lambda robot: 1.0)
    with pytest.raises(ZeroDivisionError):
        hurcules.CustomTask("wrong", robot, 1, lambda robot: 1 / 0)


def test_tasks_and_coordinates_say_their_unit() -> None:
    model = mujoco.MjModel.from_xml_string(
        """<mujoco><worldbody><body name="cart"><joint name="rail" type="slide" axis="1 0 0"/>
        <geom size="0.1"/><body name="arm"><joint name="turn" axis="0 1 0"/>
        <geom size="0.1" pos="0 0 0.5"/></body></body></worldbody></mujoco>"""
    )
    robot = hurcules.Robot(model)
    floating = hurcules.Robot(mujoco.MjModel.from_xml_string(FREE), floating=True)
    assert [one.unit for one in robot.coordinates] == ["m", "rad"]
    assert [one.unit for one in floating.coordinates] == ["m"] * 3 + ["rad"] * 4

    def unit(*coordinates: str) -> str:
        return hurcules.PostureTask("posture", robot, coordinates).unit

    assert (unit("rail"), unit("turn"), unit()) == ("m", "rad", "m and rad")
    assert hurcules.PositionTask("arm", robot, "arm").unit == "m"
    assert hurcules.OrientationTask("arm", robot, "arm").unit == "rad"
    area = hurcules.CustomTask(
        "area", robot, 1, lambda robot: (robot.configuration[:1], np.eye(1, 2)), unit="m^2"
    )
    assert area.unit == "m^2"
    posture = hurcules.PostureTask("base", robot, ["rail"])
    controller = hurcules.VelocityController(robot)
    controller.set_stack(hurcules.Stack([hurcules.DampingTask("held", robot), posture]))
    posture.set_target([2.0])
    controller.step(robot)
    assert "base: 2 m short" in "\n".join(
        str(one) for level in controller.diagnostics(robot) for one in level.shortfalls
    )


def test_a_jacobian_of_the_wrong_sign_is_told(model: mujoco.MjModel) -> None:
    robot = hurcules.Robot(model)

    def height(sign: float) -> hurcules.CustomTask:
        rows = slice(2, 3)
        return hurcules.CustomTask(
            "height",
            robot,
            1,
            lambda robot: (
                robot.position("l_hand")[rows],
                sign * robot.position_jacobian("l_hand")[rows],
            ),
        )

    before = robot.qpos.copy()
    hurcules.check_jacobian(height(1.0), robot)
    words = r"task 'height': row 0 of its Jacobian has (-?[\d.]+) at coordinate '\w+', where its"
    with pytest.raises(hurcules.Error, match=words):
        hurcules.check_jacobian(wrong := height(-1.0), robot)
    np.testing.assert_array_equal(robot.qpos, before)
    np.testing.assert_array_equal(wrong.value, robot.position("l_hand")[2:])


def test_a_class_of_tasks_whose_measuring_nobody_would_ask_is_refused(
    model: mujoco.MjModel,
) -> None:
    words = r"class Mine: a PositionTask is measured in C\+\+, .* for 'error'; CustomTask"
    with pytest.raises(hurcules.Error, match=words):
        type("Mine", (hurcules.PositionTask,), {"error": property(lambda self: np.zeros(3))})
    with pytest.raises(hurcules.Error, match=r"for it; CustomTask\(name, robot, rows, function\)"):
        type("Mine", (hurcules.Task,), {})

    class Height(hurcules.CustomTask):
        def __init__(self, name: str, robot: hurcules.Robot) -> None:
            super().__init__(name, robot, 1, self.measure)

        def measure(self, robot: hurcules.Robot) -> tuple[np.ndarray, np.ndarray]:
            return robot.position("l_hand")[2:], robot.position_jacobian("l_hand")[2:]

    robot = hurcules.Robot(model)
    assert Height("height", robot).value == robot.position("l_hand")[2]


def test_manipulability_is_kept_above_a_bound(model: mujoco.MjModel) -> None:
    # a hand led to the end of its reach stops where the arm would get nearer to a singularity
    def lead(*above: hurcules.Task) -> hurcules.Robot:
        robot = hurcules.Robot(model)
        robot.set_configuration([0.3, 0.4, -0.9, 0.1, 0.6, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
        for task in above:
            task.hold(robot)
        hand = hurcules.PositionTask("hand", robot, "l_hand")
        hand.set_target([2.0, 0.2, 0.8])
        settle(robot, [*above, hand], 4000)
        return robot

    def volume(robot: hurcules.Robot) -> float:
        J = robot.position_jacobian("l_hand")
        return float(np.sqrt(np.linalg.det(J @ J.T)))

    agile = hurcules.ManipulabilityTask("agile", hurcules.Robot(model), "l_hand")
    agile.set_interval([0.0], [np.inf])  # of what it has where it is held
    start = hurcules.Robot(model)
    start.set_configuration([0.3, 0.4, -0.9, 0.1, 0.6, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
    assert volume(lead()) < 0.2 * volume(start)
    kept = lead(agile)
    assert volume(kept) > 0.99 * volume(start)
    assert agile.value[0] == pytest.approx(volume(kept), rel=1e-3)


@pytest.mark.parametrize("task", [hurcules.PositionTask, hurcules.PoseTask, hurcules.AngleTask])
def test_a_task_wants_a_frame_that_moves(model: mujoco.MjModel, task: type) -> None:
    left = hurcules.Robot(model, joints=[f"l{i}" for i in range(1, 7)])
    with pytest.raises(hurcules.Error, match=r"'hand'.* none moves 'r_hand'"):
        task("hand", left, "r_hand")
    with pytest.raises(hurcules.Error, match="none moves 'l_hand' against its reference"):
        task("hand", left, "l_hand", reference="l_hand")
    task("hand", left, "r_hand", reference="l_hand")  # the left hand leads it


@pytest.mark.filterwarnings("ignore:joints that no actuator")
def test_a_frame_that_held_joints_would_move_is_told_with_them() -> None:
    # an arm that a mocap body leads, as some have, and fingers with actuators
    model = mujoco.MjModel.from_xml_string(
        """<mujoco><worldbody><body name="arm"><joint name="shoulder"/><geom size="0.1"/>
        <body><joint name="finger"/><geom size="0.1"/></body></body></worldbody>
        <actuator><motor joint="finger"/></actuator></mujoco>"""
    )
    wanted = r"none moves 'arm'; 1 joints of the robot are held, .*: shoulder; Robot\(model, joi"
    with pytest.raises(hurcules.Error, match=wanted):
        hurcules.PoseTask("hand", hurcules.Robot(model), "arm")


def test_manipulability_wants_a_frame_that_moves(model: mujoco.MjModel) -> None:
    with pytest.raises(hurcules.Error, match="no coordinate moves the frame 'world'"):
        hurcules.ManipulabilityTask("agile", hurcules.Robot(model), "world")


@pytest.mark.parametrize("led", ["position", "pose"])
def test_a_target_at_a_known_rate_is_followed_without_lag(model: mujoco.MjModel, led: str) -> None:
    def lag(feed_forward: bool) -> float:
        robot = hurcules.Robot(model)
        robot.set_configuration([0.3, 0.4, -0.9, 0.1, 0.6, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
        start, rate = robot.position("l_hand"), np.array([0.0, 0.1, 0.05])
        make = hurcules.PositionTask if led == "position" else hurcules.PoseTask
        task = make("hand", robot, "l_hand")
        controller = hurcules.VelocityController(robot)
        controller.set_stack(hurcules.Stack([task, hurcules.PostureTask("posture", robot)]))
        velocity = np.concatenate([rate, np.zeros(task.rows - 3)])
        for tick in range(1200):
            place = start + rate * tick * 1e-3
            if led == "position":
                task.set_target(place, velocity if feed_forward else None)
            else:
                task.set_target(place, None, velocity if feed_forward else None)
            controller.step(robot)
        return float(np.linalg.norm(robot.position("l_hand") - start - rate * 1.2))

    assert lag(False) > np.hypot(0.1, 0.05) / 5.0  # speed / gain
    assert lag(True) < 1e-4


def test_a_target_set_without_a_rate_is_at_rest_again(model: mujoco.MjModel) -> None:
    robot = hurcules.Robot(model)
    turn = hurcules.OrientationTask("turn", robot, "l_hand")
    turn.set_target(np.eye(3), [0.0, 0.0, 0.1])
    np.testing.assert_allclose(turn.velocity_des, [0.0, 0.0, 0.1], atol=1e-12)
    turn.set_target(np.eye(3))
    assert not turn.velocity_des.any()
    hand = hurcules.PositionTask("hand", robot, "l_hand")
    with pytest.raises(hurcules.Error, match="velocity of task 'hand' wants 3 values, 2 came"):
        hand.set_target([0.0, 0.0, 0.0], [0.0, 0.0])


def test_speed_limits_come_as_a_vector(model: mujoco.MjModel) -> None:
    robot = hurcules.Robot(model)
    limits = hurcules.JointLimits("limits", robot)
    most = np.linspace(0.1, 1.2, robot.size)
    limits.set_max_velocities(most)
    np.testing.assert_array_equal(limits.max_velocity, most)
    posture = hurcules.PostureTask("posture", robot)
    posture.set_target(np.full(robot.size, 2.0))
    posture.set_max_speed(5.0)
    controller = hurcules.VelocityController(robot)
    controller.set_stack(hurcules.Stack([limits, posture]))
    for _ in range(300):
        controller.step(robot)
    np.testing.assert_allclose(controller.velocity, most, atol=1e-9)
    with pytest.raises(hurcules.Error, match="want 12 values, 2 came"):
        limits.set_max_velocities([1.0, 1.0])


@pytest.mark.parametrize("value", [1e20, np.nan, np.inf, -1e7])
def test_absurd_targets_are_refused_where_they_are_set(model: mujoco.MjModel, value: float) -> None:
    robot = hurcules.Robot(model)
    position = hurcules.PositionTask("hand", robot, "l_hand")
    with pytest.raises(hurcules.Error, match="target of task 'hand'"):
        position.set_target([value, 0.0, 0.0])
    with pytest.raises(hurcules.Error, match="target of task 'pose'"):
        hurcules.PoseTask("pose", robot, "l_hand").set_target([value, 0.0, 0.0])
    with pytest.raises(hurcules.Error, match="velocity of task 'hand'"):
        position.advance([value, 0.0, 0.0], 1e-3)


@pytest.mark.parametrize("side", [np.inf, -np.inf, 1e20])
def test_intervals_without_a_number_are_refused(model: mujoco.MjModel, side: float) -> None:
    robot = hurcules.Robot(model, joints=["l1"])
    posture = hurcules.PostureTask("posture", robot)
    with pytest.raises(hurcules.Error, match="an interval that holds a number"):
        posture.set_interval([side], [side])


def test_a_gain_that_is_too_high_for_the_period_is_refused(model: mujoco.MjModel) -> None:
    options = hurcules.VelocityControllerOptions(dt=0.025, gain=50.0)
    with pytest.raises(hurcules.Error, match=r"gain \* dt wants to be 1 at most"):
        hurcules.VelocityController(hurcules.Robot(model), options)


@pytest.mark.parametrize("by", ["velocities", "accelerations"])
def test_on_numbers_that_say_nothing_the_controller_brakes(model: mujoco.MjModel, by: str) -> None:
    robot = hurcules.Robot(model)
    broken = [False]

    def measure(robot: hurcules.Robot) -> tuple[np.ndarray, np.ndarray]:
        value = robot.position("l_hand") * (np.nan if broken[0] else 1.0)
        return value, robot.position_jacobian("l_hand")

    task = hurcules.CustomTask("hand", robot, 3, measure)
    make = hurcules.VelocityController if by == "velocities" else hurcules.AccelerationController
    controller = make(robot)
    controller.set_stack(hurcules.Stack([task]))
    before, q = np.zeros(robot.size), robot.configuration
    fastest = 0.0
    for tick in range(1000):
        broken[0] = tick >= 500
        if not broken[0]:
            task.advance([0.0, 0.3, -0.3], 1e-3)
        controller.step(robot)
        now = (robot.configuration - q) / 1e-3
        q = robot.configuration
        assert np.isfinite(now).all()
        assert np.abs(now - before).max() <= 20.0 * 1e-3 * (1 + 1e-6)
        before = now
        fastest = max(fastest, float(np.abs(now).max()))
        status = controller.solution.status
        assert (status == rhqp.Status.InvalidInput) == broken[0]
    assert fastest > 0.3
    assert np.abs(before).max() < 1e-9
    (short,) = controller.diagnostics(robot)[-1].shortfalls
    assert str(short) == "hand: its numbers are not finite, the controller brakes"


def test_what_is_held_is_named() -> None:
    text = ARM.format(arms=arm("l", 0.2)).replace(
        "</mujoco>", '<actuator><motor joint="l1"/><motor joint="l2"/></actuator></mujoco>'
    )
    model = mujoco.MjModel.from_xml_string(text)
    with pytest.warns(UserWarning, match="drives are held: l3, l4, l5, l6;"):
        text = hurcules.Robot(model).left_out
    assert text.startswith("4 joints of the robot are held")
    assert "l3, l4, l5, l6" in text
    assert hurcules.Robot(model, joints=[f"l{i}" for i in range(1, 7)]).left_out == ""


FREE = """<mujoco><worldbody><body><freejoint name="root"/><geom size=".1"/>
  <body pos="0 0 .3"><joint name="lift" axis="0 1 0"/><geom size=".1"/></body></body></worldbody>
  </mujoco>"""
MUSCLE = """<mujoco><worldbody><body><joint name="elbow" axis="0 1 0" range="-90 90"/>
  <geom size=".1"/></body></worldbody><actuator><muscle joint="elbow"/></actuator></mujoco>"""


def test_a_free_joint_is_refused_with_what_to_do() -> None:
    with pytest.raises(hurcules.Error, match=r"'root' is free.*floating=True"):
        hurcules.Robot(mujoco.MjModel.from_xml_string(FREE), joints=["root"])


def test_a_muscle_moves_in_the_plan_and_is_refused_in_the_physics() -> None:
    model = mujoco.MjModel.from_xml_string(MUSCLE)
    robot = hurcules.Robot(model)
    assert robot.coordinate_names == ["elbow"]
    with pytest.raises(hurcules.Error, match=r"'elbow'.*muscle.*with_motors"):
        hurcules.WholeBodyController(robot, [hurcules.PostureTask("posture", robot)])


DOOR = """<mujoco><compiler angle="radian" autolimits="true"/><option timestep="0.001"/>
  <default><geom contype="0" conaffinity="0"/><joint armature="0.1"/></default><worldbody>
  <body pos="0 0 1"><joint name="a" axis="0 0 1"/><geom size=".05" pos=".15 .1 0" mass="1"/>
    <body pos="0.3 0.2 0"><joint name="b" axis="0 0 1"/><geom size=".05" pos=".15 0 0" mass="1"/>
      <body name="hand" pos="0.3 0 0"><joint name="c" axis="0 0 1"/><geom size=".04" mass=".5"/>
        <site name="tip"/></body></body></body>
  <body name="door" pos="0.6 -0.5 1"><joint name="door" axis="0 0 1" range="-1.5 0.4"/>
    <geom type="box" pos="0 .4 0" size=".02 .4 .6" mass="8"/>
    <site name="handle" pos="0 .7 0"/></body>
  </worldbody><equality><weld name="grip" body1="hand" body2="door" anchor="0 .7 0"/></equality>
  <actuator><motor joint="a"/><motor joint="b"/><motor joint="c"/></actuator></mujoco>"""


def test_a_hand_leads_a_door_and_the_loop_over_the_ground_stays_closed() -> None:
    model = mujoco.MjModel.from_xml_string(DOOR)
    assert "do not keep: grip" in hurcules.Robot(model).left_out
    robot = hurcules.Robot(model, joints=["b"])
    assert robot.followers == ["a", "c", "door"]
    assert robot.left_out == ""
    hand = hurcules.PositionTask("hand", robot, "tip")
    controller = hurcules.WholeBodyController(robot, [hand])
    simulation = hurcules.Simulation(model=model, controller=controller)
    # where the handle is when the door has turned by 0.3 rad
    hand.set_target([0.6 - 0.7 * np.sin(0.3), -0.5 + 0.7 * np.cos(0.3), 1.0])
    for _ in range(40):
        simulation.step(100)
        plan = controller.plan
        assert np.linalg.norm(plan.position("tip") - plan.position("handle")) < 1e-6
    data = simulation.data
    assert data.joint("door").qpos[0] == pytest.approx(0.3, abs=0.01)
    assert np.linalg.norm(data.site("tip").xpos - data.site("handle").xpos) < 2e-3


BENT = [0.2, -0.6, 1.2, 0.3, 0.5, 0.2] + [0.0] * 6


@pytest.mark.parametrize("in_one", [True, False])
def test_a_path_by_accelerations_is_followed_with_its_acceleration(
    model: mujoco.MjModel, in_one: bool
) -> None:
    """A hand swings up and down and turns: without its acceleration it is off by a / K."""
    off = []
    for fed in (False, True):
        robot = hurcules.Robot(model)
        robot.set_configuration(BENT)
        pose = hurcules.PoseTask("hand", robot, "l_hand")
        at = hurcules.PositionTask("at", robot, "l_hand")
        turned = hurcules.OrientationTask("turned", robot, "l_hand")
        controller = hurcules.AccelerationController(robot)
        tasks = [pose] if in_one else [at, turned]
        controller.set_stack(hurcules.Stack([tasks, hurcules.PostureTask("posture", robot)]))
        start, R = robot.position("l_hand"), robot.orientation("l_hand")
        along = np.array([0.0, 0.0, 0.05, 0.3, 0.0, 0.0])  # [m], [rad] about x
        for tick in range(2000):
            w, t = 3.0, 1e-3 * tick
            way = along * (1 - np.cos(w * t))
            v, a = along * w * np.sin(w * t), along * w * w * np.cos(w * t) if fed else np.zeros(6)
            s, c = np.sin(way[3]), np.cos(way[3])
            turn = np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]]) @ R
            pose.set_target(start + way[:3], turn, v, a)
            at.set_target(start + way[:3], v[:3], a[:3])
            turned.set_target(turn, v[3:], a[3:])
            controller.step(robot)
        off.append(np.linalg.norm(np.concatenate([task.error for task in tasks])))
    assert off[1] < 0.05 * off[0]


def test_a_row_of_weight_0_is_no_shortfall(model: mujoco.MjModel) -> None:
    robot = hurcules.Robot(model)
    robot.set_configuration(BENT)
    turned = hurcules.OrientationTask("turned", robot, "l_hand")
    turned.set_weights([1.0, 1.0, 0.0])
    about_z = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    turned.set_target(about_z @ robot.orientation("l_hand"))
    controller = hurcules.VelocityController(robot)
    controller.set_stack(hurcules.Stack([turned, hurcules.PostureTask("posture", robot)]))
    for _ in range(3000):
        controller.step(robot)
    told = next(each for each in controller.diagnostics(robot) if each.level == "turned")
    assert np.abs(turned.error[:2]).max() < 1e-3 < 1.0 < abs(turned.error[2])
    assert [each.text for each in told.shortfalls] == []
    assert told.smallest_singular_value > 0.1
    turned.set_interval([-0.1, 0.0, 0.0], [0.1, 0.0, 0.0])
    controller.step(robot)
    told = next(each for each in controller.diagnostics(robot) if each.level == "turned")
    assert told.smallest_singular_value > 0.1
