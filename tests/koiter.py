"""Koiter's rule as it stands: all surfaces of Mohr–Coulomb, tried in all combinations.

Slow and without any thought of order or symmetry; what the return of the package is compared with.
"""

from itertools import combinations, permutations

import numpy as np


def surfaces(N, M, σc, T):
    """Return normals n (9, 3), directions of flow (9, 3) and bounds b (9,): n·σ ≤ b."""
    normals, flows, bounds = [], [], []
    for i, j in permutations(range(3), 2):
        for rows, number in ((normals, N), (flows, M)):
            row = np.zeros(3)
            row[i], row[j] = number, -1.0
            rows.append(row)
        bounds.append(σc)
    for row in np.eye(3):
        normals.append(row)
        flows.append(row)
        bounds.append(T)
    return np.array(normals), np.array(flows), np.array(bounds)


def returns(trial, ν, N, M, σc, T):
    """Return all admissible stresses that plastic flow ≥ 0 on their own surfaces leads to."""
    normals, flows, bounds = surfaces(N, M, σc, T)
    stiffness = np.full((3, 3), ν / (1 - ν))
    np.fill_diagonal(stiffness, 1.0)
    slack = 1e-9 * (np.abs(trial).max() + σc + abs(T)) * N
    if (normals @ trial <= bounds).all():
        return [trial]
    found = []
    for count in (1, 2, 3):
        for active in map(list, combinations(range(9), count)):
            drop = stiffness @ flows[active].T
            system = normals[active] @ drop
            if abs(np.linalg.det(system)) < 1e-10:
                continue
            λ = np.linalg.solve(system, normals[active] @ trial - bounds[active])
            σ = trial - drop @ λ
            if (λ >= -1e-9 * np.abs(λ).max()).all() and (normals @ σ <= bounds + slack).all():
                found.append(σ)
    return found
