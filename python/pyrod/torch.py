"""Equilibria inside of programs of PyTorch: values and gradients.

solve = pyrod.torch.solver(scene_of, ["tip", "energy"])
solve(parameters)["energy"].backward()
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

import numpy as np

from pyrod.base.immutable import Array
from pyrod.base.optional import need
from pyrod.linear.parametric import Parametric, checked_outputs
from pyrod.scene.scene import Scene


def solver(scene_of: Callable[..., Scene], outputs: str | Iterable[str]) -> Callable[..., Any]:
    """A function of tensors that PyTorch knows how to differentiate.

    Gradients are those of `linearised`; there are no second ones.

    Parameters
    ----------
    scene_of : function
        Of as many arrays as there are tensors (NumPy arrays of 64 bits when it is called); the
        scene. It must be smooth.
    outputs : name or names
        "tip", "positions", "K", "moment", "Gamma", "force", "energy", "reactions.0.force", ...

    Returns
    -------
    function
        Of tensors of 64 bits; a tensor if ``outputs`` is a name, else a dict of them by names.
    """
    torch = need("torch", "torch")
    names = checked_outputs(outputs)
    product = _function(torch)

    def solve(*tensors: Any) -> Any:
        for tensor in tensors:
            if tensor.dtype != torch.float64:
                raise ValueError(f"solver: needs tensors of 64 bits, got {tensor.dtype}")
        shapes = [tuple(tensor.shape) for tensor in tensors]
        of = Parametric(lambda arrays: scene_of(*arrays), shapes, names)
        told = product.apply(of, torch.cat([tensor.reshape(-1) for tensor in tensors]))
        sizes = of.output_shapes()
        parts = torch.split(told, [int(np.prod(size)) for size in sizes])
        found = {n: part.reshape(size) for n, part, size in zip(names, parts, sizes, strict=True)}
        return found[outputs] if isinstance(outputs, str) else found

    return solve


def _function(torch: Any) -> Any:
    def tensor(array: Array, like: Any) -> Any:
        return torch.from_numpy(array).to(like.device)

    def numbers(t: Any) -> Array:
        return t.detach().cpu().numpy()

    class Outputs(torch.autograd.Function):
        @staticmethod
        def forward(ctx: Any, of: Parametric, p: Any) -> Any:
            ctx.of = of
            ctx.save_for_backward(p)
            return tensor(of.solve(numbers(p)), p)

        @staticmethod
        @torch.autograd.function.once_differentiable
        def backward(ctx: Any, weights: Any) -> Any:
            (p,) = ctx.saved_tensors
            return None, tensor(ctx.of.pull(numbers(p), numbers(weights)), p)

    return Outputs
