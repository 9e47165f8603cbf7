"""A soft block under its weight comes to rest as it must, also where particles cross cells."""

import pytest

import mpmgeo
from mpmgeo.verify.dyka_bar import GAUSS
from mpmgeo.verify.soft_block import SoftBlock


def run(block, gamma):
    """Return what the block gives, and what it gives exactly: settlement [m], stress [Pa]."""
    simulation = mpmgeo.Simulation(block.case(lme={"gamma": gamma}))
    edge = GAUSS[0] * block.cell  # from the ends to the nearest particles
    return block.run(simulation), block.settlement(edge), block.stress(block.height - edge)


def test_exact_settlement():
    """Of a block of 10 m, and the stress at its base."""
    block = SoftBlock()
    assert block.settlement(0.0) == pytest.approx(0.5662, abs=5e-5)
    assert SoftBlock(height=88.0).settlement(0.0) == pytest.approx(33.200, abs=5e-4)
    assert block.stress(10.0) == pytest.approx(-0.5886e6)


def test_wide_functions_make_no_noise():
    found, settlement, stress = run(SoftBlock(), 0.8)
    assert found.settlement == pytest.approx(settlement, rel=0.01)
    assert found.stress == pytest.approx(stress, rel=0.015)
    assert found.profile < 5e3


@pytest.mark.slow
@pytest.mark.parametrize("gamma", [0.8, 3.0])
def test_a_high_block_swings_about_its_rest(gamma):
    found, settlement, _ = run(SoftBlock(height=88.0), gamma)
    assert found.stress == pytest.approx(-5.2e6, abs=0.15e6)
    assert found.settlement == pytest.approx(settlement, rel=0.03)
