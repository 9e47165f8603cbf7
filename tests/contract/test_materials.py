"""What every material law keeps: its declaration, and its elastic part at a point.

Laws are tested for small strains from a stress-free state, where each of them is elastic.
"""

import inspect
import sys
from dataclasses import MISSING, fields, is_dataclass

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from mpmgeo.materials import LAWS
from mpmgeo.materials.law import stores_energy, strain_energy, update_stress

LAW = pytest.mark.parametrize("law", LAWS, ids=[law.__name__ for law in LAWS])
SAMPLE = {
    "id": 1,
    "density": 2000.0,
    "young": 1e7,
    "poisson": 0.3,
    "friction": 30.0,
    "cohesion": 1e4,
    "bulk": 1e7,
}
SI = {"", "Pa", "kg/m³", "m/s", "s", "m", "N", "1/s", "Pa s", "°", "m/s²"}
DT = 1e-4
TINY = 1e-9
VOIGT = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2)]


def sample(law):
    """Return a material of a law with ordinary values, in which strains begin elastically."""
    names = [f.name for f in fields(law) if f.name in SAMPLE or f.default is MISSING]
    return law(**{name: SAMPLE[name] for name in names})


def response(symbols, strain):
    """Return the stress (6,) that a strain increment makes in the unstressed material."""
    new = update_stress(symbols, 6 * (0.0,), tuple(strain), len(symbols.STATE) * (0.0,), DT)
    assert len(new) == 6 + len(symbols.STATE)
    return np.array(new[:6])


def tensor(components):
    """Return the symmetric tensor (3, 3) of six components."""
    out = np.zeros((3, 3))
    for (i, j), value in zip(VOIGT, components, strict=True):
        out[i, j] = out[j, i] = value
    return out


def voigt(a):
    return np.array([a[i, j] for i, j in VOIGT])


@LAW
def test_declaration(law):
    assert is_dataclass(law) and law.__dataclass_params__.frozen
    assert law.type and law.type == law.type.lower()
    assert law.__doc__ and law.__doc__.splitlines()[0].endswith(".")
    assert {"id", "density"} <= {f.name for f in fields(law)}
    for f in fields(law):
        assert f.metadata["doc"], f.name
        assert f.metadata["unit"] in SI, f.name
        assert set(f.metadata["bounds"]) <= {"above", "minimum", "below", "maximum"}


def test_type_words_differ():
    words = [law.type for law in LAWS]
    assert len(set(words)) == len(words)


@LAW
def test_equations_source_and_objectivity_are_documented(law):
    """The file says where its formula is from and what becomes of stress when material rotates."""
    doc = sys.modules[law.__module__].__doc__
    assert "Source:" in doc
    assert "rotation" in doc
    assert "=" in doc


@LAW
def test_symbols(law):
    symbols = sample(law).symbols
    assert isinstance(symbols, tuple) and hasattr(symbols, "_fields")
    assert all(type(value) in (float, int) for value in symbols), "kernels need plain numbers"
    assert isinstance(symbols.STATE, tuple) and "STATE" not in symbols._fields


@LAW
def test_update_is_registered_in_the_file_of_the_law(law):
    names = list(inspect.signature(update_stress).parameters)
    assert names == ["law", "stress", "strain", "state", "dt"]
    assert update_stress.find(type(sample(law).symbols)).__module__ == law.__module__


@LAW
def test_no_strain_changes_nothing(law):
    assert not response(sample(law).symbols, 6 * (0.0,)).any()


@LAW
def test_tangent_is_symmetric_and_stable(law):
    """∂σ/∂ε in components that count shear twice for energy."""
    symbols = sample(law).symbols
    tangent = np.array([response(symbols, TINY * e) for e in np.eye(6)]).T / TINY
    tangent[:, 3:] /= 2
    size = np.abs(tangent).max()
    assert np.abs(tangent - tangent.T).max() < 1e-9 * size
    assert np.linalg.eigvalsh(tangent).min() > -1e-9 * size


@LAW
@pytest.mark.parametrize("seed", range(3))
def test_isotropy(law, seed):
    """Turning the strain turns the stress."""
    symbols = sample(law).symbols
    random = np.random.default_rng(seed)
    strain = TINY * random.normal(size=6)
    Q = Rotation.random(random_state=seed).as_matrix()
    turned = response(symbols, voigt(Q @ tensor(strain) @ Q.T))
    expected = voigt(Q @ tensor(response(symbols, strain)) @ Q.T)
    assert np.abs(turned - expected).max() < 1e-10 * np.abs(expected).max()


@LAW
def test_sound_speed_is_that_of_the_tangent(law):
    """ρ c² is the stiffness against compression without lateral strain."""
    material = sample(law)
    compression = response(material.symbols, TINY * np.eye(6)[0])[0] / TINY
    assert material.density * material.sound_speed() ** 2 == pytest.approx(compression, rel=1e-9)


@LAW
def test_the_strain_energy_is_the_work_of_a_small_strain(law):
    """½ σ : ε from the unstressed state; of a change of volume alone if viscous stress is none."""
    symbols = sample(law).symbols
    if not stores_energy(symbols):
        pytest.skip("the law stores no energy that it knows of")
    solid = hasattr(law, "poisson")
    strain = np.array([3, -1, 2, 1, -2, 1.5] if solid else [1, 1, 1, 0, 0, 0]) * TINY
    stress = response(symbols, strain)
    work = 0.5 * (stress * strain * [1, 1, 1, 2, 2, 2]).sum()
    assert strain_energy(symbols, tuple(stress)) == pytest.approx(work, rel=1e-9)
