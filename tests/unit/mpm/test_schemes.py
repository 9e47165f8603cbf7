"""The order of the stages, which is what a scheme is."""

from types import SimpleNamespace

import pytest
from assembly import assemble

from mpmgeo.mpm.schemes import SCHEMES

H = 0.25


def stages(scheme):
    """Return the calls that a scheme makes, in order."""
    calls = []

    def stage(name):
        def call(*args, **kwargs):
            calls.append((name, *args, *kwargs.items()))

        return call

    names = ("scatter", "update_momentum", "gather", "remap", "update_velocity", "strain_and_force")
    SCHEMES[scheme](SimpleNamespace(**{name: stage(name) for name in names}), H)
    return calls


def test_stress_last():
    assert stages("USL") == [("scatter",), ("update_momentum", H), ("gather", H)]


def test_stress_last_with_new_momentum():
    assert stages("MUSL") == [
        ("scatter",),
        ("update_momentum", H),
        ("remap", H),
        ("update_velocity", ("after", True)),
        ("gather", None),
    ]


def test_stress_first():
    assert stages("USF") == [
        ("scatter", ("internal", False)),
        ("update_velocity", ("after", False)),
        ("strain_and_force",),
        ("update_momentum", H),
        ("gather", H, ("stress", False)),
    ]


@pytest.mark.parametrize(
    "scheme, names",
    [
        ("USL", ["sort", "scatter", "grid update", "gather"]),
        ("MUSL", ["sort", "scatter", "grid update", "remap", "gather"]),
        ("USF", ["sort", "scatter", "grid update", "strain and force", "gather"]),
    ],
)
def test_time_is_told_by_stage(scheme, names):
    solver = assemble([[5.0, 5.0, 5.0]], scheme=scheme)
    solver.step()
    assert list(solver.clock.seconds) == names
    assert all(seconds >= 0 for seconds in solver.clock.seconds.values())
