"""Warnings before a robot is let go in the physics: what would go wrong there without a word."""

from __future__ import annotations

import warnings
from collections.abc import Iterator

import mujoco
import numpy as np
from numpy.typing import NDArray

from hurcules._core import (
    DistanceTask,
    OrientationTask,
    PoseTask,
    PositionTask,
    Robot,
    WholeBodyController,
)

__all__ = ["warn_of_forces", "warn_of_physics"]

MAX_STEP, MIN_ITERATIONS = 4e-3, 5  # [s] of the physics, of its solver: docs/design/mujoco.md
LONGEST = 0.025  # [s] of a servo's period: docs/control.md; an arm on a base swung at 0.04 s
ENOUGH = 1.02  # of a motor's torque, over the weight that it holds
ROUNDING = 1e-6  # of the largest weight: less is none
DEEP = 5e-3  # [m] that bodies lie in each other: more than a contact gives way
LEVER = 0.02  # [m] with which that turns a joint: about its own axis it does nothing
OUTSIDE = 1e-3  # [rad] or [m]: less is rounding
LARGE = 50.0  # [m]: no arm is
STIFF = 8.0  # times as heavy as it is seems what is damped so, from there on arms swing
LIGHT = 0.05  # of a robot's mass is a foot that it turns about, not a base that it stands on
ON_FEET = (
    "a robot on feet stands by torques, with contacts: "
    "Robot(model, floating=True), ContactTask, control='torque'"
)

HINGE, SLIDE = int(mujoco.mjtJoint.mjJNT_HINGE), int(mujoco.mjtJoint.mjJNT_SLIDE)
SINGLE = (HINGE, SLIDE)
IMPLICIT = (
    int(mujoco.mjtIntegrator.mjINT_IMPLICIT),
    int(mujoco.mjtIntegrator.mjINT_IMPLICITFAST),
)
FRAMES = (PositionTask, OrientationTask, PoseTask)


def warn_of_physics(model: mujoco.MjModel, controller: WholeBodyController) -> None:
    """Warns of settings with which tracks go wrong, and of robots that will fall or sink."""
    for text in _doubts(model, controller):
        warnings.warn(text, stacklevel=3)


def warn_of_forces(controller: WholeBodyController) -> None:
    """Warns of force tasks to which nothing tells a force: they press with all that motors have."""
    if blind := ", ".join(controller.unfed_forces):
        warnings.warn(
            f"force task {blind}: nothing tells it a force, so that it never meets a contact and "
            "presses on; controller.sense(TASK, SENSOR), or TASK.sense(robot, force) each tick",
            stacklevel=3,
        )


def _doubts(model: mujoco.MjModel, controller: WholeBodyController) -> Iterator[str]:
    if controller.dt > 1.001 * LONGEST:
        yield (
            f"a control period of {1e3 * controller.dt:g} ms is too long for servos: robots swing; "
            f"dt={LONGEST:g} of the controller, or less"
        )
    yield from _outside(controller)
    yield from _servos_of_no_joint(model)
    yield from _distances(model, controller)
    yield from _doubled(model)
    yield from _unseen(controller)
    yield from _by_tendons(model, controller)
    yield from _switched_off(model, controller)
    yield from _unkept(controller)
    if any(model.tuple(i).name.startswith("track_") for i in range(model.ntuple)):
        yield from _settings(model)
    elif (floats := _floats(model, controller)) and not _falls(model):
        yield (
            f"{floats} is free and gives way: with base='sensed', or control='torque', hands are "
            "led from where it is, else the plan holds it where it starts"
        )
    elif floats:
        yield (
            f"{floats} is free, and nothing says what it stands on: the plan holds the root "
            "where it starts, the physics lets it fall; WholeBodyController(..., support=BODY) "
            f"names the body that stands, and {ON_FEET}"
        )
    else:
        yield from _feet(model, controller)
        chain = _chain(model, controller)
        yield from _loose_joints(model, controller, chain)
        data = mujoco.MjData(model)
        data.qpos[:] = controller.plan.qpos
        mujoco.mj_forward(model, data)
        yield from _weak_motors(model, data, chain)
        yield from _overlaps(model, data, chain)
        yield from _stiff_servos(model, data, controller.dt)
        yield from _lengths(data, chain)


def _outside(controller: WholeBodyController) -> Iterator[str]:
    plan = controller.plan
    outside = [
        f"{one.name} at {q:.3g}, limits {one.lower:.3g} to {one.upper:.3g}"
        for one, q in zip(plan.coordinates, plan.configuration, strict=True)
        if not one.lower - OUTSIDE <= q <= one.upper + OUTSIDE
    ]
    if outside:
        yield (
            f"the robot starts outside its joint limits: {_listed(outside, '; ')}. It is driven "
            "back, before all that it is told: robot.set_configuration says where it starts"
        )


