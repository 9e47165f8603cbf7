"""Vectors of doubles for numba kernels: eight lanes for a node record, four for a point in space.

LLVM lowers eight lanes to one AVX-512, two AVX2 or four NEON registers. A record is one cache line.
"""

import numpy as np
from llvmlite import ir
from numba.core import cgutils, types
from numba.core.datamodel import models
from numba.core.datamodel.registry import register_default
from numba.core.extending import intrinsic

LANES = 8
LINE = 64  # bytes of a cache line

_INT = ir.IntType(32)
_DOUBLE = ir.DoubleType()


class Vector(types.Type):
    """Numba type of a vector of so many doubles."""

    def __init__(self, lanes):
        self.lanes = lanes
        self.llvm = ir.VectorType(_DOUBLE, lanes)
        super().__init__(name=f"Vector{lanes}")


@register_default(Vector)
class _VectorModel(models.PrimitiveModel):
    def __init__(self, manager, kind):
        super().__init__(manager, kind, kind.llvm)


vector4, vector8 = Vector(4), Vector(8)


def aligned(count):
    """Return `count` zeros (float64) from a cache line on, so that no record straddles two."""
    raw = np.zeros(count + LINE // 8)
    skip = (-raw.ctypes.data % LINE) // 8
    return raw[skip : skip + count]


def _mask(*lanes):
    return ir.Constant(ir.VectorType(_INT, len(lanes)), list(lanes))


def _zero(lanes):
    return ir.Constant(ir.VectorType(_DOUBLE, lanes), [0.0] * lanes)


def _undefined(lanes):
    return ir.Constant(ir.VectorType(_DOUBLE, lanes), ir.Undefined)


def broadcast(builder, x, lanes):
    """Emit a vector with x in all lanes; x itself if it is a vector."""
    if isinstance(x.type, ir.VectorType):
        return x
    first = builder.insert_element(_undefined(lanes), x, _INT(0))
    return builder.shuffle_vector(first, _undefined(lanes), _mask(*[0] * lanes))


def _address(context, builder, kind, array, index, lanes):
    data = context.make_array(kind)(context, builder, array).data
    return builder.bitcast(builder.gep(data, [index]), ir.VectorType(_DOUBLE, lanes).as_pointer())


def _is_contiguous(array):
    return isinstance(array, types.Array) and array.dtype == types.float64 and array.layout == "C"


# Memory


@intrinsic
def load(typing, array, index):
    """Eight values of a flat array from `index` on."""
    if not _is_contiguous(array):
        return None

    def codegen(context, builder, sig, args):
        return builder.load(_address(context, builder, sig.args[0], *args, LANES), align=8)

    return vector8(array, types.intp), codegen


@intrinsic
def store(typing, array, index, v):
    """Write eight values to a flat array from `index` on."""
    if not _is_contiguous(array):
        return None

    def codegen(context, builder, sig, args):
        address = _address(context, builder, sig.args[0], *args[:2], LANES)
        builder.store(args[2], address, align=8)
        return context.get_dummy_value()

    return types.void(array, types.intp, vector8), codegen


@intrinsic
def load_row(typing, array, p):
    """Row p of an (n, 3) array in four lanes, the last one zero."""
    if not _is_contiguous(array):
        return None

    def codegen(context, builder, sig, args):
        first = builder.mul(args[1], args[1].type(3))
        three = builder.load(_address(context, builder, sig.args[0], args[0], first, 3), align=8)
        return builder.shuffle_vector(three, _zero(3), _mask(0, 1, 2, 3))

    return vector4(array, types.intp), codegen


@intrinsic
def store_row(typing, array, p, v):
    """Write the first three lanes to row p of an (n, 3) array."""
    if not _is_contiguous(array):
        return None

    def codegen(context, builder, sig, args):
        first = builder.mul(args[1], args[1].type(3))
        address = _address(context, builder, sig.args[0], args[0], first, 3)
        three = builder.shuffle_vector(args[2], args[2], _mask(0, 1, 2))
        builder.store(three, address, align=8)
        return context.get_dummy_value()

    return types.void(array, types.intp, vector4), codegen


@intrinsic
def load_column(typing, array, p, column):
    """Column (a literal) of the symmetric tensor in row p, (n, 6), in lanes 4, 5, 6 of eight.

    Components are in the order xx yy zz xy yz xz.
    """
    if not _is_contiguous(array) or not isinstance(column, types.IntegerLiteral):
        return None
    i, j, k = ((0, 3, 5), (3, 1, 4), (5, 4, 2))[column.literal_value]

    def codegen(context, builder, sig, args):
        first = builder.mul(args[1], args[1].type(6))
        six = builder.load(_address(context, builder, sig.args[0], args[0], first, 6), align=8)
        return builder.shuffle_vector(six, _zero(6), _mask(6, 6, 6, 6, i, j, k, 6))

    return vector8(array, types.intp, column), codegen


# Making and taking apart


@intrinsic
def splat(typing, x):
    """The same value in all eight lanes."""

    def codegen(context, builder, sig, args):
        return broadcast(builder, args[0], LANES)

    return vector8(types.float64), codegen


def _packed(context, builder, sig, args):
    v = _undefined(len(args))
    for i, x in enumerate(args):
        v = builder.insert_element(v, x, _INT(i))
    return v


@intrinsic
def pack(typing, a, b, c, d, e, f, g, h):
    """Eight numbers in one vector."""
    return vector8(*[types.float64] * 8), _packed


@intrinsic
def pack4(typing, a, b, c, d):
    """Four numbers in one vector."""
    return vector4(*[types.float64] * 4), _packed


@intrinsic
def lane(typing, v, i):
    """One lane as a number."""
    if not isinstance(v, Vector):
        return None

    def codegen(context, builder, sig, args):
        return builder.extract_element(args[0], builder.trunc(args[1], _INT))

    return types.float64(v, types.int64), codegen


@intrinsic
def quarter(typing, v, first):
    """Four lanes of eight, from the literal `first` on, at most to the last."""
    if v != vector8 or not isinstance(first, types.IntegerLiteral):
        return None
    lanes = [first.literal_value + i for i in range(4)]

    def codegen(context, builder, sig, args):
        return builder.shuffle_vector(args[0], args[0], _mask(*lanes))

    return vector4(v, first), codegen


@intrinsic
def with_velocity(typing, v, u):
    """The eight lanes of v with the first three of u in lanes 1, 2, 3."""

    def codegen(context, builder, sig, args):
        wide = builder.shuffle_vector(args[1], args[1], _mask(0, 0, 1, 2, 0, 0, 0, 0))
        return builder.shuffle_vector(args[0], wide, _mask(0, 9, 10, 11, 4, 5, 6, 7))

    return vector8(vector8, vector4), codegen


@intrinsic
def along(typing, values, axis):
    """One lane (a literal) of each vector in a tuple, as a tuple of numbers; numbers stay."""
    if not isinstance(values, types.BaseTuple) or not isinstance(axis, types.IntegerLiteral):
        return None
    kind, index = types.UniTuple(types.float64, len(values)), _INT(axis.literal_value)

    def codegen(context, builder, sig, args):
        numbers = [
            builder.extract_element(x, index) if isinstance(each, Vector) else x
            for each, x in zip(values, cgutils.unpack_tuple(builder, args[0]), strict=True)
        ]
        return context.make_tuple(builder, kind, numbers)

    return kind(values, axis), codegen


# Arithmetic


@intrinsic
def scale(typing, a, v):
    """a v, lane by lane if a is a vector."""
    if not isinstance(v, Vector):
        return None

    def codegen(context, builder, sig, args):
        return builder.fmul(broadcast(builder, args[0], v.lanes), args[1])

    return v(a if a == v else types.float64, v), codegen


@intrinsic
def add(typing, v, w):
    """v + w"""

    def codegen(context, builder, sig, args):
        return builder.fadd(*args)

    return v(v, v), codegen


@intrinsic
def axpy(typing, a, v, w):
    """a v + w with one rounding, lane by lane if a is a vector."""
    if not isinstance(v, Vector):
        return None

    def codegen(context, builder, sig, args):
        kind = ir.FunctionType(v.llvm, [v.llvm] * 3)
        name = f"llvm.fma.v{v.lanes}f64"
        fma = cgutils.get_or_insert_function(builder.module, kind, name)
        return builder.call(fma, [broadcast(builder, args[0], v.lanes), *args[1:]])

    return v(a if a == v else types.float64, v, v), codegen


@intrinsic
def truncate(typing, v):
    """Every lane without its fraction."""

    def codegen(context, builder, sig, args):
        kind = ir.FunctionType(v.llvm, [v.llvm])
        name = f"llvm.trunc.v{v.lanes}f64"
        return builder.call(cgutils.get_or_insert_function(builder.module, kind, name), args)

    return v(v), codegen


@intrinsic
def within(typing, v, low, high):
    """Whether low ≤ v ≤ high in every lane; false for NaN."""

    def codegen(context, builder, sig, args):
        v, low, high = args
        above = builder.fcmp_ordered(">=", v, low)
        below = builder.fcmp_ordered("<=", v, high)
        bits = builder.bitcast(builder.and_(above, below), ir.IntType(sig.args[0].lanes))
        return builder.icmp_unsigned("==", bits, bits.type(2**bits.type.width - 1))

    return types.boolean(v, v, v), codegen
