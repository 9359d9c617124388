"""Equilibria inside of programs of JAX: values, and derivatives forward and backward.

solve = pyrod.jax.solver(scene_of, ["tip", "energy"])
jax.grad(lambda p: solve(p)["energy"])(parameters)
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

import numpy as np

from pyrod.base.optional import need
from pyrod.linear.parametric import Parametric, checked_outputs
from pyrod.scene.scene import Scene


def solver(scene_of: Callable[[Any], Scene], outputs: str | Iterable[str]) -> Callable[[Any], Any]:
    """A function of parameters that JAX knows how to differentiate, compile and batch.

    Equilibria are found on the host. Under `jax.vmap` they are solved together, see `solve_many`.
    Its derivatives are those of `linearised`; there are no second ones.

    Parameters
    ----------
    scene_of : function
        Of parameters, an array or a tree of arrays (NumPy arrays of 64 bits when it is called); the
        scene. It must be smooth, and how many edges there are must not depend on their values.
    outputs : name or names
        "tip", "positions", "K", "moment", "Gamma", "force", "energy", "reactions.0.force", ...

    Returns
    -------
    function
        Of parameters; an array if ``outputs`` is a name, else a dict of arrays by names.
    """
    jax = need("jax", "jax")
    tree = need("jax.tree_util", "jax")
    names = checked_outputs(outputs)
    known: dict[Any, tuple[Callable[[Any], Any], Callable[[], Any]]] = {}

    def solve(parameters: Any) -> Any:
        if not jax.config.jax_enable_x64:
            raise ValueError('solver: needs 64 bits: jax.config.update("jax_enable_x64", True)')
        leaves, shape = tree.tree_flatten(parameters)
        leaves = [jax.numpy.asarray(leaf, dtype=float) for leaf in leaves]
        key = (shape, tuple(leaf.shape for leaf in leaves))
        if key not in known:

            def scene_of_arrays(arrays: list[Any]) -> Scene:
                return scene_of(tree.tree_unflatten(shape, arrays))

            known[key] = _flat(jax, Parametric(scene_of_arrays, key[1], names))
        flat, sizes = known[key]
        told = flat(jax.numpy.concatenate([leaf.reshape(-1) for leaf in leaves]))
        parts = jax.numpy.split(told, np.cumsum([int(np.prod(s)) for s in sizes()])[:-1])
        arrays = {name: a.reshape(s) for name, a, s in zip(names, parts, sizes(), strict=True)}
        return arrays[outputs] if isinstance(outputs, str) else arrays

    return solve


def _flat(jax: Any, of: Parametric) -> tuple[Callable[[Any], Any], Callable[[], Any]]:
    """The outputs as a function of flat parameters, and their shapes."""
    products = _products(jax, of)

    @jax.custom_jvp
    def flat(p: Any) -> Any:
        shape = jax.ShapeDtypeStruct((of.output_size,), np.float64)
        return jax.pure_callback(of.solve, shape, p, vmap_method="broadcast_all")

    @flat.defjvp
    def flat_jvp(primals: Any, tangents: Any) -> Any:
        return flat(*primals), products.bind(*primals, *tangents, back=False)

    return flat, of.output_shapes


def _products(jax: Any, of: Parametric) -> Any:
    """J(p) v, or with ``back`` w J(p), of rows of both: linear in the second, and so JAX may turn
    the one into the other."""
    ad, batching, mlir = (need(f"jax.interpreters.{n}", "jax") for n in ("ad", "batching", "mlir"))
    product = need("jax.extend.core", "jax").Primitive("pyrod_product")
    array = need("jax.core", "jax").ShapedArray

    def told(p: Any, back: bool) -> tuple[int, ...]:
        return (*p.shape[:-1], of.size if back else of.output_size)

    def run(p: Any, v: Any, back: bool) -> Any:
        shape = jax.ShapeDtypeStruct(told(p, back), np.float64)
        return jax.pure_callback(of.pull if back else of.push, shape, p, v)

    def transpose(cotangent: Any, p: Any, v: Any, back: bool) -> Any:
        if ad.is_undefined_primal(p):
            raise NotImplementedError("solver: there are no second derivatives")
        return None, product.bind(p, ad.instantiate_zeros(cotangent), back=not back)

    def jvp(primals: Any, tangents: Any, back: bool) -> Any:
        if type(tangents[0]) is not ad.Zero:
            raise NotImplementedError("solver: there are no second derivatives")
        return product.bind(*primals, back=back), product.bind(
            primals[0], ad.instantiate_zeros(tangents[1]), back=back
        )

    def batch(operands: Any, axes: Any, back: bool) -> Any:
        size = next(a.shape[i] for a, i in zip(operands, axes, strict=True) if i is not None)
        rows = [
            jax.numpy.broadcast_to(a, (size, *a.shape))
            if i is None
            else jax.numpy.moveaxis(a, i, 0)
            for a, i in zip(operands, axes, strict=True)
        ]
        return product.bind(*rows, back=back), 0

    product.def_impl(jax.jit(run, static_argnames="back"))
    product.def_abstract_eval(lambda p, v, back: array(told(p, back), np.dtype(np.float64)))
    mlir.register_lowering(product, mlir.lower_fun(run, multiple_results=False))
    ad.primitive_transposes[product] = transpose
    ad.primitive_jvps[product] = jvp
    batching.primitive_batchers[product] = batch
    return product
