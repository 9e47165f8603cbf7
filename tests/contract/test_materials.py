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
from mpmgeo.materials.hyperelastic import energy_of, is_hyperelastic, stress_of
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
VOIGT = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2)]


def sample(law):
    """Return a material of a law with ordinary values, in which strains begin elastically."""
    names = [f.name for f in fields(law) if f.name in SAMPLE or f.default is MISSING]
    return law(**{name: SAMPLE[name] for name in names})


def tiny(law):
    """Return a small strain, and which share of its response is not that of a smaller one.

    What is added to one loses digits, and stress is not linear in a deformation gradient.
    """
    return (1e-6, 1e-5) if is_hyperelastic(sample(law).symbols) else (1e-9, 1e-9)


def response(symbols, strain):
    """Return the stress (6,) that a strain increment makes in the unstressed material."""
    if is_hyperelastic(symbols):
        return np.array(stress_of(symbols, tuple((np.eye(3) + tensor(strain)).ravel())))
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
    symbols = sample(law).symbols
    formulas = (stress_of, energy_of) if is_hyperelastic(symbols) else (update_stress,)
    for formula in formulas:
        assert formula.find(type(symbols)).__module__ == law.__module__


@LAW
def test_no_strain_changes_nothing(law):
    assert not response(sample(law).symbols, 6 * (0.0,)).any()


@LAW
def test_tangent_is_symmetric_and_stable(law):
    """∂σ/∂ε in components that count shear twice for energy."""
    symbols = sample(law).symbols
    ε, share = tiny(law)
    tangent = np.array([response(symbols, ε * e) for e in np.eye(6)]).T / ε
    tangent[:, 3:] /= 2
    size = np.abs(tangent).max()
    assert np.abs(tangent - tangent.T).max() < share * size
    assert np.linalg.eigvalsh(tangent).min() > -share * size


@LAW
@pytest.mark.parametrize("seed", range(3))
def test_isotropy(law, seed):
    """Turning the strain turns the stress."""
    symbols = sample(law).symbols
    random = np.random.default_rng(seed)
    strain = tiny(law)[0] * random.normal(size=6)
    Q = Rotation.random(random_state=seed).as_matrix()
    turned = response(symbols, voigt(Q @ tensor(strain) @ Q.T))
    expected = voigt(Q @ tensor(response(symbols, strain)) @ Q.T)
    assert np.abs(turned - expected).max() < 1e-9 * np.abs(expected).max()


@LAW
def test_sound_speed_is_that_of_the_tangent(law):
    """ρ c² is the stiffness against compression without lateral strain."""
    material = sample(law)
    ε, share = tiny(law)
    compression = response(material.symbols, ε * np.eye(6)[0])[0] / ε
    assert material.density * material.sound_speed() ** 2 == pytest.approx(compression, rel=share)


@LAW
def test_the_strain_energy_is_the_work_of_a_small_strain(law):
    """½ σ : ε from the unstressed state; of a change of volume alone if viscous stress is none."""
    symbols = sample(law).symbols
    if not stores_energy(symbols):
        pytest.skip("the law stores no energy that it knows of")
    solid = hasattr(law, "poisson")
    strain = np.array([3, -1, 2, 1, -2, 1.5] if solid else [1, 1, 1, 0, 0, 0])
    if is_hyperelastic(symbols):
        strain = 1e-5 * strain
        energy, share = energy_of(symbols, tuple((np.eye(3) + tensor(strain)).ravel())), 1e-4
    else:
        strain = 1e-9 * strain
        energy, share = strain_energy(symbols, tuple(response(symbols, strain))), 1e-9
    work = 0.5 * (response(symbols, strain) * strain * [1, 1, 1, 2, 2, 2]).sum()
    assert energy == pytest.approx(work, rel=share)
