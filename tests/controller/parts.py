"""The small part of the short judgement: made up, without symmetry, on pixels that are not square."""

import numpy

from height_map import HeightMap, write_text
from removal_functions import gaussian

TOOL = {"peak": 12.0, "fwhm": 3.0, "radius": 4.5}  # nm/s, mm, mm
TOOL_WORDS = "gaussian:" + ",".join(f"{key}={value:g}" for key, value in TOOL.items())


def tool():
    return gaussian(**TOOL)


def small_part():
    """8 x 6 mm: a bump to one side, waves of 3 to 6 mm, a slope."""
    part = HeightMap(numpy.zeros((30, 32)), (0.25, 0.2), (-3.1, 2.35))
    x, y = numpy.meshgrid(part.x() - part.origin[0], part.y() - part.origin[1])
    bump = numpy.exp(-((x - 5.6) ** 2 + (y - 4.1) ** 2) / 5)
    waves = numpy.sin(1.25 * x + 0.4) * numpy.cos(1.05 * y - 0.7) + 0.5 * numpy.sin(0.9 * x - 1.8 * y)
    part.heights = 22 + 9 * bump + 3 * waves + 0.6 * x + 0.3 * y
    return part


def write_small_part(folder):
    """Writes map.csv and returns the part."""
    part = small_part()
    write_text(folder / "map.csv", part)
    return part
