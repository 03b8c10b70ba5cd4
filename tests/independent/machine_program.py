"""Reads program.nc and feed.csv as docs/formats.md describes them, into steps: straight moves and halts.

Lengths are in mm, times in s.
"""

import dataclasses
import math
import pathlib
import re

SECONDS_PER_MINUTE = 60
MM_PER_INCH = 25.4
CHAIN_TOLERANCE = 0.001  # of a step


@dataclasses.dataclass
class Step:
    start: tuple  # (x, y) [mm]
    end: tuple
    seconds: float
    removes: bool

    def length(self):
        return math.dist(self.start, self.end)


@dataclasses.dataclass
class Program:
    steps: list
    largest_speed: float  # of the moves that remove, from the numbers as they stand in the file [mm/s]

    def seconds(self):
        return math.fsum(step.seconds for step in self.steps)


def move_seconds(dialect, length, f):
    """What F means: mm/min, moves a minute or the seconds of the move."""
    if dialect == "g94":
        return SECONDS_PER_MINUTE * length / f
    return SECONDS_PER_MINUTE / f if dialect == "g93-per-minute" else f


def words_of(line):
    """The words of a line of G-code without its comments: [("G", 1.0), ("X", 2.5), ...]."""
    text = re.sub(r"\([^)]*\)", "", line).partition(";")[0]
    return [(letter.upper(), float(number)) for letter, number in re.findall(r"([A-Za-z])\s*([-+]?[0-9.]+)", text)]


def part_of(text):
    """Where a place of the program lies on the part, by "(dwell: zero=X/Y rotate=DEG swap=yes|no)"."""
    stated = re.search(r"^\(dwell: zero=(\S+)/(\S+) rotate=(\S+) swap=(yes|no)\)$", text, re.MULTILINE)
    if not stated:
        return lambda place: place
    zero, angle = (float(stated[1]), float(stated[2])), math.radians(float(stated[3]))

    def place_on_part(place):
        x, y = reversed(place) if stated[4] == "yes" else place
        return (zero[0] + x * math.cos(angle) + y * math.sin(angle),
                zero[1] - x * math.sin(angle) + y * math.cos(angle))

    return place_on_part


def read_gcode(file, dialect=None):
    """Reads program.nc in the dialect that it names itself, or in another to see what a wrong guess would do."""
    text = pathlib.Path(file).read_text(encoding="ascii")
    dialect = dialect or re.search(r"\(dwell: gcode=([a-z0-9-]+), g4=seconds", text)[1]
    unit = MM_PER_INCH if re.search(r"^(N\d+ )?G20$", text, re.MULTILINE) else 1
    on_part = part_of(text)
    place = {"X": math.nan, "Y": math.nan, "Z": math.nan}
    feed, motion, steps, speeds = math.nan, None, [], [0.0]
    for line in text.splitlines():
        words = words_of(line)
        codes = [value for letter, value in words if letter == "G"]
        values = {letter: value for letter, value in words if letter != "G"}
        if values.get("M") in (2, 30):
            break
        feed = values.get("F", feed) * (unit if "F" in values and dialect == "g94" else 1)
        motion = next((code for code in codes if code in (0, 1)), motion)
        before = dict(place)
        place.update((axis, values[axis] * unit) for axis in place if axis in values)
        if 4 in codes:
            spot = on_part((place["X"], place["Y"]))
            steps.append(Step(spot, spot, values["P"], place["Z"] == 0))
        elif motion == 1 and before != place:
            length = math.dist([before[axis] for axis in "XYZ"], [place[axis] for axis in "XYZ"])
            step = Step(on_part((before["X"], before["Y"])), on_part((place["X"], place["Y"])),
                        move_seconds(dialect, length, feed), before["Z"] == 0 == place["Z"])
            steps.append(step)
            speeds.append(length / step.seconds)
    return Program(steps, max(speeds))


