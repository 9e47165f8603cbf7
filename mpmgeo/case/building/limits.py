"""Limits of the method that a case runs into: the page *What plain MPM cannot do* of the manual."""

from collections.abc import Iterator

CONTRAST = 30
"""Ratio of stiffness from which on GIMP gives stresses at the border that are plainly wrong."""


def limits(case) -> Iterator[str]:
    """Yield warnings, one sentence each, about what the method cannot do in a case."""
    used = {number for body in case.body if body.active for number in body.materials}
    stiffness = {law.id: law.density * law.sound_speed() ** 2 for law in case.materials}
    order = sorted(used, key=stiffness.get)
    if case.shape_function != "GIMP" or len(order) < 2:
        return
    soft, stiff = order[0], order[-1]
    ratio = stiffness[stiff] / stiffness[soft]
    if ratio > CONTRAST:
        yield (
            f"materials: {stiff} is {ratio:.2g} times as stiff as {soft}; where they meet, GIMP "
            "gives its particles wrong stresses, at a ratio of 100 by about the weight of what "
            'lies above; "linear" with MUSL does not'
        )
