"""Factors of eight lanes whose halves differ: one for momentum, another for force."""

from llvmlite import ir
from numba.core import cgutils, types
from numba.core.extending import intrinsic

from mpmgeo.numerics.simd import LANES, broadcast, vector8


@intrinsic
def paired(typing, low, high):
    """The numbers of two tuples as one tuple of vectors: in the lower, and in the upper lanes."""
    if not isinstance(low, types.UniTuple) or low != high:
        return None
    kind = types.UniTuple(vector8, len(low))
    all_lanes = ir.Constant(ir.VectorType(ir.IntType(32), LANES), list(range(LANES)))

    def codegen(context, builder, sig, args):
        numbers = (cgutils.unpack_tuple(builder, each) for each in args)
        halves = ([broadcast(builder, x, LANES // 2) for x in each] for each in numbers)
        vectors = [builder.shuffle_vector(a, b, all_lanes) for a, b in zip(*halves, strict=True)]
        return context.make_tuple(builder, kind, vectors)

    return kind(low, high), codegen
