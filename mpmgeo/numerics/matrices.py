"""3×3 matrices in kernels: flat tuples of nine, row by row: xx xy xz yx yy yz zx zy zz."""

from mpmgeo.numerics.jit import inlined


@inlined
def determinant(A):
    """Return det A."""
    xx, xy, xz, yx, yy, yz, zx, zy, zz = A
    return xx * (yy * zz - yz * zy) - xy * (yx * zz - yz * zx) + xz * (yx * zy - yy * zx)


@inlined
def inverse(A):
    """Return A⁻¹."""
    xx, xy, xz, yx, yy, yz, zx, zy, zz = A
    q = 1.0 / determinant(A)
    return (
        q * (yy * zz - yz * zy),
        q * (xz * zy - xy * zz),
        q * (xy * yz - xz * yy),
        q * (yz * zx - yx * zz),
        q * (xx * zz - xz * zx),
        q * (xz * yx - xx * yz),
        q * (yx * zy - yy * zx),
        q * (xy * zx - xx * zy),
        q * (xx * yy - xy * yx),
    )


@inlined
def product(A, B):
    """Return A B."""
    a, b, c, d, e, f, g, h, i = A
    xx, xy, xz, yx, yy, yz, zx, zy, zz = B
    return (
        a * xx + b * yx + c * zx,
        a * xy + b * yy + c * zy,
        a * xz + b * yz + c * zz,
        d * xx + e * yx + f * zx,
        d * xy + e * yy + f * zy,
        d * xz + e * yz + f * zz,
        g * xx + h * yx + i * zx,
        g * xy + h * yy + i * zy,
        g * xz + h * yz + i * zz,
    )


@inlined
def row_of(a, p):
    """Return the matrix of row p of an array (n, 9)."""
    x, y, z = (a[p, 0], a[p, 1], a[p, 2]), (a[p, 3], a[p, 4], a[p, 5]), (a[p, 6], a[p, 7], a[p, 8])
    return x + y + z
