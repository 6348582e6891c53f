"""Hierarchical optimal control of the rescue robot Hurcules, simulated in MuJoCo."""

from hurcules._version import __version__, require_mujoco
from hurcules.opengl import choose_backend

# both before anything else imports MuJoCo
choose_backend()
require_mujoco()

from hurcules import casualties, models, rhqp, scenes, trials  # noqa: E402
from hurcules._core import (  # noqa: E402
    AngleKind,
    AngleTask,
    BaseSource,
    CenterOfMassTask,
    ControlSolution,
    Coordinate,
    DrivenJoint,
    Error,
    GazeTask,
    JointLimits,
    JointPid,
    JointPidOptions,
    OrientationTask,
    PointTask,
    PositionTask,
    PostureTask,
    Robot,
    SimulationOptions,
    Stack,
    StackLevel,
    SwivelTask,
    Task,
    ValueTask,
    VelocityController,
    VelocityControllerOptions,
    missions,
    step,
)
from hurcules.simulation import Simulation  # noqa: E402

__all__ = [
    "AngleKind",
    "AngleTask",
    "BaseSource",
    "CenterOfMassTask",
    "ControlSolution",
    "Coordinate",
    "DrivenJoint",
    "Error",
    "GazeTask",
    "JointLimits",
    "JointPid",
    "JointPidOptions",
    "OrientationTask",
    "PointTask",
    "PositionTask",
    "PostureTask",
    "Robot",
    "Simulation",
    "SimulationOptions",
    "Stack",
    "StackLevel",
    "SwivelTask",
    "Task",
    "ValueTask",
    "VelocityController",
    "VelocityControllerOptions",
    "__version__",
    "casualties",
    "missions",
    "models",
    "rhqp",
    "scenes",
    "step",
    "trials",
]
