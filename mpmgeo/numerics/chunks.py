"""Loops in threads: work is cut into chunks, a kernel says what is done in one of them.

    @blockwise
    def double(c, bounds, x):
        for p in range(bounds[c], bounds[c + 1]):
            x[p] *= 2.0

    double(crew, bounds, x)

A kernel is compiled once: the machine code of a chunk is the same whoever runs it, one thread or
many, this process or a later one that finds the kernel in the cache. With numba's `prange` it is
not: there the process that compiles runs another copy of the loop than the one that it keeps.
Arguments may be tuples of anything, in any depth. A chunk may not raise and should not allocate.
"""

import inspect

import numba
from llvmlite import binding, ir
from numba.core import cgutils, types
from numba.core.extending import intrinsic
from numba.core.typing import signature

from mpmgeo.numerics.jit import INLINED, compiled

CHUNKS = 64  # pieces into which every loop is cut

_INT = ir.IntType(32)
_BYTES = ir.IntType(8).as_pointer()
_ENDED = ir.VoidType()


ALONE = (0, 1)
"""Crew of the calling thread alone."""


def crew_of(count):
    """Return a crew of `count` of numba's threads: the address of what starts them, and how many.

    A plain tuple, because a kernel is called with it.
    """
    if count == 1:
        return ALONE
    from numba.np.ufunc.parallel import _launch_threads

    _launch_threads()
    start = binding.address_of_symbol("numba_parallel_for")
    return (start, count) if start else ALONE


def most_threads():
    """Return how many threads numba has; ValueError if the layer asked for cannot start them."""
    if numba.config.THREADING_LAYER != "default":
        try:
            numba.get_num_threads()
        except ValueError as error:
            layer, reason = numba.config.THREADING_LAYER, str(error).partition("\n")[0]
            raise ValueError(f"NUMBA_THREADING_LAYER {layer!r} of numba: {reason}") from error
    return numba.config.NUMBA_NUM_THREADS


def blockwise(function):
    """Compile `function(c, …)`, the work in chunk c, as a kernel that is called with a crew, …

    If it returns an integer, the kernel returns the sum over the chunks.
    """
    name, code = function.__name__, function.__code__
    body = numba.njit(**INLINED)(function)
    arguments = ", ".join(list(inspect.signature(function).parameters)[1:])
    text = f"def {name}(crew, {arguments}): return {name}_in_chunks(crew, ({arguments},))"
    # where the function is defined, so that numba's cache is that of its file
    source = compile("\n" * (code.co_firstlineno - 1) + text, code.co_filename, "exec")
    function.__globals__[f"{name}_in_chunks"] = _launcher(body)
    scope = {}
    exec(source, function.__globals__, scope)
    kernel = scope[name]
    kernel.__module__, kernel.__doc__ = function.__module__, function.__doc__
    return compiled(kernel)


def _launcher(body):
    """Return a function for kernels that runs `body` with a tuple of arguments in all chunks."""

    def instruction(typing, crew, arguments):
        found = body.get_compile_result(signature(None, types.intp, *arguments.types))
        result = found.signature.return_type

        def codegen(context, builder, sig, args):
            context.active_code_library.add_linking_library(found.library)
            record = cgutils.alloca_once(builder, _record(context, arguments))
            for i, value in enumerate(cgutils.unpack_tuple(builder, args[1])):
                builder.store(value, _field(builder, record, 0, _INT(i)))
            function = _share(context, builder.module, found, arguments)
            _run(context, builder, function, record, *cgutils.unpack_tuple(builder, args[0]))
            if result == types.none:
                return context.get_dummy_value()
            total = context.get_constant(types.intp, 0)
            for c in range(CHUNKS):
                total = builder.add(total, builder.load(_field(builder, record, 1, _INT(c))))
            return total

        return result(crew, arguments), codegen

    return intrinsic(instruction)


def _record(context, arguments):
    """Return the type of what the threads of a loop have in common: arguments, results."""
    results = ir.ArrayType(context.get_value_type(types.intp), CHUNKS)
    return ir.LiteralStructType([context.get_value_type(arguments), results])


def _field(builder, record, part, index):
    return builder.gep(record, [_INT(0), _INT(part), index])


def _share(context, module, found, arguments):
    """Return a function that does one thread's share, as numba's threads want it.

    They call it with the addresses of: the first chunk, how many there are, a step, the record.
    """
    intp = context.get_value_type(types.intp)
    kinds = [_BYTES.as_pointer(), intp.as_pointer(), intp.as_pointer(), _BYTES]
    name = module.get_unique_name("share")
    function = ir.Function(module, ir.FunctionType(_ENDED, kinds), name)
    function.linkage = "internal"
    builder = ir.IRBuilder(function.append_basic_block())
    first, count, _, data = function.args
    record = builder.bitcast(data, _record(context, arguments).as_pointer())
    given = [
        _borrowed(context, builder, kind, builder.load(_field(builder, record, 0, _INT(i))))
        for i, kind in enumerate(arguments)
    ]
    begin, count = builder.ptrtoint(builder.load(first), intp), builder.load(count)
    work, conv = found.fndesc, context.call_conv
    called = context.declare_function(module, work)
    with cgutils.for_range(builder, count, intp=intp) as loop:
        c = builder.add(begin, loop.index)
        _, value = conv.call_function(builder, called, work.restype, work.argtypes, [c, *given])
        if work.restype != types.none:
            builder.store(value, _field(builder, record, 1, c))
    builder.ret_void()
    return function


def _borrowed(context, builder, kind, value):
    """Return a value whose arrays nobody counts references to: the caller holds them."""
    if isinstance(kind, types.Array):
        array = context.make_array(kind)(context, builder, value)
        array.meminfo = array.parent = ir.Constant(_BYTES, None)
        return array._getvalue()
    if isinstance(kind, types.BaseTuple):
        parts = cgutils.unpack_tuple(builder, value)
        parts = [_borrowed(context, builder, k, v) for k, v in zip(kind, parts, strict=True)]
        return context.make_tuple(builder, kind, parts)
    return value


def _run(context, builder, function, record, start, threads):
    """Emit the call of a share for all chunks, or of numba's threads, which share them."""
    intp = context.get_value_type(types.intp)
    data = builder.bitcast(record, _BYTES)
    # "addresses" from 0 on in steps of 1 are the numbers of the chunks
    first = cgutils.alloca_once_value(builder, ir.Constant(_BYTES, None))
    count = cgutils.alloca_once_value(builder, intp(CHUNKS))
    step = cgutils.alloca_once_value(builder, intp(1))
    with builder.if_else(builder.icmp_signed("==", start, intp(0))) as (alone, together):
        with alone:
            builder.call(function, [first, count, step, data])
        with together:
            kind = ir.FunctionType(_ENDED, [_BYTES] * 5 + [intp] * 3)
            loop = builder.inttoptr(start, kind.as_pointer())
            places = [builder.bitcast(a, _BYTES) for a in (function, first, count, step)]
            builder.call(loop, [*places, data, intp(0), intp(1), threads])