def _servos_of_no_joint(model: mujoco.MjModel) -> Iterator[str]:
    joints = {model.joint(joint).name for joint in range(model.njnt)}
    for numeric in (model.numeric(i) for i in range(model.nnumeric)):
        joint = numeric.name.removeprefix("servo_")
        if joint != numeric.name and numeric.size == 2 and joint not in joints:
            yield f"numeric '{numeric.name}' holds for nothing: the model has no joint '{joint}'"


def _distances(model: mujoco.MjModel, controller: WholeBodyController) -> Iterator[str]:
    """Distances that give way to a hand, and bodies that come and that none of them counts."""
    names: set[str] = set()
    level = {
        name: number
        for number, one in enumerate(controller.diagnostics())
        for name in one.level.split(" + ")
    }
    for task in controller.tasks:
        if not isinstance(task, DistanceTask):
            continue
        names |= {name for pair in task.pairs(controller.plan) for name in pair}
        led = [one.name for one in controller.tasks if isinstance(one, FRAMES)]
        above = [one for one in led if level.get(one, len(level)) <= level.get(task.name, -1)]
        if above:
            yield (
                f"distance task '{task.name}' stands below or beside '{above[0]}' and gives way to "
                "it: what it keeps off may be touched; distances come before what is led"
            )
    counted = [geom for geom in range(model.ngeom) if _geom(model, geom) in names]
    trees = model.body_rootid[model.dof_bodyid]  # of robots and loads; a base that is fixed too
    around = [one for one in counted if model.body_rootid[model.geom_bodyid[one]] not in trees]
    own = [geom for geom in counted if geom not in around]
    for body in np.flatnonzero(model.body_mocapid >= 0) if around else ():
        geoms = np.flatnonzero(model.body_rootid[model.geom_bodyid] == body)
        if body not in trees and not np.isin(geoms, around).any() and _meet(model, own, geoms):
            name = model.body(body).name
            yield (
                f"no distance task counts '{name}', which mocap moves and the robot may touch: "
                f"obstacles(robot, bodies=['{name}'])"
            )


def _geom(model: mujoco.MjModel, geom: int) -> str:
    """As a DistanceTask names it."""
    body = model.body(model.geom_bodyid[geom]).name
    return model.geom(geom).name or (f"geom {geom} of {body}" if body else f"geom {geom}")


def _meet(model: mujoco.MjModel, some: list[int], others: NDArray[np.intp]) -> bool:
    """Whether contacts between them count."""
    kinds, with_kinds = model.geom_contype, model.geom_conaffinity
    met = kinds[some, None] & with_kinds[others] | with_kinds[some, None] & kinds[others]
    return bool(np.any(met))


def _doubled(model: mujoco.MjModel) -> Iterator[str]:
    doubled = []
    for joint, actuators in _actuated(model).items():
        # of a ball joint there is one about each axis
        if len(actuators) > 1 and int(model.jnt_type[joint]) in SINGLE:
            first, *others = (model.actuator(i).name or f"number {i}" for i in actuators)
            doubled.append(f"'{model.joint(joint).name}' by {first}, not by {', '.join(others)}")
    if doubled:
        yield f"where a joint has several actuators the first moves it alone: {'; '.join(doubled)}"


def _unseen(controller: WholeBodyController) -> Iterator[str]:
    """Tasks in a frame that may move and of which the plan does not know."""
    for task, frame, mocap in controller.unseen_references:
        if mocap:
            way = "no plan sees a mocap body move: lead the target of a task in the world"
        else:
            way = (
                "the plan holds it where it starts; with base='sensed' it is where it is, and the "
                "task late by its speed / gain, unless the target's velocity tells that speed"
            )
        yield f"task '{task}' is measured in '{frame}', which may move: {way}"


def _by_tendons(model: mujoco.MjModel, controller: WholeBodyController) -> Iterator[str]:
    """Coordinates that only the actuators of tendons move."""
    pulled = model.actuator_trnid[model.actuator_trntype == mujoco.mjtTrn.mjTRN_TENDON, 0]
    wrapped = {
        int(model.wrap_objid[wrap])
        for tendon in pulled
        for wrap in range(
            model.tendon_adr[tendon], model.tendon_adr[tendon] + model.tendon_num[tendon]
        )
        if model.wrap_type[wrap] == mujoco.mjtWrap.mjWRAP_JOINT
    }
    own = set(_actuated(model))
    moved = [
        coordinate.name
        for coordinate in controller.plan.coordinates
        if wrapped & (joints := {int(model.dof_jntid[one.dof]) for one in coordinate.joints})
        and not joints & own
    ]
    if moved:
        yield (
            f"{', '.join(moved)}: moved by actuators of tendons alone, which no servo commands: "
            "the plan moves, the robot does not. hurcules.with_motors gives each joint a motor; a "
            "gripper whose joints are left out is led by ControlRate(ACTUATOR, scale)"
        )


