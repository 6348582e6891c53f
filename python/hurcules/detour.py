"""A way round by another posture, where a controller rests short of what it could reach."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from hurcules import _core
from hurcules._core import AccelerationController, Robot, VelocityController, WholeBodyController

__all__ = ["Detour"]


class Detour(_core.Detour):
    """Leads a robot out of where its controller rests short of targets that it could reach.

    A controller sets out from where the robot stands; where limits of joints end its way, the
    target wants another posture: an elbow or a wrist turned the other way. Once the robot rests, a
    detour looks for one as `inverse_kinematics` does, leads all joints there with what comes before
    all else kept, and lets the targets rule again. The hand may go a long way round meanwhile.
    Where no posture meets all targets, one that comes clearly nearer is led to.

    Args:
        robot: that the tasks were made for.
        before: levels that hold on the way too, in decreasing priority, as for Stack: limits,
            distances.
        targets: levels that shall be met.
        below: levels that take what freedom is left; nobody asks whether they are met.
        options: by name, `starts` (descents of a search at most, 32), `seed` of their random
            postures (0), `tolerance` by which a target may be missed at rest (1e-3 m or rad),
            `nearer`, by how much a level must lack less where no posture meets all targets, and
            none before it more (0.02 m or rad, the norm of its rows; inf: none is taken),
            `rate` of the search (5e3 of its ticks a second of the loop: five in a tick of 1 ms,
            each of which takes as long as a tick of the controller).

    Raises:
        Error: no target, a task that stands twice, or options that are none.

    Example::

        detour = Detour(robot, [limits, apart], [hand], [posture])
        controller.set_stack(detour.stacks["direct"])
        while True:
            controller.step(robot)
            detour.look(controller)
    """

    def __init__(
        self,
        robot: Robot,
        before: Sequence[Any],
        targets: Sequence[Any],
        below: Sequence[Any] = (),
        **options: Any,
    ) -> None:
        super().__init__(robot, before, targets, below, **options)
        self._robot = robot

    def look(
        self, controller: VelocityController | AccelerationController | WholeBodyController
    ) -> str:
        """Looks at the robot after a tick; where it rests short of a target, another stack rules.

        A search goes on from look to look, while the robot rests. For the same targets there is
        one: where it finds none, the robot stays at rest until a target moves; where what comes
        before bars the way, it goes back first. A target that moves on the way ends the detour.

        Args:
            controller: a WholeBodyController that has `stacks`, or another one whose stack was set
                to one of them and that moves the robot. While another stack of a
                WholeBodyController rules, nothing happens; a state that is restored on the way goes
                back to the targets.

        Returns:
            What was decided, in words; "" where all goes on.
        """
        if isinstance(controller, WholeBodyController):
            if missing := {"direct", "detour"} - set(controller.stacks):
                raise _core.Error(
                    f"look: the controller has no stack '{min(missing)}', it has "
                    f"{', '.join(controller.stacks)}; stacks=detour.stacks"
                )
            if controller.active != self._rules():  # somebody else decided, or it starts anew
                self.reset()
                if controller.active == "detour":  # a state that was restored
                    controller.use("direct")
            elif self.look_at(controller.plan, controller.qd_des, controller.dt):
                controller.use(self._rules())
        elif self.look_at(self._robot, controller.velocity, controller.options.dt):
            controller.set_stack(self.stacks[self._rules()])
        return self.decision

    def _rules(self) -> str:
        return "detour" if self.on_the_way else "direct"
