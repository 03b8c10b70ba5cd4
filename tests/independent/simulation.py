"""The removal of a program by plain quadrature: the removal at Gauss points along every step is added up."""

import math

import numpy

POINTS_A_PANEL = 2  # Gauss-Legendre, exact to degree 3
PANELS_A_WIDTH = 8  # good to 1e-5 of the removal; a jump of 0.2 % where a tail is cut off leaves 1e-4


def quadrature(step, panel):
    """Places (n x 2) of the tool during a step and the seconds that it counts there."""
    if step.length() == 0:
        return numpy.array([step.start]), numpy.array([step.seconds])
    panels = max(1, math.ceil(step.length() / panel))
    nodes, weights = numpy.polynomial.legendre.leggauss(POINTS_A_PANEL)
    share = ((numpy.arange(panels)[:, None] + (nodes + 1) / 2) / panels).ravel()
    start, end = numpy.array(step.start), numpy.array(step.end)
    return start + share[:, None] * (end - start), numpy.tile(weights / 2 / panels, panels) * step.seconds


def window(centres, place, reach):
    """The pixels of an axis within reach of a place."""
    return slice(*numpy.searchsorted(centres, (place - reach, place + reach)))


def within_pixels(centres, pitch, count):
    """Gauss points within every pixel along an axis, ascending, and the weights of one pixel's."""
    nodes, weights = numpy.polynomial.legendre.leggauss(count)
    return (centres[:, None] + nodes * pitch / 2).ravel(), weights / 2


def removal(program, function, height_map, points=2):
    """What a program takes off on average over every pixel's area [nm], also where the map has no data.

    The mean is that of points x points Gauss points.
    """
    x, x_weights = within_pixels(height_map.x(), height_map.pitch[0], points)
    y, y_weights = within_pixels(height_map.y(), height_map.pitch[1], points)
    rows_of_map, columns_of_map = height_map.heights.shape
    removed = numpy.zeros((len(y), len(x)))
    parts = [quadrature(step, function.width / PANELS_A_WIDTH) for step in program.steps if step.removes]
    places, seconds = (numpy.concatenate(arrays) for arrays in zip(*parts))
    for (place_x, place_y), time in zip(places, seconds):
        columns, rows = window(x, place_x, function.reach), window(y, place_y, function.reach)
        dx, dy = numpy.meshgrid(x[columns] - place_x, y[rows] - place_y)
        if dx.size and time:
            removed[rows, columns] += time * function.rate(dx, dy)
    cells = removed.reshape(rows_of_map, points, columns_of_map, points)
    return numpy.einsum("ipjq,p,q->ij", cells, y_weights, x_weights)


def without_form(heights, terms, height_map):
    """Heights less the least-squares fit of form terms; NaN stays NaN."""
    x, y = numpy.meshgrid(height_map.x(), height_map.y())
    x, y = x - x.mean(), y - y.mean()
    columns = {"piston": [numpy.ones_like(x)], "tilt": [x, y], "power": [x * x + y * y],
               "astigmatism": [x * x - y * y, 2 * x * y], "none": []}
    basis = [column for term in terms.split(",") for column in columns[term]]
    if not basis:
        return heights
    valid = numpy.isfinite(heights)
    matrix = numpy.stack([column[valid] for column in basis], axis=1)
    solution = numpy.linalg.lstsq(matrix, heights[valid], rcond=None)[0]
    left = heights.copy()
    left[valid] -= matrix @ solution
    return left
