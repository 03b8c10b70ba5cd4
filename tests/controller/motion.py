"""A recorded motion, and the motion that `dwell simulate --motion-table` writes, in the same terms.

Times are in s, lengths in mm. Both are of one run with the tool down: the tool comes down once, works and goes up.
"""

import dataclasses
import math

import numpy

from controller import PERIOD_S, ControllerFault

AT_WORK_MM = 1e-6  # Z of a tool at work
AT_REST_MM = 2e-6  # places so near are the same, as rounded in a record of 6 decimals
NEAR_CORNER_MM = 2e-3  # where the middle of a stop is looked for
STRAIGHT_SHARE = 1e-4  # of the tool's width: a group of periods that is no wider lies on a straight line
PARTS_A_WIDTH = 8  # pieces of the motion for its removal: good to 1e-5 of it


@dataclasses.dataclass
class Work:
    """What a record holds from the tool's coming down to its going up."""

    places: numpy.ndarray  # x, y of every period
    first: int  # the last one at which it still rests at the first place
    last: int  # the first one at which it rests at the last place

    def total(self):
        return PERIOD_S * (self.last - self.first)


def work_of(recording):
    """The one stretch of a record in which the tool is down, after it was lifted first."""
    z = recording.places[:, 2]
    lifted = numpy.flatnonzero(z > AT_WORK_MM)
    if not len(lifted):
        raise ControllerFault("the record never shows the tool lifted; a program lifts it before the work")
    down = numpy.flatnonzero(z[lifted[0]:] <= AT_WORK_MM) + lifted[0]
    if not len(down):
        raise ControllerFault("the record never shows the tool at work")
    if (numpy.diff(down) != 1).any():
        raise ControllerFault("the record shows the tool lifted during the work; only programs without lifts are compared")
    places = recording.places[down, :2]
    moved = numpy.flatnonzero(numpy.hypot(*(places - places[0]).T) > AT_REST_MM)
    short = numpy.flatnonzero(numpy.hypot(*(places - places[-1]).T) > AT_REST_MM)
    if not len(moved):
        raise ControllerFault("the record shows no motion at work")
    return Work(places, moved[0] - 1, short[-1] + 1)


def stops_of_work(work, corners):
    """When the tool passes each of the places, in their order: the middle of the time that it is near."""
    times, at = [], work.first
    for number, corner in enumerate(corners):
        begin = at
        while True:
            block = work.places[begin:begin + 20000]
            near = numpy.flatnonzero(numpy.hypot(*(block - corner).T) <= NEAR_CORNER_MM)
            if len(near) or begin + 20000 >= len(work.places):
                break
            begin += 20000
        if not len(near):
            raise ControllerFault(f"the record does not come within {NEAR_CORNER_MM} mm of stop {number + 1} of "
                                  f"{len(corners)} at ({corner[0]:.4f}, {corner[1]:.4f}) mm after "
                                  f"{PERIOD_S * (at - work.first):.3f} s of work")
        first = last = begin + near[0]
        while last + 1 < len(work.places) and math.dist(work.places[last + 1], corner) <= NEAR_CORNER_MM:
            last += 1
        times.append(PERIOD_S * (0.5 * (first + last) - work.first))
        at = last
    return numpy.array(times)


@dataclasses.dataclass
class Table:
    """The rows of a motion table at work."""

    seconds: numpy.ndarray
    places: numpy.ndarray
    speed: numpy.ndarray

    def total(self):
        return self.seconds[-1] - self.seconds[0]

    def stops(self):
        """Places at which it rests between the first and the last, and the middle of each rest."""
        still = numpy.flatnonzero(self.speed == 0)
        groups = numpy.split(still, numpy.flatnonzero(numpy.diff(still) != 1) + 1)
        inner = [group for group in groups if 0 not in group and len(self.speed) - 1 not in group]
        times = [0.5 * (self.seconds[group[0]] + self.seconds[group[-1]]) - self.seconds[0] for group in inner]
        places = [self.places[group[0]] for group in inner]
        return numpy.array(places).reshape(-1, 2), numpy.array(times)


def read_table(file):
    """A motion table of `dwell`, from the row at which the work begins to the one at which it ends."""
    rows = numpy.loadtxt(file, delimiter=",", skiprows=count_heading(file))
    removes = numpy.flatnonzero(rows[:, 4] == 1)
    if not len(removes) or (numpy.diff(removes) != 1).any():
        raise ControllerFault(f"{file}: the tool must be at work in one stretch; it is in "
                              f"{1 + int((numpy.diff(removes) != 1).sum()) if len(removes) else 0}")
    rows = rows[max(0, removes[0] - 1):removes[-1] + 1]  # a row says what ends there
    while len(rows) > 2 and (rows[0, 1:3] == rows[1, 1:3]).all():  # the way down counts nothing
        rows = rows[1:]
    return Table(rows[:, 0], rows[:, 1:3], rows[:, 3])


