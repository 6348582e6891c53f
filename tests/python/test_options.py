"""Options classes: keywords, defaults, repr, comparison, copies, and Errors that name the field.

Strategy: every class that is bound by its fields (python/bindings/options.hpp) is found by its
text and treated alike. Not tested: what an option does.
"""

import copy
import inspect
import pickle
import re

import numpy as np
import pytest

import hurcules
from hurcules import _core, rhqp

# those without a default value for each field
REQUIRED = {
    "JointPidOptions": {"K": [1.0], "K_P": [2.0], "K_I": [0.5], "max_torque": [10.0]},
    "SpeedLimits": {"acceleration": 1.0, "jerk": 2.0},
    "SensorFault": {"entry": "gyro"},
}
POSITIONAL = {"FallOptions", "SpeedLimits", "SensorFault"}
NAMES = [
    "AccelerationControllerOptions",
    "ContactOptions",
    "DriveOptions",
    "FallOptions",
    "ForceGains",
    "JointPidOptions",
    "MonitorOptions",
    "ParkingOptions",
    "RangeFinder",
    "SensorFault",
    "SensorModel",
    "SensorOptions",
    "SimulationOptions",
    "SolverOptions",
    "SpeedLimits",
    "StiffnessOptions",
    "VelocityControllerOptions",
]


def make(name: str, **values: object) -> object:
    return getattr(_core, name)(**(REQUIRED.get(name, {}) | values))


def fields(name: str) -> list[str]:
    kind = getattr(_core, name)
    return [key for key, value in vars(kind).items() if isinstance(value, property)]


@pytest.mark.parametrize("name", NAMES)
def test_options_print_compare_and_copy_by_their_fields(name: str) -> None:
    one, other = make(name), make(name)
    assert one == other and repr(one) == repr(other)
    assert re.findall(r"[(,] ?(\w+)=", repr(one))[: len(fields(name))]
    assert all(f"{field}=" in repr(one) for field in fields(name))
    assert one != "another kind" and one.__hash__ is None
    for twin in (copy.copy(one), copy.deepcopy(one), pickle.loads(pickle.dumps(one))):
        assert twin == one and twin is not one


def test_a_table_of_phases_and_when_a_robot_fell_are_pickled() -> None:
    table = hurcules.Mission.load("models/missions/lift.toml").rows
    assert pickle.loads(pickle.dumps(table)) == table
    fell = pickle.loads(pickle.dumps(hurcules.FallOptions(frame="head", max_tilt=0.5)))
    assert (fell.frame, fell.max_tilt, fell.min_height) == ("head", 0.5, -np.inf)


@pytest.mark.parametrize("name", NAMES)
def test_an_unknown_keyword_is_answered_with_those_that_exist(name: str) -> None:
    with pytest.raises(hurcules.Error) as caught:
        make(name, nothing=1)
    text = str(caught.value)
    assert text.startswith(f"{name} has no option 'nothing'; there are: ")
    assert set(text.partition("there are: ")[2].split(", ")) == set(fields(name))


@pytest.mark.parametrize("name", sorted(set(NAMES) - POSITIONAL))
def test_values_must_be_named(name: str) -> None:
    with pytest.raises(TypeError, match="keyword arguments only"):
        getattr(_core, name)(1.0)


@pytest.mark.parametrize("name", NAMES)
def test_the_signature_names_every_field(name: str) -> None:
    text = inspect.getdoc(getattr(_core, name).__init__) or ""
    assert all(re.search(rf"\b{field}: ", text) for field in fields(name))


def test_each_field_counts_in_a_comparison() -> None:
    one = hurcules.DriveOptions()
    for field in fields("DriveOptions"):
        other = copy.copy(one)
        if field == "parking":
            other.parking = hurcules.ParkingOptions(attempts=7)
        elif field in ("forward", "turning"):
            setattr(other, field, hurcules.SpeedLimits(0.1, jerk=0.2))
        else:
            setattr(other, field, getattr(one, field) + 1.0)
        assert one != other, field


def test_arrays_and_texts_compare_too() -> None:
    one, other = make("JointPidOptions"), make("JointPidOptions", K=[1.0, 2.0])
    assert one != other and np.array_equal(other.K, [1.0, 2.0])
    assert rhqp.SolverOptions(handover="smooth") != rhqp.SolverOptions()
    assert "handover='smooth'" in repr(rhqp.SolverOptions(handover="smooth"))
    noisy = hurcules.SensorOptions(models={"gyro": hurcules.SensorModel(noise=0.1)})
    assert noisy != hurcules.SensorOptions() and noisy == copy.copy(noisy)


@pytest.mark.parametrize(
    ("name", "values", "says"),
    [
        ("DriveOptions", {"dt": "fast"}, r"DriveOptions: dt wants float, got 'fast'"),
        ("SimulationOptions", {"seed": -1}, r"SimulationOptions: seed wants int, got -1"),
        ("RangeFinder", {"rays": 1.5}, r"RangeFinder: rays wants int, got 1\.5"),
        ("DriveOptions", {"forward": 3}, r"DriveOptions: forward wants .*SpeedLimits, got 3"),
        ("SolverOptions", {"handover": "rough"}, "rough"),
        ("MonitorOptions", {"on": "yes"}, r"MonitorOptions: on wants bool, got 'yes'"),
    ],
)
def test_a_value_of_another_type_is_an_error_that_names_the_field(
    name: str, values: dict[str, object], says: str
) -> None:
    with pytest.raises(hurcules.Error, match=says):
        make(name, **values)


@pytest.mark.parametrize("name", sorted(REQUIRED))
def test_what_has_no_default_is_asked_for(name: str) -> None:
    first = next(iter(REQUIRED[name]))
    with pytest.raises(hurcules.Error, match=f"{name} wants {first}"):
        getattr(_core, name)()


def test_numbers_of_numpy_are_numbers() -> None:
    made = hurcules.DriveOptions(dt=np.float32(0.5), mass=np.int64(3))
    assert (made.dt, made.mass) == (0.5, 3.0)
