"""A robot whose limits are probably not meant, or that starts outside them, warns once it is made.

Strategy: one arm as text, its ranges in degrees and in radians. Not tested: sliding joints.
"""

import warnings

import mujoco
import numpy as np
import pytest

import hurcules

ARM = """
<mujoco>
  {compiler}
  <worldbody>
    <body>
      <joint name="shoulder" axis="0 1 0" range="{range}"/>
      <geom type="capsule" size="0.03" fromto="0 0 0 0.4 0 0"/>
    </body>
  </worldbody>
</mujoco>
"""
RADIAN = '<compiler angle="radian"/>'


def robot(compiler: str, limits: str) -> hurcules.Robot:
    text = ARM.format(compiler=compiler, range=limits)
    return hurcules.Robot(mujoco.MjModel.from_xml_string(text))


def test_radians_read_as_degrees_warn_at_the_callers_line() -> None:
    with pytest.warns(UserWarning, match="few degrees, were radians meant") as caught:
        robot("", "-1.2 1.2")
    assert "'shoulder' -1.2 to 1.2 degrees" in str(caught[0].message)
    assert 'angle="radian"' in str(caught[0].message)
    assert caught[0].filename == __file__


def test_of_many_such_joints_eight_are_named() -> None:
    # of a humanoid's 56 it was a page
    joints = "".join(
        f'<body name="b{i}"><joint name="j{i}" range="-1 1"/><geom size="0.1"/></body>'
        for i in range(11)
    )
    motors = "".join(f'<motor joint="j{i}"/>' for i in range(11))
    model = mujoco.MjModel.from_xml_string(
        f"<mujoco><worldbody><body>{joints}</body></worldbody><actuator>{motors}</actuator></mujoco>"
    )
    with pytest.warns(UserWarning, match=r"'j7' -1 to 1 degrees and 3 more \(MJCF") as caught:
        one = hurcules.Robot(model)
    assert "'j8'" not in str(caught[0].message)
    with pytest.warns(UserWarning, match=r"'j7' at 1, limits .* and 3 more$"):
        one.set_configuration(np.ones(11))


def test_degrees_read_as_radians_warn() -> None:
    with pytest.warns(
        UserWarning, match="many turns, were degrees meant.*'shoulder' -90 to 90 rad"
    ):
        robot(RADIAN, "-90 90")


def test_a_start_outside_the_limits_warns() -> None:
    arm = robot(RADIAN, "-1.2 1.2")
    with pytest.warns(UserWarning, match="outside the joint limits.*'shoulder' at 1.3, limits"):
        arm.set_configuration([1.3])


def test_what_is_plausible_does_not_warn() -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for compiler, limits in ((RADIAN, "-1.2 1.2"), ("", "-90 90"), ("", "-10 10")):
            robot(compiler, limits).set_configuration([0.1])
        for name in hurcules.models.names():
            hurcules.Robot(hurcules.models.load(name)).set_keyframe("ready")
