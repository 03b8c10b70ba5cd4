"""Random jobs, each from a seed: map, removal function for `--tif` and as a function here, path, dialect and motion.

random.Random gives the same numbers in every version of Python, so a job is known by its seed.
"""

import dataclasses
import math
import random

import numpy

import removal_functions
from height_map import HeightMap, read_text, write_text
from removal_functions import RemovalFunction, oriented
from sampled_function import sampled

DIALECTS = ("g94", "g93-per-minute", "g93-seconds")
PIXELS_A_WIDTH = 10  # at least; what coarser pixels do to a narrow tool is another matter
PITCHES = ((0.1, 0.3), (0.25, 0.15), (0.2, 0.2), (0.13, 0.17), (0.3, 0.2))
TERMS = ("none", "piston,tilt", "piston,tilt,power")
LAYOUTS = ((), ("--zero", "-12.5,3.25"), ("--rotate", 90, "--units", "inch"), ("--swap-axes", "--block-numbers"),
           ("--rotate", -37.5, "--zero", "101,-7.125"), ("--rotate", 270, "--swap-axes", "--path-mode", "exact-path"),
           ("--units", "inch", "--zero", "0.001,-1e-3"))  # of the program against the part


@dataclasses.dataclass
class Job:
    part: HeightMap
    function: RemovalFunction
    options: list  # of `dwell simulate` and `dwell plan`: map and removal function
    plan_options: list
    terms: str
    dialect: str
    max_feed: float  # [mm/min]


def random_map(dice, pitch):
    """A part with a bump towards +x, +y, waves, a slope, a corner that is missing and a hole, far from (0, 0)."""
    shape = [round(dice.uniform(13, 15) / step) for step in (pitch[1], pitch[0])]
    part = HeightMap(numpy.zeros(shape), pitch, (round(dice.uniform(-40, 40), 3), round(dice.uniform(-40, 40), 3)))
    x, y = numpy.meshgrid(part.x() - part.origin[0], part.y() - part.origin[1])
    wide, high = x.max(), y.max()
    bump = numpy.exp(-((x - 0.75 * wide) ** 2 + (y - 0.8 * high) ** 2) / dice.uniform(4, 9))
    waves = numpy.sin(x * dice.uniform(0.6, 1.1) + dice.uniform(0, 6)) * numpy.cos(y * dice.uniform(0.5, 1) + 1)
    part.heights = 250 + 120 * bump + 30 * waves + dice.uniform(-8, 8) * x + dice.uniform(2, 6) * y
    part.heights[x / wide + y / high < dice.uniform(0.1, 0.4)] = math.nan
    hole = (x - dice.uniform(0.3, 0.6) * wide) ** 2 + (y - dice.uniform(0.5, 0.7) * high) ** 2
    part.heights[hole < dice.uniform(0.3, 0.8)] = math.nan
    return part


def middle_rows(part, count):
    """A strip of the part, where one track reaches every pixel."""
    first = (len(part.y()) - count) // 2
    return HeightMap(part.heights[first:first + count], part.pitch,
                     (part.origin[0], part.origin[1] + first * part.pitch[1]))


def model(name, **parameters):
    """The same function for --tif and here."""
    text = ",".join(f"{key}={value!r}" for key, value in parameters.items())
    return f"{name}:{text}", getattr(removal_functions, name.replace("-", "_"))(**parameters)


