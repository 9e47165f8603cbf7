"""Local linear fits: the value of a field at a place from scattered values around it.

    f(x) = f̄ + g·(x − x̄),   g = C⁺ b,   C = Σ w (y − x̄)(y − x̄)ᵀ,   b = Σ w (y − x̄)(f − f̄)

x̄ and f̄: weighted means of the neighbours y and their values. Linear fields are reproduced. Along
directions in which the neighbours have no extent (C⁺ is the pseudo-inverse) the fit is constant.

Source: Lancaster and Salkauskas (1981), Math. Comp. 37, 141–158, with a linear basis.
"""

import numpy as np

FLAT = 1e-9
"""Extent of the neighbours, relative to the largest, squared, below which there is none."""


def linear_fit(x, group, y, w, f):
    """Return the values (n,) or (n, c) at places x (n, 3) from those of their neighbours.

    y (k, 3), f (k,) or (k, c): positions and values of the neighbours, group (k,): the place that
    each belongs to, w (k,): positive weights. Places without neighbours get NaN.
    """
    n = len(x)
    flat = f[:, None] if f.ndim == 1 else f
    total = np.bincount(group, w, n)

    def mean(values):
        sums = [np.bincount(group, w * column, n) for column in values.T]
        with np.errstate(invalid="ignore", divide="ignore"):
            return np.stack(sums, axis=1) / total[:, None]

    y_mean, f_mean = mean(y), mean(flat)
    dy, df = y - y_mean[group], flat - f_mean[group]
    C = mean((dy[:, :, None] * dy[:, None, :]).reshape(-1, 9)).reshape(n, 3, 3)
    columns = flat.shape[1]
    b = mean((dy[:, :, None] * df[:, None, :]).reshape(-1, 3 * columns)).reshape(n, 3, columns)
    known = total > 0
    values, axes = np.linalg.eigh(np.where(known[:, None, None], C, 0.0))
    extent = values > FLAT * values[:, -1:]
    inverse = np.where(extent, 1 / np.where(extent, values, 1.0), 0.0)
    g = axes @ (inverse[:, :, None] * (axes.transpose(0, 2, 1) @ np.nan_to_num(b)))
    fit = f_mean + ((x - y_mean)[:, None, :] @ g)[:, 0]
    return fit[:, 0] if f.ndim == 1 else fit
