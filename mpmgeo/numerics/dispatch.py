"""Functions open to new models: chosen by the type of the first argument, in Python and kernels.

Numba keeps a kernel in its disk cache when the kernel is specialised by the *type* of an argument,
never when it takes or closes over another compiled function. So a law, shape or damping is a
NamedTuple of its symbols, and its formula is registered for that type:

    @generic
    def update_stress(model, stress, strain): ...

    @update_stress.register(Elastic)
    def elastic(model, stress, strain): ...
"""

import inspect

from numba import types
from numba.extending import overload

from mpmgeo.numerics.jit import INLINED, keep_apart


def generic(stub):
    """Turn `stub(model, …)` into a function that picks its implementation by the type of `model`.

    Returns the function, with `.register(cls)`, a decorator that raises ValueError for a class that
    has an implementation already, and `.find(cls)`, which returns the implementation for a class.
    Calling either for an unknown class raises TypeError.
    """
    implementations = {}
    names = list(inspect.signature(stub).parameters)
    arguments = ", ".join(names)

    def find(cls):
        for known in cls.__mro__:
            if known in implementations:
                return implementations[known]
        raise TypeError(f"{stub.__name__} has no implementation for {cls.__qualname__}")

    def chosen(model):
        if model is None or isinstance(model, types.NoneType):
            return implementations.get(type(None))
        cls = getattr(model, "instance_class", None)
        return None if cls is None else find(cls)

    # numba's overload needs the very parameter names of the implementations
    scope = {"find": find, "chosen": chosen}
    exec(
        f"def {stub.__name__}({arguments}): return find(type({names[0]}))({arguments})\n"
        f"def template({arguments}): return chosen({names[0]})",
        scope,
    )
    function = scope[stub.__name__]
    function.__doc__, function.__module__ = stub.__doc__, stub.__module__

    def register(cls):
        def add(implementation):
            if cls in implementations:
                raise ValueError(f"{stub.__name__} has an implementation for {cls.__qualname__}")
            found = list(inspect.signature(implementation).parameters)
            if found != names:
                raise ValueError(f"{stub.__name__} takes ({arguments}), not ({', '.join(found)})")
            implementations[cls] = implementation
            _name_apart(cls)
            if _is_ours(stub) and not _is_ours(implementation):
                keep_apart(implementation.__code__.co_filename)
            return implementation

        return add

    function.register, function.find = register, find
    overload(function, jit_options=INLINED)(scope["template"])
    return function


def in_turn(function, *values):
    """Return `all(models, …)`, which calls an open function for each of a tuple of models in turn.

    What a call returns takes the place of the arguments named in `values`, for the next model and
    at last as the result. Without a model they are returned as they are.
    """
    name = f"{function.__name__}_in_turn"
    parameters = ", ".join(list(inspect.signature(function).parameters)[1:])
    result = ", ".join(values)

    def text(count):
        lines = [
            f"    {result} = function(models[{number}], {parameters})\n" for number in range(count)
        ]
        return f"def {name}(models, {parameters}):\n{''.join(lines)}    return {result}\n"

    def made(count):
        scope = {"function": function}
        exec(text(count), scope)
        return scope[name]

    scope = {"made": made}
    exec(
        f"def {name}(models, {parameters}): return made(len(models))(models, {parameters})\n"
        f"def template(models, {parameters}): return made(len(models))",
        scope,
    )
    overload(scope[name], jit_options=INLINED)(scope["template"])
    return scope[name]


def _name_apart(cls):
    """Give a NamedTuple a name that no other has.

    When a kernel is called numba knows NamedTuples only by their names and by their fields, of
    which it drops all letters that are not ASCII: two classes `Symbols` of one Greek letter each
    would run the kernel of whichever came first.
    """
    if hasattr(cls, "_fields"):
        cls.__name__ = f"{cls.__module__}.{cls.__qualname__}"


def _is_ours(function):
    return (function.__module__ or "").split(".")[0] == "mpmgeo"
