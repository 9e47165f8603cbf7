"""Schemes and shapes that do not go together, and what the compatibility switch lacks of them."""

from mpmgeo import shapes
from mpmgeo.mpm import schemes
from mpmgeo.values import shown

LINEAR_LAST = (
    '"linear" with the scheme USL diverges in plain cases, such as a block that falls, whatever '
    "the time step: nodes that a particle just reaches are too light; "
    '"stress_scheme_update": "MUSL" mends it, and so does another shape, as in "method": '
    '"recommended"'
)

KNOWN = {"shape_function": shapes, "stress_scheme_update": schemes}
"""Keys, with the module that knows which of their words MPM-Geomechanics has."""

NUMBERS = {
    "lme": ("shape_function", ("LME",)),
    "npc": ("stress_scheme_update", ("NPC", "NPC-CD")),
}
"""Keys of numbers, with the key and its words without which they have no effect."""


def check_schemes(draft, report):
    """Warn of a shape whose nodes the scheme does not hold; report what there is not."""
    case = draft.whole.values
    scheme = case.get("stress_scheme_update")
    if case.get("shape_function") == "linear" and scheme == "USL":
        report.warn(("shape_function",), LINEAR_LAST)
    if case.get("compatibility") is not None:
        for key, known in KNOWN.items():
            _check_compatible(key, case.get(key), known.AS_MPM_GEOMECHANICS, report)
        if case.get("method") is not None:
            report.error(("method",), "MPM-Geomechanics has its own; leave it or compatibility out")
        if case.get("volumetric_locking") == "cells":
            message = "MPM-Geomechanics knows no cure of locking; leave it or compatibility out"
            report.error(("volumetric_locking",), message)
    _check_newmark(draft, scheme, report)
    for key, (choice, words) in NUMBERS.items():
        for numbers in draft.of(key):
            says_something = numbers.made is not None and numbers.made != type(numbers.made)()
            if case.get(choice) not in words and says_something:
                accepted = " or ".join(map(shown, words))
                report.note((key,), f'has no effect without "{choice}": {accepted}')


def _check_compatible(key, word, words, report):
    if word is not None and word not in words:
        accepted = ", ".join(map(shown, words))
        message = f"MPM-Geomechanics has no {shown(word)}; accepted with compatibility: {accepted}"
        report.error((key,), message)


def _check_newmark(draft, scheme, report):
    """Report what does not go with Newmark's method."""
    if not isinstance(schemes.SCHEMES.get(scheme), schemes.Newmark):
        return
    for results in draft.of("results"):
        if "energy" in results.given:
            message = f"there is no balance of energy with {shown(scheme)}; leave one of them out"
            report.error(results.at("energy"), message)
    for numbers in draft.of("npc"):
        made = schemes.SCHEMES[scheme].with_numbers(numbers.made) if numbers.made else None
        if made is not None and made.longest == 0.0:
            message = (
                f"{shown(scheme)} diverges with {shown(numbers.made.gamma)}; accepted: 0.5 to 1"
            )
            report.error(numbers.at("gamma"), message)
