"""Laboratory tests on one point of Mohr–Coulomb material against closed forms."""

from dataclasses import replace
from math import exp, radians, sin, sqrt, tan

import numpy as np
import pytest

from mpmgeo.materials.mohr_coulomb import MohrCoulomb
from mpmgeo.materials.newtonian import Newtonian
from mpmgeo.verify.element import Element
from mpmgeo.verify.oedometer import Oedometer

SOIL = MohrCoulomb(
    id=1, density=2000.0, young=2e7, poisson=0.3, friction=30.0, cohesion=1e4, dilation=10.0
)
CELL = -1e5  # pressure of the triaxial cell [Pa]


def test_confined_compression():
    """The curve of the C++ program's verification: loading beyond yield, unloading beyond it too.

    Elastic modulus 466.667, yield at a strain of about −0.0064, −4.0603 at the end of loading with
    that program's return.
    """
    law = MohrCoulomb(
        id=1, density=1.0, young=450.0, poisson=0.125, friction=10.0, cohesion=1.0, dilation=10.0
    )
    curve = Oedometer(law)
    assert curve.modulus == pytest.approx(466.667, abs=1e-3)
    assert curve.yield_strain == pytest.approx(-0.0064, abs=5e-5)
    element = Element(law)
    loading = element.drive([0, 0, -1e-5 * 1001, 0, 0, 0], steps=1001)
    unloading = element.drive([0, 0, 1e-5 * 400, 0, 0, 0], steps=400)
    for path, before in ((loading, None), (unloading, -0.01001)):
        strain, stress = path.component("zz")
        exact = curve.stress(strain, unloaded_from=before)
        assert np.abs(stress - exact).max() < 1e-9 * np.abs(exact).max()
    assert loading.stress[0, 2] == pytest.approx(-0.00466667, abs=1e-8)
    assert loading.stress[-1, 0] == pytest.approx(loading.stress[-1, 1], rel=1e-12)

    old = Element(law, as_mpm_geomechanics=True)
    path = old.drive([0, 0, -1e-5 * 1001, 0, 0, 0], steps=1001)
    assert path.stress[-1, 2] == pytest.approx(-4.0603, abs=5e-5)
    exact = curve.stress(path.component("zz")[0])
    assert np.abs(path.stress[:, 2] - exact).max() < 4e-4 * np.abs(exact).max()


@pytest.mark.parametrize("dilation", [0.0, 10.0, 30.0])
@pytest.mark.parametrize("test", ["compression", "extension"])
def test_triaxial(test, dilation):
    """At the peak N σ₃ − σ₁ = 2 c √N: the axial stress follows from that of the cell."""
    law = replace(SOIL, dilation=dilation, tensile=1e4)
    element = Element(law)
    element.control(stress={"xx": CELL, "yy": CELL, "zz": CELL})
    axial = -0.03 if test == "compression" else 0.03
    path = element.control(strain={"zz": axial}, stress={"xx": CELL, "yy": CELL}, steps=150)
    N, σc = 3.0, 2e4 * sqrt(3)
    peak = N * CELL - σc if test == "compression" else (CELL + σc) / N
    assert path.stress[-1, 2] == pytest.approx(peak, rel=1e-6)
    assert path.stress[-1, :2] == pytest.approx([CELL, CELL], rel=1e-6)

    volume = np.diff(path.strain[:, :3].sum(axis=1))[-1]
    M = (1 + sin(radians(dilation))) / (1 - sin(radians(dilation)))
    step = abs(axial) / 150
    expected = step * ((M - 1) if test == "compression" else (1 - 1 / M))
    assert volume == pytest.approx(expected, abs=1e-6 * step)