def _switched_off(model: mujoco.MjModel, controller: WholeBodyController) -> Iterator[str]:
    """What the plan counts on and the physics leaves out."""
    disabled = model.opt.disableflags
    if disabled & mujoco.mjtDisableBit.mjDSBL_ACTUATION:
        yield 'no actuator moves anything: the model has <flag actuation="disable"/>'
    off = [
        model.actuator(i).name or f"number {i}"
        for i in range(model.nu)
        if 0 <= (group := int(model.actuator_group[i])) < 31
        and model.opt.disableactuator >> group & 1
    ]
    if off:
        yield f"the model's actuatorgroupdisable switches actuators off: {', '.join(off)}"
    tied = any(len(one.joints) > 1 for one in controller.plan.coordinates)
    if disabled & mujoco.mjtDisableBit.mjDSBL_EQUALITY and (tied or controller.plan.followers):
        yield (
            "the plan keeps the model's equality constraints, the physics does not: it has "
            '<flag equality="disable"/>'
        )


def _unkept(controller: WholeBodyController) -> Iterator[str]:
    """Constraints of the physics of which the plan knows nothing."""
    if names := ", ".join(controller.plan.unkept_constraints):
        yield (
            f"the physics keeps constraints that the plan does not: {names}. The robot pulls at "
            'them and may not arrive; active="false" switches one off (of a mocap body that '
            "holds a hand), a RelativePoseTask leads one hand as the other (that hold one thing)"
        )


def _settings(model: mujoco.MjModel) -> Iterator[str]:
    step, iterations = model.opt.timestep, model.opt.iterations
    if step > 1.001 * MAX_STEP:
        yield (
            f"a time step of {1e3 * step:g} ms is too long for tracks: with 4 ms they turn 10 % "
            "faster already, up to 2 ms they agree to 1e-4"
        )
    if iterations < MIN_ITERATIONS:
        yield (
            f"{iterations} iterations of MuJoCo's solver: with 4 or fewer contacts of tracks are "
            "wrong, and nothing else says so"
        )


def _feet(model: mujoco.MjModel, controller: WholeBodyController) -> Iterator[str]:
    """Robots that stand on a body that nothing holds down."""
    plan = controller.plan
    for root in _free_roots(model, controller):
        bodies = [int(body) for body in np.flatnonzero(model.body_rootid == root)]
        names = [model.body(body).name for body in bodies]
        still = [name for name in names if name and not np.any(plan.position_jacobian(name))]
        mass = sum(float(model.body(name).mass[0]) for name in still)
        whole = float(model.body_subtreemass[root])
        if still and mass < LIGHT * whole:
            yield (
                f"the robot stands by servos on '{still[0]}', {mass:.2g} of its {whole:.3g} kg, "
                f"which nothing holds down: it shakes and falls; {ON_FEET}"
            )


def _floats(model: mujoco.MjModel, controller: WholeBodyController) -> str:
    """The root that is free and stands on nothing, in words."""
    plan = controller.plan
    if plan.floats:
        return "the robot's root"
    first = model.body_rootid[model.dof_bodyid[plan.coordinates[0].joints[0].dof]]
    for root in _free_roots(model, controller):
        if root != first:  # a support stands in the first one's tree
            return f"the root '{model.body(root).name}'"
    return ""


def _free_roots(model: mujoco.MjModel, controller: WholeBodyController) -> list[int]:
    """Of the bodies that carry coordinates, those that no coordinate moves."""
    coordinates = controller.plan.coordinates
    dofs = {int(driven.dof) for coordinate in coordinates for driven in coordinate.joints}
    joints = model.body_jntadr[np.unique(model.body_rootid[model.dof_bodyid[sorted(dofs)]])]
    return [
        int(model.jnt_bodyid[joint])
        for joint in joints[joints >= 0]
        if model.jnt_type[joint] == mujoco.mjtJoint.mjJNT_FREE
        and int(model.jnt_dofadr[joint]) not in dofs
    ]


def _falls(model: mujoco.MjModel) -> bool:
    off = model.opt.disableflags & mujoco.mjtDisableBit.mjDSBL_GRAVITY
    return bool(np.any(model.opt.gravity)) and not off


