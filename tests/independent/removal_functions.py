"""Removal functions by the formulas of docs/removal_functions.md.

A function takes arrays dx, dy of one shape, displacements from the tool axis [mm], and gives the rates there [nm/s].
`reach` is the distance from the axis beyond which the rate is zero, `width` the length over which the function changes,
which sets the steps of the quadrature.
"""

import dataclasses
import math
import typing

import numpy

TAIL_HALVINGS = 9  # the tails of the Gaussian models end where the widest of them is down to 2^-9 of the peak


@dataclasses.dataclass
class RemovalFunction:
    rate: typing.Callable
    reach: float
    width: float


def turned(x, y, degrees):
    """The coordinates of (x, y) along and across a direction at `degrees` counter-clockwise from +x."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return c * x + s * y, c * y - s * x


def within(reach, shape):
    """A function that is zero farther than `reach` from the tool axis."""
    return lambda dx, dy: numpy.where(dx * dx + dy * dy <= reach * reach, shape(dx, dy), 0.0)


def gaussian(peak, fwhm, radius=None):
    radius = 1.5 * fwhm if radius is None else radius
    shape = within(radius, lambda dx, dy: peak * numpy.exp2(-((dx * dx + dy * dy) * (2 / fwhm) ** 2)))
    return RemovalFunction(shape, radius, fwhm)


def elliptic_gaussian(peak, fwhm_x, fwhm_y, angle):
    def shape(dx, dy):
        u, v = turned(dx, dy, angle)
        return peak * numpy.exp2(-((2 * u / fwhm_x) ** 2) - (2 * v / fwhm_y) ** 2)

    reach = max(fwhm_x, fwhm_y) / 2 * math.sqrt(TAIL_HALVINGS)
    return RemovalFunction(within(reach, shape), reach, min(fwhm_x, fwhm_y))


def super_gaussian(peak, fwhm, order):
    reach = fwhm / 2 * TAIL_HALVINGS ** (1 / order)
    shape = within(reach, lambda dx, dy: peak * numpy.exp2(-((4 * (dx * dx + dy * dy) / fwhm**2) ** (order / 2))))
    return RemovalFunction(shape, reach, fwhm / order)


def mrf(peak, lead, trail, width, angle):
    def shape(dx, dy):
        u, v = turned(dx, dy, angle)
        return peak * numpy.exp2(-numpy.where(u < 0, u / lead, u / trail) ** 2 - (2 * v / width) ** 2)

    reach = max(lead, trail, width / 2) * math.sqrt(TAIL_HALVINGS)
    return RemovalFunction(within(reach, shape), reach, min(lead, width / 2))


def bonnet(peak, radius, cap, precession, positions, exponent, angle):
    height = math.sqrt(cap**2 - radius**2)
    c, s = math.cos(math.radians(precession)), math.sin(math.radians(precession))

    def shape(dx, dy):
        square = dx * dx + dy * dy
        pressure = numpy.maximum(0.0, 1 - square / radius**2) ** exponent
        speed = numpy.zeros_like(pressure)
        for position in range(positions):
            lean, _ = turned(dx, dy, angle + 360 * position / positions)
            speed += numpy.sqrt(numpy.maximum(0.0, square * c * c + (height * s) ** 2 + 2 * height * lean * s * c))
        return pressure * speed / positions

    axis = numpy.linspace(-radius, radius, 801)
    largest = shape(*numpy.meshgrid(axis, axis)).max()
    return RemovalFunction(lambda dx, dy: peak / largest * shape(dx, dy), radius, radius)


def oriented(function, flip, degrees):
    """Mirrors a function (flip x: +x becomes -x), then turns it counter-clockwise, as --tif-flip and --tif-angle do."""
    sign_x, sign_y = (-1 if flip == "x" else 1), (-1 if flip == "y" else 1)

    def rate(dx, dy):
        x, y = turned(dx, dy, degrees)
        return function.rate(sign_x * x, sign_y * y)

    return RemovalFunction(rate, function.reach, function.width)
