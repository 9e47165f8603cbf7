"""Python's arithmetic (+ − * /, min, max) for vectors in kernels: lane by lane, with numbers too.

So a formula written for numbers also serves the three axes at once.
"""

import operator

from numba.core import types
from numba.core.extending import intrinsic
from numba.extending import overload

from mpmgeo.numerics.jit import INLINED
from mpmgeo.numerics.simd import Vector, broadcast


def _lanewise(operation, emit):
    """Let an operation of Python take vectors, or a vector and a number, in kernels."""

    def instruction(typing, a, b):
        v = a if isinstance(a, Vector) else b

        def codegen(context, builder, sig, args):
            vectors = [
                x if isinstance(kind, Vector) else broadcast(builder, x, v.lanes)
                for kind, x in zip(sig.args, args, strict=True)
            ]
            return emit(builder, *vectors)

        return v(*[k if isinstance(k, Vector) else types.float64 for k in (a, b)]), codegen

    apply = intrinsic(instruction)

    @overload(operation, jit_options=INLINED)
    def implementation(a, b):
        vectors = [isinstance(kind, Vector) for kind in (a, b)]
        if any(vectors) and all(isinstance(kind, (types.Number, Vector)) for kind in (a, b)):
            return lambda a, b: apply(a, b)
        return None


def _choose(relation):
    # a first: where one is NaN the comparison is false and the second one is taken, as by the CPU
    def emit(builder, a, b):
        return builder.select(builder.fcmp_ordered(relation, a, b), a, b)

    return emit


_lanewise(operator.add, lambda builder, a, b: builder.fadd(a, b))
_lanewise(operator.sub, lambda builder, a, b: builder.fsub(a, b))
_lanewise(operator.mul, lambda builder, a, b: builder.fmul(a, b))
_lanewise(operator.truediv, lambda builder, a, b: builder.fdiv(a, b))
_lanewise(min, _choose("<"))
_lanewise(max, _choose(">"))


@overload(operator.neg, jit_options=INLINED)
def _negative(a):
    if isinstance(a, Vector):
        return lambda a: -1.0 * a
    return None