def sampled(table):
    """The motion of a table as a record of it would be: its places at every period."""
    seconds = table.seconds - table.seconds[0]
    times = numpy.arange(0, seconds[-1], PERIOD_S)
    row = numpy.clip(numpy.searchsorted(seconds, times, side="right") - 1, 0, len(seconds) - 2)
    whole, since = seconds[row + 1] - seconds[row], times - seconds[row]
    gain = numpy.divide(table.speed[row + 1] - table.speed[row], whole, out=numpy.zeros(len(row)), where=whole > 0)
    along = table.places[row + 1] - table.places[row]
    length = numpy.hypot(*along.T)
    share = numpy.divide(table.speed[row] * since + 0.5 * gain * since**2, length, out=numpy.zeros(len(row)),
                         where=length > 0)
    places = numpy.concatenate([table.places[row] + share[:, None] * along, table.places[-1:]])
    return Work(places, 0, len(places) - 1)


def count_heading(file):
    """Lines before the first row of numbers."""
    with open(file, encoding="utf-8") as lines:
        return next(i for i, line in enumerate(lines) if line[0] in "-0123456789")


def distance_from_path(work, corners):
    """The largest distance of the recorded places from the chain of straight lines through the places [mm].

    The record is followed along the chain: a place belongs to the line that it is on or to a later one.
    """
    largest, line = 0.0, 0
    begin, end = corners[:-1], corners[1:]
    along = end - begin
    length = numpy.hypot(*along.T)
    for place in work.places[work.first:work.last + 1]:
        best = distance_from_line(place, begin[line], along[line], length[line])
        while line + 1 < len(begin):
            beyond = numpy.dot(place - begin[line], along[line]) >= length[line] ** 2 * (1 - 1e-9)
            following = distance_from_line(place, begin[line + 1], along[line + 1], length[line + 1])
            if not beyond and following >= best:
                break
            line, best = line + 1, following
        largest = max(largest, best)
    return largest


def distance_from_line(place, begin, along, length):
    share = min(1.0, max(0.0, float(numpy.dot(place - begin, along)) / length**2))
    return math.dist(place, begin + share * along)


def pieces(work, width):
    """Places and seconds that stand for the motion at work: groups of periods, each by places with its moments.

    A group reaches no farther than width / PARTS_A_WIDTH, so that the moments up to the second decide what it removes.
    On a straight stretch two places have these moments, around a corner four.
    """
    middle = 0.5 * (work.places[:-1] + work.places[1:])
    way = numpy.concatenate([[0], numpy.cumsum(numpy.hypot(*numpy.diff(middle, axis=0).T))])
    group = numpy.floor(way / (width / PARTS_A_WIDTH)).astype(int)
    starts = numpy.flatnonzero(numpy.diff(group, prepend=-1))
    counts = numpy.diff(numpy.append(starts, len(middle)))
    mean = numpy.add.reduceat(middle, starts) / counts[:, None]
    off = middle - numpy.repeat(mean, counts, axis=0)
    xx, yy, xy = (numpy.add.reduceat(product, starts) / counts
                  for product in (off[:, 0] ** 2, off[:, 1] ** 2, off[:, 0] * off[:, 1]))
    angle = 0.5 * numpy.arctan2(2 * xy, xx - yy)
    half, mid = numpy.hypot(0.5 * (xx - yy), xy), 0.5 * (xx + yy)
    wide, narrow = mid + half, numpy.maximum(0, mid - half)
    bent = narrow > (STRAIGHT_SHARE * width) ** 2
    places, seconds = [], []
    for turn, variance, which in ((0, wide, ~bent), (0, 2 * wide, bent), (math.pi / 2, 2 * narrow, bent)):
        direction = numpy.stack([numpy.cos(angle + turn), numpy.sin(angle + turn)], 1)
        reach = (numpy.sqrt(variance)[:, None] * direction)[which]
        places += [mean[which] + reach, mean[which] - reach]
        seconds += 2 * [PERIOD_S * counts[which] / (4 if which is bent else 2)]
    return numpy.concatenate(places), numpy.concatenate(seconds)
