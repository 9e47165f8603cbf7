"""Vectors of eight doubles for numba kernels: one node record, one cache line, one register.

LLVM lowers `<8 x double>` to one AVX-512, two AVX2 or four NEON registers.
"""

import numpy as np
from llvmlite import ir
from numba.core import cgutils, types
from numba.core.datamodel import models
from numba.core.datamodel.registry import register_default
from numba.core.extending import intrinsic

LANES = 8
LINE = 64  # bytes of a cache line

_VECTOR = ir.VectorType(ir.DoubleType(), LANES)
_INT = ir.IntType(32)
_UNDEFINED = ir.Constant(_VECTOR, ir.Undefined)
_ZERO_MASK = ir.Constant(ir.VectorType(_INT, LANES), [0] * LANES)


class _Vector8(types.Type):
    def __init__(self):
        super().__init__(name="Vector8")


vector8 = _Vector8()


@register_default(_Vector8)
class _Vector8Model(models.PrimitiveModel):
    def __init__(self, manager, kind):
        super().__init__(manager, kind, _VECTOR)


def aligned(count):
    """Return `count` zeros (float64) that begin on a cache line, so that no record straddles two."""
    raw = np.zeros(count + LINE // 8)
    skip = (-raw.ctypes.data % LINE) // 8
    return raw[skip : skip + count]


def _address(context, builder, kind, array, index):
    data = context.make_array(kind)(context, builder, array).data
    return builder.bitcast(builder.gep(data, [index]), _VECTOR.as_pointer())


def _broadcast(builder, x):
    first = builder.insert_element(_UNDEFINED, x, _INT(0))
    return builder.shuffle_vector(first, _UNDEFINED, _ZERO_MASK)


@intrinsic
def load(typing, array, index):
    """Eight values of a flat float64 array from `index` on."""

    def codegen(context, builder, sig, args):
        return builder.load(_address(context, builder, sig.args[0], *args), align=8)

    return vector8(array, types.intp), codegen


@intrinsic
def store(typing, array, index, v):
    """Write eight values to a flat float64 array from `index` on."""

    def codegen(context, builder, sig, args):
        address = _address(context, builder, sig.args[0], args[0], args[1])
        builder.store(args[2], address, align=8)
        return context.get_dummy_value()

    return types.void(array, types.intp, vector8), codegen


@intrinsic
def splat(typing, x):
    """The same value in all lanes."""

    def codegen(context, builder, sig, args):
        return _broadcast(builder, args[0])

    return vector8(types.float64), codegen


@intrinsic
def scale(typing, a, v):
    """a v"""

    def codegen(context, builder, sig, args):
        return builder.fmul(_broadcast(builder, args[0]), args[1])

    return vector8(types.float64, vector8), codegen


@intrinsic
def add(typing, v, w):
    """v + w"""

    def codegen(context, builder, sig, args):
        return builder.fadd(args[0], args[1])

    return vector8(vector8, vector8), codegen


@intrinsic
def axpy(typing, a, v, w):
    """a v + w with one rounding."""

    def codegen(context, builder, sig, args):
        kind = ir.FunctionType(_VECTOR, [_VECTOR] * 3)
        fma = cgutils.get_or_insert_function(builder.module, kind, "llvm.fma.v8f64")
        return builder.call(fma, [_broadcast(builder, args[0]), args[1], args[2]])

    return vector8(types.float64, vector8, vector8), codegen


@intrinsic
def pack(typing, a, b, c, d, e, f, g, h):
    """Eight scalars in one vector."""

    def codegen(context, builder, sig, args):
        v = _UNDEFINED
        for i, x in enumerate(args):
            v = builder.insert_element(v, x, _INT(i))
        return v

    return vector8(*[types.float64] * LANES), codegen


@intrinsic
def lane(typing, v, i):
    """One lane as a scalar."""

    def codegen(context, builder, sig, args):
        return builder.extract_element(args[0], builder.trunc(args[1], _INT))

    return types.float64(vector8, types.int64), codegen