def _chain(model: mujoco.MjModel, controller: WholeBodyController) -> set[int]:
    """The bodies between the ground and what the coordinates move, where no root is free."""
    bodies: set[int] = set()
    for coordinate in controller.plan.coordinates:
        for driven in coordinate.joints:
            body = int(model.dof_bodyid[driven.dof])
            while body > 0:
                bodies.add(body)
                body = int(model.body_parentid[body])
    joints = model.body_jntadr[sorted(bodies)]
    free = {int(model.jnt_type[j]) == mujoco.mjtJoint.mjJNT_FREE for j in joints if j >= 0}
    return set() if True in free else bodies


def _actuated(model: mujoco.MjModel) -> dict[int, list[int]]:
    """Actuators by the joint that they move by itself."""
    found: dict[int, list[int]] = {}
    alone = (int(mujoco.mjtTrn.mjTRN_JOINT), int(mujoco.mjtTrn.mjTRN_JOINTINPARENT))
    for i in range(model.nu):
        if int(model.actuator_trntype[i]) in alone:
            found.setdefault(int(model.actuator_trnid[i, 0]), []).append(i)
    return found


def _loose_joints(
    model: mujoco.MjModel, controller: WholeBodyController, chain: set[int]
) -> Iterator[str]:
    """Joints that carry the robot and that nothing holds."""
    if model.ntendon:  # whatever a tendon moves is moved
        return
    names = [model.joint(joint).name or f"joint{joint}" for joint in range(model.njnt)]
    held = {names.index(name) for name in controller.plan.followers} | set(_actuated(model))
    free = [
        joint
        for joint in range(model.njnt)
        if joint not in held
        and int(model.jnt_type[joint]) in SINGLE
        and model.jnt_stiffness[joint] == 0.0
        and not _tied(model, joint)
    ]
    loose = [joint for joint in free if int(model.jnt_bodyid[joint]) in chain]
    if chain:
        loose += _leading_to_frames(model, controller, [one for one in free if one not in loose])
    if loose:
        yield (
            f"nothing holds {_listed([names[joint] for joint in loose])}, and parts that the "
            "controller moves hang on it: it falls in the physics. hurcules.with_motors gives each "
            "joint a motor"
        )


def _leading_to_frames(
    model: mujoco.MjModel, controller: WholeBodyController, joints: list[int]
) -> list[int]:
    """Those that move the frame of a task."""
    tasks = [task for task in controller.tasks if isinstance(task, FRAMES)]
    if not joints or not tasks:
        return []
    plan, found = controller.plan, []
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # the plan has told
        probe = Robot(model, plan.coordinate_names)
    states, here = [task.state() for task in tasks], []
    for task in tasks:
        task.update(plan)
        here.append(task.error)
    for joint in joints:
        qpos = plan.qpos
        qpos[model.jnt_qposadr[joint]] += 0.1
        probe.set_qpos(qpos)
        for task, error in zip(tasks, here, strict=True):
            task.update(probe)
            if np.any(np.abs(task.error - error) > 1e-9):
                found.append(joint)
                break
    for task, state in zip(tasks, states, strict=True):
        task.update(plan)
        task.restore(state)
    return found


def _tied(model: mujoco.MjModel, joint: int) -> bool:
    ties = model.eq_type == mujoco.mjtEq.mjEQ_JOINT
    return bool(np.any(ties & ((model.eq_obj1id == joint) | (model.eq_obj2id == joint))))


def _weak_motors(model: mujoco.MjModel, data: mujoco.MjData, chain: set[int]) -> Iterator[str]:
    """Motors that cannot hold what hangs on them where the robot starts."""
    weight: NDArray[np.float64] = data.qfrc_bias - data.qfrc_passive
    weight -= np.where(model.jnt_actgravcomp[model.dof_jntid], data.qfrc_gravcomp, 0.0)
    nothing = ROUNDING * float(np.abs(weight).max())
    weak = []
    for joint, motors in _actuated(model).items():
        if int(model.jnt_bodyid[joint]) not in chain or int(model.jnt_type[joint]) not in SINGLE:
            continue
        least, most = _range(model, data, motors[0])  # the others give nothing
        if model.jnt_actfrclimited[joint]:
            lower, upper = (float(each) for each in model.jnt_actfrcrange[joint])
            least, most = max(least, lower), min(most, upper)
        asked = float(weight[model.jnt_dofadr[joint]])
        gives = max(0.0, most if asked > 0.0 else -least)
        if abs(asked) > max(nothing, gives * ENOUGH):
            unit = "N m" if int(model.jnt_type[joint]) == HINGE else "N"
            weak.append(f"{model.joint(joint).name} ({abs(asked):.3g} of {gives:.3g} {unit})")
    if weak:
        yield (
            f"motors cannot hold the weight on them where the robot starts: {_listed(weak)}. It "
            "sinks in the physics, and all that it is told waits for it"
        )