def read_table(file):
    """The header of feed.csv and its rows as dictionaries of numbers."""
    lines = pathlib.Path(file).read_text(encoding="utf-8").splitlines()
    header = dict(line.removeprefix("# ").split(": ", 1) for line in lines if line.startswith("#") and ": " in line)
    columns, *rows = [line.split(",") for line in lines if not line.startswith("#")]
    return header, [dict(zip(columns, map(float, row))) for row in rows]


def pieces_of(rows):
    """The rows in runs between lifts."""
    pieces = []
    for row in rows:
        if row["lift"] or not pieces:
            pieces.append([])
        pieces[-1].append(row)
    return pieces


def middle(p, q):
    return ((p[0] + q[0]) / 2, (p[1] + q[1]) / 2)


def straight_on(p, q):
    """The point as far behind q as q is behind p."""
    return (2 * q[0] - p[0], 2 * q[1] - p[1])


def halfway_nodes(points):
    """Where the strokes of a piece begin and end: halfway between its points, and straight on at its ends."""
    between = [middle(p, q) for p, q in zip(points, points[1:])]
    if not between:
        return [points[0], points[0]]
    return [straight_on(between[0], points[0]), *between, straight_on(between[-1], points[-1])]


def chain_nodes(points):
    """The nodes of the chain of equal steps whose midpoints are the points of a piece, or None (docs/math.md, "Nodes").

    Only the last step may be shorter.
    """
    if len(points) < 2:
        return None
    nodes = [straight_on(middle(*points[:2]), points[0])]
    slack = CHAIN_TOLERANCE * math.dist(*points[:2])
    for point, between in zip(points, [middle(*ends) for ends in zip(points, points[1:])] + [None]):
        node = straight_on(nodes[-1], point)
        nodes.append(between if between and math.dist(node, between) <= slack else node)
    first, *others = [math.dist(*ends) for ends in zip(nodes, nodes[1:])]
    equal = all(abs(step - first) <= CHAIN_TOLERANCE * first for step in others[:-1])
    return nodes if equal and others[-1] <= (1 + CHAIN_TOLERANCE) * first else None


def stroke_steps(begin, point, end, seconds):
    """The two legs of a stroke, run at one speed; a stroke of no length is a halt."""
    legs = [(begin, point), (point, end)]
    length = math.fsum(math.dist(*leg) for leg in legs)
    if length == 0:
        return [Step(point, point, seconds, True)]
    return [Step(*leg, seconds * math.dist(*leg) / length, True) for leg in legs]


def read_moving_table(rows):
    steps, speeds = [], [0.0]
    for piece in pieces_of(rows):
        points = [(row["x_mm"], row["y_mm"]) for row in piece]
        nodes = chain_nodes(points) or halfway_nodes(points)
        for row, begin, point, end in zip(piece, nodes, points, nodes[1:]):
            stroke = stroke_steps(begin, point, end, row["dwell_s"])
            length = math.fsum(step.length() for step in stroke)
            steps += stroke
            speeds += [length / row["dwell_s"]] if length else []
            speeds.append(row["feed_mm_per_min"] / SECONDS_PER_MINUTE)
    return Program(steps, max(speeds))


def read_halting_table(rows, max_feed):
    steps = []
    for piece in pieces_of(rows):
        before = None
        for row in piece:
            point = (row["x_mm"], row["y_mm"])
            if before is not None:
                steps.append(Step(before, point, math.dist(before, point) / max_feed, True))
            steps.append(Step(point, point, row["dwell_s"], True))
            before = point
    return Program(steps, max(row["feed_mm_per_min"] for row in rows) / SECONDS_PER_MINUTE)


def read_feed_table(file):
    """Reads feed.csv by the rules of its motion: strokes about the points, or halts at them."""
    header, rows = read_table(file)
    if header["motion"] == "moving":
        return read_moving_table(rows)
    return read_halting_table(rows, float(header["max_feed_mm_per_min"]) / SECONDS_PER_MINUTE)
