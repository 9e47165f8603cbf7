"""The volume elements of meshes: shape functions, quadrature, which points lie inside.

Shape functions are polynomials, N = m(ξ) M⁻¹, with the element's monomials m and M = m(nodes);
x = Σ N x_node. Tetrahedra have the reference corners 0, e₁, e₂, e₃, hexahedra fill [−1, 1]³.
Nodes are numbered as VTK does. Source: Zienkiewicz, Taylor and Zhu, The Finite Element Method,
7th ed., chapter 6.
"""

from itertools import product
from typing import NamedTuple

import numpy as np

SLACK = 1e-9  # of an element's size, by which points on its faces count as inside, at least
NEWTON_STEPS = 12

TETRAHEDRON = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
TETRAHEDRON_EDGES = [(0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3)]
TETRAHEDRON_FACES = [(0, 1, 2), (0, 1, 3), (0, 2, 3), (1, 2, 3)]
HEXAHEDRON = [
    *[(-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1)],
    *[(-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1)],
]
HEXAHEDRON_EDGES = [
    *[(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6)],
    *[(6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)],
]
HEXAHEDRON_FACES = [(-1, 0, 0), (1, 0, 0), (0, -1, 0), (0, 1, 0), (0, 0, -1), (0, 0, 1)]


class Rule(NamedTuple):
    """A quadrature rule: points (q, 3) and weights (q,) on the reference element."""

    points: np.ndarray
    weights: np.ndarray


class Element:
    """A kind of element with the nodes (k, 3) and the monomials' exponents (k, 3).

    `volume_rule` integrates the Jacobian exactly; `gauss_rule` is the rule whose points become
    particles, one near each corner; `center` (3,) is the middle of the reference element.
    """

    def __init__(self, nodes, exponents, volume_rule, gauss_rule):
        self.nodes = np.array(nodes, float)
        self.exponents = np.array(exponents)
        self.volume_rule = volume_rule
        self.gauss_rule = gauss_rule
        corners = self.nodes[: len(gauss_rule.points)]
        self.center = corners.mean(axis=0)
        self.is_linear = len(corners) == len(nodes)
        self._is_tetrahedron = len(corners) == len(TETRAHEDRON)
        self._is_affine = self.is_linear and self._is_tetrahedron
        self._solution = np.linalg.inv(self._monomials(self.nodes, self.exponents))

    def _monomials(self, ξ, exponents):
        powers = np.stack([np.ones_like(ξ), ξ, ξ * ξ], axis=-1)
        x, y, z = exponents.T
        return powers[..., 0, x] * powers[..., 1, y] * powers[..., 2, z]

    def shape(self, ξ):
        """Return the shape functions (..., k) at reference points (..., 3)."""
        return self._monomials(ξ, self.exponents) @ self._solution

    def slopes(self, ξ):
        """Return the slopes (..., 3, k) of the shape functions at reference points (..., 3)."""
        rows = []
        for axis in range(3):
            lower = self.exponents.copy()
            lower[:, axis] = np.maximum(lower[:, axis] - 1, 0)
            rows.append(self.exponents[:, axis] * self._monomials(ξ, lower))
        return np.stack(rows, axis=-2) @ self._solution

    def points(self, nodes, ξ):
        """Return the images (n, q, 3) of reference points (q, 3) in elements of nodes (n, k, 3)."""
        return self.shape(ξ) @ nodes

    def shares(self, nodes, rule):
        """Return the weight times Jacobian determinant (n, q) [m³] at the points of a rule."""
        jacobian = np.einsum("qak,nkc->nqac", self.slopes(rule.points), nodes)
        return np.linalg.det(jacobian) * rule.weights

    def contains(self, nodes, which, points, resolution=0.0):
        """Tell whether points (m, 3) lie in the elements `which` (m,) of nodes (n, k, 3).

        `resolution` [m]: how exactly the coordinates are known.
        """
        with np.errstate(all="ignore"):
            ξ = self._estimate(nodes, which, points)
            size = np.ptp(nodes, axis=1).max(axis=1)[which]
            slack = np.maximum(SLACK, resolution / size)
            is_found = self._is_affine or self._refine(ξ, nodes[which], points, slack * size)
            x, y, z = ξ.T
            if self._is_tetrahedron:
                inside = (x >= -slack) & (y >= -slack) & (z >= -slack) & (x + y + z <= 1 + slack)
            else:
                inside = np.abs(ξ).max(axis=1) <= 1 + slack
            return is_found & inside

    def _estimate(self, nodes, which, points):
        """Return where the points would be in the reference element if the elements were affine."""
        jacobian = np.einsum("ak,nkc->nac", self.slopes(self.center), nodes)
        inverse = np.moveaxis(_solve(jacobian[:, None], np.eye(3)), -2, -1)
        middle = self.points(nodes, self.center[None])[:, 0]
        off = points - middle[which]
        x, y, z = (inverse[which] * off[:, None]).transpose(2, 1, 0)
        return self.center + (x + y + z).T

    def _refine(self, ξ, nodes, points, slack):
        """Improve reference points (m, 3) by Newton's method; tell which of them then fit."""
        for _ in range(NEWTON_STEPS):
            jacobian = np.einsum("nak,nkc->nac", self.slopes(ξ), nodes)
            ξ += _solve(jacobian, points - np.einsum("nk,nkc->nc", self.shape(ξ), nodes))
            np.clip(ξ, -3, 3, out=ξ)
        off = points - np.einsum("nk,nkc->nc", self.shape(ξ), nodes)
        return np.abs(off).max(axis=1) <= slack