def _overlaps(model: mujoco.MjModel, data: mujoco.MjData, chain: set[int]) -> Iterator[str]:
    """Bodies of the robot that lie in something where it starts, and push joints out of it."""
    deep: dict[tuple[str, str], float] = {}
    jacobians = np.zeros((2, 3, model.nv))
    for contact in data.contact:
        if contact.exclude or contact.dist > -DEEP or min(contact.geom) < 0:  # a flex has no geom
            continue
        bodies = [int(model.geom_bodyid[geom]) for geom in contact.geom]
        if not chain.intersection(bodies):
            continue
        for jacobian, body in zip(jacobians, bodies, strict=True):
            mujoco.mj_jac(model, data, jacobian, None, contact.pos, body)
        if np.abs(contact.frame[:3] @ (jacobians[1] - jacobians[0])).max() > LEVER:
            first, second = (model.body(body).name or f"body {body}" for body in bodies)
            deep[first, second] = max(deep.get((first, second), 0.0), -float(contact.dist))
    if deep:
        pairs = _listed([f"{a} and {b} ({1e3 * by:.3g} mm)" for (a, b), by in deep.items()])
        yield (
            f"bodies lie in each other where the robot starts: {pairs}. The physics forces them "
            "apart, and what they belong to stands still; <exclude> in the model lets them be"
        )


def _stiff_servos(model: mujoco.MjModel, data: mujoco.MjData, dt: float) -> Iterator[str]:
    """Servo actuators whose own damping MuJoCo cannot integrate while a control is held."""
    damping = np.zeros(model.nv)
    affine = model.actuator_biastype == mujoco.mjtBias.mjBIAS_AFFINE
    for joint, motors in _actuated(model).items():
        if affine[motors[0]] and int(model.jnt_type[joint]) in SINGLE:
            own = -model.actuator_biasprm[motors[0], 2] * model.actuator_gear[motors[0], 0] ** 2
            damping[model.jnt_dofadr[joint]] = max(own, 0.0)
    if not damping.any():
        return
    inertia = np.zeros((model.nv, model.nv))
    mujoco.mj_fullM(model, data, inertia)
    rates = np.linalg.solve(inertia, np.diag(damping))
    rate, step = np.abs(np.linalg.eigvals(rates)).max(), model.opt.timestep  # [1/s], [s]
    implicit = model.opt.integrator in IMPLICIT
    held = implicit or round(dt / step) > 1
    if held and (rate * dt > STIFF or (not implicit and rate * step > 2.0)):
        worst = model.joint(int(model.dof_jntid[np.argmax(np.diag(rates))])).name
        remedy = "a shorter one" if implicit else "one physics step a period"
        yield (
            f"the actuators' own damping (most at {worst}) is too stiff for a control period of "
            f"{1e3 * dt:g} ms: they swing; {remedy}, or motors in their place"
        )


def _lengths(data: mujoco.MjData, chain: set[int]) -> Iterator[str]:
    if chain and (span := np.ptp(data.xpos[sorted(chain)], axis=0).max()) > LARGE:
        yield f"bodies of the robot are {span:.0f} m apart, were millimetres meant?"


def _range(model: mujoco.MjModel, data: mujoco.MjData, motor: int) -> tuple[float, float]:
    """[N m] or [N] at the joint where the robot starts, at rest; infinite without a limit."""
    ends = np.array([-np.inf, np.inf])
    plain = model.actuator_gaintype[motor] == mujoco.mjtGain.mjGAIN_FIXED
    if plain and model.actuator_ctrllimited[motor]:
        ends = float(model.actuator_gainprm[motor, 0]) * model.actuator_ctrlrange[motor]
        if model.actuator_biastype[motor] == mujoco.mjtBias.mjBIAS_AFFINE:
            constant, stiffness = model.actuator_biasprm[motor, :2]
            ends = ends + constant + stiffness * data.actuator_length[motor]
    if model.actuator_forcelimited[motor]:
        ends = np.clip(ends, *model.actuator_forcerange[motor])
    least, most = sorted(float(end) for end in ends * model.actuator_gear[motor, 0])
    return least, most


def _listed(items: list[str], between: str = ", ") -> str:
    """The first eight, then how many more."""
    more = f" and {len(items) - 8} more" if len(items) > 8 else ""
    return between.join(items[:8]) + more
