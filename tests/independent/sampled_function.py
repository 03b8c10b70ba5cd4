"""A measured removal function: the cubic B-spline through its samples, zero beyond them (docs/math.md, "Removal")."""

import math

import numpy

from removal_functions import RemovalFunction

MARGIN = 4  # samples of zero around the measured ones


def coefficients_along_rows(samples):
    """Solves (c[k-1] + 4 c[k] + c[k+1]) / 6 = samples[k] for every column, with c = 0 outside."""
    count = samples.shape[0]
    matrix = (4 * numpy.eye(count) + numpy.eye(count, k=1) + numpy.eye(count, k=-1)) / 6
    return numpy.linalg.solve(matrix, samples)


def weights(offset):
    """The weights of the four B-splines that reach a place `offset` in [0, 1) behind the second of them."""
    t = offset
    return ((1 - t) ** 3 / 6, (3 * t**3 - 6 * t**2 + 4) / 6, (-3 * t**3 + 3 * t**2 + 3 * t + 1) / 6, t**3 / 6)


def sampled(rates, axis, width):
    """The removal function of a map of rates [nm/s]; `axis` is the tool axis, (x, y) in coordinates of the map [mm]."""
    padded = numpy.pad(numpy.nan_to_num(rates.heights), MARGIN)
    coefficients = numpy.pad(coefficients_along_rows(coefficients_along_rows(padded).T).T, 2)
    rows, columns = coefficients.shape
    first = [rates.origin[i] - axis[i] - (MARGIN + 2) * rates.pitch[i] for i in (0, 1)]

    def rate(dx, dy):
        u, v = (dx - first[0]) / rates.pitch[0], (dy - first[1]) / rates.pitch[1]
        inside = (u >= 1) & (u < columns - 2) & (v >= 1) & (v < rows - 2)
        u, v = u[inside], v[inside]
        column, row = numpy.floor(u).astype(int), numpy.floor(v).astype(int)
        along, across = weights(u - column), weights(v - row)
        corner = (row - 1) * columns + column - 1
        flat = coefficients.ravel()
        total = numpy.zeros_like(u)
        for i in range(4):
            line = sum(along[j] * flat[corner + i * columns + j] for j in range(4))
            total += across[i] * line
        result = numpy.zeros(inside.shape)
        result[inside] = total
        return result

    corners = [(x - axis[0], y - axis[1]) for x in rates.x()[[0, -1]] for y in rates.y()[[0, -1]]]
    reach = max(math.hypot(*corner) for corner in corners) + MARGIN * math.hypot(*rates.pitch)
    return RemovalFunction(rate, reach, width)
