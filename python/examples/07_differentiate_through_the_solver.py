"""Differentiate through the solver: PyTorch learns a limit that it never saw.

An arm of four joints moves its hand as asked, as far as its speed limits allow. From the motions
alone, gradient descent finds the limits: the gradient of each answer in its limits comes from the
solver (Solution.vjp), exact, not from differences.

Run:  python python/examples/07_differentiate_through_the_solver.py
"""

import sys

import numpy as np

from hurcules import rhqp

try:
    import torch
except ImportError:
    print("this example needs PyTorch:", "    pip install torch", "", sep="\n")
    print("then run it again", "    python " + sys.argv[0], sep="\n")
    sys.exit(0)


class Solve(torch.autograd.Function):
    """(limit, target) -> x: |x| <= limit first, then A x = target as well as that allows."""

    @staticmethod
    def forward(ctx, A, limit, target):  # noqa: D102
        high, y = limit.detach().numpy(), target.detach().numpy()
        levels = [rhqp.Bounds(-high, high), rhqp.Level(A.numpy(), y, y, rho=0.1)]
        ctx.solution = rhqp.Solver(A.shape[1]).solve(levels)
        return torch.from_numpy(ctx.solution.x.copy())

    @staticmethod
    def backward(ctx, x_bar):  # noqa: D102
        bounds, level = ctx.solution.vjp(x_bar.numpy())
        limit_bar = torch.from_numpy(bounds.upper - bounds.lower)
        return None, limit_bar, torch.from_numpy(level.lower + level.upper)


rng = np.random.default_rng(0)
A = torch.from_numpy(rng.standard_normal((2, 4)))
targets = torch.from_numpy(4.0 * rng.standard_normal((40, 2)))
hidden = torch.tensor([0.3, 0.9, 0.5, 0.7], dtype=torch.float64)
motions = torch.stack([Solve.apply(A, hidden, target) for target in targets])

limit = torch.full((4,), 2.0, dtype=torch.float64, requires_grad=True)
target = targets[0].clone().requires_grad_()
print("gradcheck", torch.autograd.gradcheck(lambda b, y: Solve.apply(A, b, y), (limit, target)))

descent = torch.optim.Adam([limit], lr=0.1)
for step in range(151):
    descent.zero_grad()
    answers = torch.stack([Solve.apply(A, limit, target) for target in targets])
    loss = ((answers - motions) ** 2).mean()
    loss.backward()
    if step % 50 == 0:
        print(f"step {step:3}  loss {loss.item():.1e}  limit {limit.detach().numpy().round(3)}")
    descent.step()