def _solve(matrix, right):
    """Return r with r·M = `right` (…, 3) by Cramer's rule; NaN or infinity where M is singular."""
    a, b, c = np.moveaxis(matrix, -2, 0)
    bc, ca, ab = _cross(b, c), _cross(c, a), _cross(a, b)
    determinant = (a * bc).sum(axis=-1, keepdims=True)
    return np.stack([(right * x).sum(axis=-1) for x in (bc, ca, ab)], axis=-1) / determinant


def _cross(a, b):
    (ax, ay, az), (bx, by, bz) = np.moveaxis(a, -1, 0), np.moveaxis(b, -1, 0)
    return np.stack([ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx], axis=-1)


def _middles(nodes, groups):
    return [tuple(np.mean([nodes[i] for i in group], axis=0)) for group in groups]


def _exponents(most, keep):
    return [e for e in product(range(most + 1), repeat=3) if keep(e)]


def _product_rule(count):
    """Return Gauss's rule with `count` points along each axis of a hexahedron."""
    x, w = np.polynomial.legendre.leggauss(count)
    points = np.array(list(product(x, repeat=3)))
    return Rule(points, np.array([np.prod(p) for p in product(w, repeat=3)]))


def _simplex_rules():
    """Return the rules of one point (degree 1), four (degree 2) and eight (degree 3).

    Source: Stroud, Approximate Calculation of Multiple Integrals (1971), T3:1-1, 2-1 and 3-1.
    """
    corners = np.array(TETRAHEDRON, float)
    a, b = (5 - 5**0.5) / 20, (5 + 3 * 5**0.5) / 20
    faces = _middles(TETRAHEDRON, TETRAHEDRON_FACES)
    weights = np.repeat([1 / 40, 9 / 40], 4)
    return (
        Rule(corners.mean(axis=0)[None], np.full(1, 1 / 6)),
        Rule(a + (b - a) * corners, np.full(4, 1 / 24)),
        Rule(np.concatenate([corners, faces]), weights / 6),
    )


ONE, FOUR, EIGHT = _simplex_rules()
CORNERS = Rule(np.array(HEXAHEDRON) / 3**0.5, np.ones(8))
QUADRATIC_TETRAHEDRON = [*TETRAHEDRON, *_middles(TETRAHEDRON, TETRAHEDRON_EDGES)]
SERENDIPITY = [*HEXAHEDRON, *_middles(HEXAHEDRON, HEXAHEDRON_EDGES)]

ELEMENTS = {
    "tetra": Element(TETRAHEDRON, _exponents(1, lambda e: sum(e) <= 1), ONE, FOUR),
    "tetra10": Element(QUADRATIC_TETRAHEDRON, _exponents(2, lambda e: sum(e) <= 2), EIGHT, FOUR),
    "hexahedron": Element(HEXAHEDRON, _exponents(1, lambda e: True), CORNERS, CORNERS),
    "hexahedron20": Element(
        SERENDIPITY, _exponents(2, lambda e: e.count(2) <= 1), _product_rule(3), CORNERS
    ),
    "hexahedron27": Element(
        [*SERENDIPITY, *HEXAHEDRON_FACES, (0, 0, 0)],
        _exponents(2, lambda e: True),
        _product_rule(3),
        CORNERS,
    ),
}
"""Kinds of element by the names that meshio gives them."""
