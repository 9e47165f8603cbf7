"""The moving base: its velocity from a record, ours and that of MPM-Geomechanics."""

import numpy as np
import pytest
from assembly import assemble, nodes, planes

from mpmgeo.boundaries.base_motion import STILL, BaseMotion, BaseMotionAsMPMGeomechanics
from mpmgeo.boundaries.planes import BASE, FIXED, SLIDING
from mpmgeo.loads.record import Record
from mpmgeo.mpm.effects.base import Base

TIME = np.array([0.0, 0.1, 0.2, 0.3])
ACCELERATION = np.array([[4.0, 0, 0], [0, 2.0, 0], [0, 0, -6.0], [1.0, 1.0, 1.0]])
RECORD = Record(TIME, ACCELERATION)
DT = 0.05
GRAVITY = (1.0, 2.0, -3.0)


def follow(base, steps):
    """Return the motions of some steps, the first of which changes velocities by half a step."""
    return [base.advance(n * DT, DT / 2 if n == 0 else DT) for n in range(steps)]


def test_velocity_is_the_sum_of_the_accelerations():
    motions = follow(BaseMotion(RECORD), 6)
    velocity = np.zeros(3)
    for n, motion in enumerate(motions):
        acceleration = [np.interp(n * DT, TIME, ACCELERATION[:, a]) for a in range(3)]
        assert motion.acceleration == pytest.approx(acceleration)
        assert motion.before == pytest.approx(velocity)
        velocity = velocity + np.array(acceleration) * (DT / 2 if n == 0 else DT)
        assert motion.after == pytest.approx(velocity)
        assert motion.drives


def test_the_base_is_held_after_the_record():
    base = BaseMotion(RECORD)
    symbols = planes("free")
    motions = follow(base, 8)
    assert motions[5] != STILL and motions[7] == STILL
    assert base.ended and base.planes_after(base.planes(symbols)) == symbols._replace(z0=BASE)


def test_users_planes_are_kept():
    symbols = planes("free", plane_X0="fixed", plane_Z0="sliding")
    assert BaseMotion(RECORD).planes(symbols) == symbols._replace(z0=BASE)


def test_old_form_starts_from_zero_and_replaces_all_planes():
    base = BaseMotionAsMPMGeomechanics(RECORD, remaps=True)
    symbols = base.planes(planes("free"))
    assert symbols == (SLIDING, SLIDING, BASE, SLIDING, SLIDING, SLIDING, True)
    first, second, *_ = motions = follow(base, 7)
    assert first.acceleration == (0.0, 0.0, 0.0)
    assert second.before == second.after == pytest.approx([0.1, 0.05, 0])
    assert motions[6] == STILL and base.ended
    assert base.planes_after(symbols) == (FIXED,) * 6 + (False,)


@pytest.mark.parametrize("remaps", [True, False])
def test_old_form_drives_the_velocity_only_in_musl(remaps):
    motion = follow(BaseMotionAsMPMGeomechanics(RECORD, remaps), 2)[1]
    assert motion.drives is remaps


def shaken(scheme, base, steps, **more):
    """Return the nodes, after some steps, of a mesh full of particles on a moving base."""
    random = np.random.default_rng(4)
    position = random.uniform(0, 6, (2000, 3))
    extra = {"cells": (6, 6, 6), "gravity": GRAVITY, "time_step": DT, "effects": (Base(base),)}
    solver = assemble(position, scheme=scheme, volume=1e-9, **extra, **more)
    for _ in range(steps):
        solver.step()
    return nodes(solver)


@pytest.mark.parametrize("scheme", ["USL", "MUSL", "USF"])
@pytest.mark.parametrize("steps", [1, 4])
def test_base_nodes_have_the_velocity_of_the_base(scheme, steps):
    """At edges with other planes too, and nodes above do not."""
    after = follow(BaseMotion(RECORD), steps)[-1].after
    sides = planes("sliding", plane_Xn="fixed")
    index, _, velocity, _ = shaken(scheme, BaseMotion(RECORD), steps, planes=sides)
    held = index[:, 2] <= 0
    np.testing.assert_allclose(velocity[held], np.broadcast_to(after, (held.sum(), 3)), atol=1e-14)
    inner = (index[:, 2] == 3) & (index[:, :2] > 1).all(axis=1) & (index[:, :2] < 5).all(axis=1)
    assert inner.any() and (np.abs(velocity[inner] - after) > 0.01).any(axis=1).all()


@pytest.mark.parametrize("scheme", ["USL", "MUSL", "USF"])
def test_held_base_after_the_record(scheme):
    index, _, velocity, _ = shaken(scheme, BaseMotion(RECORD), 8)
    assert not velocity[index[:, 2] <= 0].any()


def test_old_form_at_edges():
    """Upper sides win over the base, the base over lower sides."""
    base = BaseMotionAsMPMGeomechanics(RECORD, remaps=False)
    index, _, _, acceleration = shaken("USL", base, 2)
    expected = np.array([2.0, 1.0, 0.0])
    x, y, z = index.T
    inner = (z <= 0) & (x < 6) & (y < 6)
    assert inner.any() and acceleration[inner] == pytest.approx(np.tile(expected, (inner.sum(), 1)))
    edge = (z <= 0) & (x >= 6) & (y < 6)
    assert acceleration[edge] == pytest.approx(np.tile([0, 1.0, 0], (edge.sum(), 1)))


def test_old_form_after_the_record():
    base = BaseMotionAsMPMGeomechanics(RECORD, remaps=False)
    index, _, velocity, _ = shaken("USL", base, 8)
    outer = ((index <= 0) | (index >= 6)).any(axis=1)
    assert not velocity[outer].any() and velocity[~outer].any(axis=1).all()