def measured(dice, width, folder):
    """A file of rates on a pitch of its own: a lobe beside a peak, with the tool axis away from the middle."""
    pitch = (round(width / dice.uniform(11, 14), 4), round(width / dice.uniform(11, 14), 4))
    shape = [2 * round(1.7 * width / step) + 1 for step in (pitch[1], pitch[0])]
    rates = HeightMap(numpy.zeros(shape), pitch, (3.5, -1.25), "nm/s")
    axis = [rates.origin[i] + pitch[i] * (shape[1 - i] // 2) + 0.03 * width for i in (0, 1)]
    x, y = numpy.meshgrid(rates.x() - axis[0], rates.y() - axis[1])
    rates.heights = 4 * numpy.exp(-4 * math.log(2) * (x**2 + y**2) / width**2)
    rates.heights += numpy.exp(-4 * math.log(2) * ((x - 0.45 * width) ** 2 + (y - 0.2 * width) ** 2) / width**2)
    rates.heights[rates.heights < 0.002] = 0
    write_text(folder / "tool.csv", rates)
    words = ["--tif", "tool.csv", "--tif-centre", f"{axis[0]!r},{axis[1]!r}"]
    return words, sampled(read_text(folder / "tool.csv"), axis, width)


def ring(width, folder):
    """A file of rates like a fluid jet's: a ring with sharp rims on samples finer than the map's, uneven along x."""
    pitch = round(width / 20, 4)
    rates = HeightMap(numpy.zeros((25, 25)), (pitch, pitch), (-12 * pitch, -12 * pitch), "nm/s")
    x, y = numpy.meshgrid(rates.x(), rates.y())
    distance = numpy.hypot(x, y)
    rates.heights = numpy.where((distance > 0.25 * width) & (distance < 0.5 * width), 5 + 2 * x / width, 0.0)
    write_text(folder / "tool.csv", rates)
    return ["--tif", "tool.csv", "--tif-centre", "0,0"], sampled(read_text(folder / "tool.csv"), (0, 0), 4 * pitch)


def random_function(dice, kind, width, folder):
    """Words of --tif and the function, of a width at half height of at least `width` in all directions [mm]."""
    peak, wider, angle = round(dice.uniform(2, 9), 3), round(width * dice.uniform(1.2, 1.4), 3), dice.randint(-170, 170)
    if kind == "measured":
        return measured(dice, width, folder)
    if kind == "ring":
        return ring(width, folder)
    if kind == "gaussian":
        text, function = model("gaussian", peak=peak, fwhm=width)
    elif kind == "elliptic-gaussian":
        text, function = model("elliptic-gaussian", peak=peak, fwhm_x=wider, fwhm_y=width, angle=angle)
    elif kind == "super-gaussian":
        text, function = model("super-gaussian", peak=peak, fwhm=wider, order=round(dice.uniform(1.8, 3), 2))
    elif kind == "mrf":
        text, function = model("mrf", peak=peak, lead=round(0.5 * width, 3), trail=round(0.7 * width, 3), width=wider,
                               angle=angle)
    else:
        text, function = model("bonnet", peak=peak, radius=wider, cap=40.0, precession=dice.randint(8, 20),
                               positions=dice.choice((1, 2, 4)), exponent=2.0, angle=angle)
    return ["--tif", text], function


SMOOTH_FUNCTIONS = ("gaussian", "measured", "elliptic-gaussian", "mrf", "super-gaussian", "bonnet")


def random_path(dice, kind, width, part, folder):
    """Words of --path for a track distance of about a quarter of the tool's width."""
    pitch = round(width / dice.uniform(3.6, 4.4), 3)
    angle, seed = dice.randint(0, 179), dice.randint(1, 1000)
    options = {
        "raster": f"pitch={pitch},step={round(0.8 * pitch, 3)},angle={angle},turn={dice.choice(('square', 'arc'))}",
        "cross-hatch": f"pitch={round(1.6 * pitch, 3)},angle={angle},crossing=70,corner=0.2",
        "random-raster": f"pitch={pitch},angle={angle},seed={seed},order=one-way",
        "spiral": f"pitch={pitch},turn={dice.choice(('cw', 'ccw'))}", "circles": f"pitch={pitch}",
        "fibonacci": f"pitch={pitch}", "nearest": f"cell={pitch},critical=-inf",
        "random": f"pitch={pitch},angle={angle},seed={seed}", "hilbert": f"pitch={pitch},angle={angle}",
        "line": f"step={pitch},y={float(part.y()[len(part.y()) // 2])!r}", "peano": f"pitch={pitch},gaps=lift", "multi-pitch": f"min-pitch={pitch},max-pitch={round(1.2 * pitch, 3)}",
    }
    if kind == "file":
        write_path(dice, folder / "path.csv", part, pitch)
        return "file:path.csv"
    return f"{kind}:{options[kind]}"


def write_path(dice, file, part, pitch):
    """A path file: columns of points at uneven distances, some lifted to; a point given twice, and one to halt at."""
    lines = ["# columns", "lift,x_mm,y_mm"]
    for x in numpy.arange(part.x()[0] - pitch, part.x()[-1] + 2 * pitch, pitch):
        y, lift = part.y()[0] - pitch * dice.random(), 1
        while y < part.y()[-1] + pitch:
            lines.append(f"{lift},{x:.6f},{y:.6f}")
            y, lift = y + pitch * dice.uniform(0.6, 1), int(dice.random() < 0.05)
    lines += ["0" + lines[-1][1:], f"1,{part.x()[5]:.6f},{part.y()[9]:.6f}"]
    file.write_text("\n".join(lines) + "\n", encoding="ascii")


def random_job(number, path, folder, kind=None):
    """Job `number`; with it go pitches, dialects, removal functions (unless a kind is given), form terms and motion."""
    dice = random.Random(f"dwell {number}")
    part = random_map(dice, PITCHES[(number // 2) % len(PITCHES)])
    write_text(folder / "part.csv", middle_rows(part, 5) if path == "line" else part)
    part = read_text(folder / "part.csv")
    width = round(max(PIXELS_A_WIDTH * max(part.pitch), dice.uniform(2, 3)), 3)
    kind = kind or SMOOTH_FUNCTIONS[number % len(SMOOTH_FUNCTIONS)]
    words, function = random_function(dice, kind, width, folder)
    flip, turn = dice.choice(("none", "x", "y")), dice.choice((0, 90, round(dice.uniform(-180, 180), 2)))
    if kind == "ring":
        turn = 90  # other angles interpolate the samples anew
    options = ["--map", "part.csv", *words, "--tif-flip", flip, "--tif-angle", turn]
    max_feed = round(dice.uniform(300, 3000), 1)
    dialect = DIALECTS[number % len(DIALECTS)]
    motion = "stop" if number % 5 == 4 else "moving"
    plan_options = ["--path", random_path(dice, path, width, part, folder), "--motion", motion, "--gcode", dialect,
                    "--max-feed", max_feed, *LAYOUTS[number % len(LAYOUTS)]]
    terms = TERMS[(number // 2) % len(TERMS)]
    return Job(part, oriented(function, flip, turn), options, plan_options, terms, dialect, max_feed)