@pytest.mark.parametrize("tensile", [None, 0.0, 5e3])
def test_tension_cut_off(tensile):
    """Pulled along one axis the stress stops at the strength, or at zero shear strength."""
    law = replace(SOIL, tensile=tensile)
    strength = tensile if tensile is not None else 1e4 / tan(radians(30))
    element = Element(law, stress=(-1e3, -1e3, -1e3, 0, 0, 0))
    path = element.drive([1e-2, 1e-2, 1e-2, 0, 0, 0], steps=100)
    assert path.stress[-1] == pytest.approx([strength] * 3 + [0.0] * 3, abs=1e-6)
    sideways = {"yy": -1e3, "zz": -1e3}
    element = Element(law, stress=(-1e3, -1e3, -1e3, 0, 0, 0))
    path = element.control(strain={"xx": 1e-3}, stress=sideways, steps=50)
    peak = min(strength, (-1e3 + 2e4 * sqrt(3)) / 3.0)
    assert path.stress[-1, 0] == pytest.approx(peak, rel=1e-6, abs=1e-6)


def test_softening_path():
    """In triaxial compression the strength falls as the law of softening says."""
    law = replace(
        SOIL,
        softening="exponential",
        eta=30.5,
        friction_residual=20.0,
        friction_active=True,
        cohesion_residual=0.0,
        cohesion_active=True,
    )
    element = Element(law)
    element.control(stress={"xx": CELL, "yy": CELL, "zz": CELL})
    path = element.control(strain={"zz": -0.2}, stress={"xx": CELL, "yy": CELL}, steps=2000)
    before = np.concatenate([[0.0], path.state[:-1, 0]])  # strengths are those before the step
    yielding = path.state[:, 0] > before
    assert yielding[150:].all() and path.state[-1, 0] > 0.15
    for εp, stress in zip(before[yielding], path.stress[yielding], strict=True):
        w = exp(-30.5 * εp)
        φ = radians(20 + 10 * w)
        N, c = (1 + sin(φ)) / (1 - sin(φ)), 1e4 * w
        assert stress[2] == pytest.approx(N * CELL - 2 * c * sqrt(N), rel=1e-6)


def test_tension_that_softens():
    """Pulled apart a material loses its tensile strength with η εp."""
    law = replace(
        SOIL,
        tensile=5e3,
        softening="exponential",
        eta=100.0,
        tensile_residual=1e-6,
        tensile_active=True,
    )
    element = Element(law)
    path = element.drive([0.05, 0, 0, 0, 0, 0], steps=500)
    before = np.concatenate([[0.0], path.state[:-1, 0]])
    yielding = path.state[:, 0] > before
    expected = 1e-6 + 5e3 * np.exp(-100.0 * before[yielding])
    assert path.stress[yielding, 0] == pytest.approx(expected, rel=1e-6)
    assert path.stress[-1, 0] < 100.0


def test_undrained_strength():
    """Simple shear fails at su times the vertical stress, whatever the friction."""
    law = replace(SOIL, su_vertical_stress=0.25, dilation=0.0)
    element = Element(law, stress=(-8e4, -8e4, -8e4, 0, 0, 0))
    path = element.drive([0, 0, 0, 0, 0, 0.05], steps=500)
    assert path.stress[-1, 5] == pytest.approx(0.25 * 8e4, rel=1e-6)


def test_viscometer():
    """A Newtonian fluid in shear: τ = μ γ̇."""
    law = Newtonian(id=1, density=1000.0, viscosity=3.0, bulk=1e6)
    element = Element(law, time_step=1e-3)
    path = element.drive([0, 0, 0, 0.01, 0, 0], steps=10)
    assert path.stress[:, 3] == pytest.approx(np.full(10, 3.0 * 2 * 1e-3 / 1e-3))


def test_no_strain_for_the_stress():
    """What a material cannot carry is an error, not an endless search."""
    element = Element(replace(SOIL, tensile=0.0))
    with pytest.raises(RuntimeError, match="no strain gives the stress"):
        element.control(stress={"xx": 1e5, "yy": 1e5, "zz": 1e5})
