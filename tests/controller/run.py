"""Plans, recorded runs and simulations of a part, and how they compare."""

import dataclasses
import functools
import json
import math
import pathlib
import re
import shutil

import numpy

import controller
import dwell_program
import motion
from height_map import HeightMap, read_npy, write_text
from machine_program import Program, Step
from removal_functions import RemovalFunction
from simulation import removal, without_form

G61 = "G61"
G64 = "G64 P0.01"
MAX_FEED = 600  # mm/min
TERMS = "piston,tilt"
SEARCHES = 14  # of the fit's golden section: the acceleration to 0.1 %
COARSE = 24  # pixels along the longer side, where only the motion is asked for
DONE = (0, 3)  # dwell's exit codes with outputs: done, done with a limit that it names


@dataclasses.dataclass
class Case:
    """A part with its tool, and the folder in which dwell works on it."""

    folder: pathlib.Path
    words: list  # options of dwell: map and removal function
    part: HeightMap
    function: RemovalFunction
    points: int = 2  # within a pixel, along each axis, for the removal computed here


@dataclasses.dataclass
class Run:
    """A program as LinuxCNC ran it."""

    program: pathlib.Path
    recording: controller.Recording

    @functools.cached_property
    def work(self):
        return motion.work_of(self.recording)


def machine_file(case, name, limits, acceleration, delay):
    """A machine file for LinuxCNC with such axes: the acceleration of each, and the rest at a stop [s]."""
    return write_machine(case, name, limits, acceleration, f"rule = \"exact-stop\"\ndelay_s = {delay!r}\n")


def blending_file(case, name, limits):
    """A machine file for LinuxCNC as it blends corners with G64 P, with the acceleration of its axes as they are set.

    The shares of it on arcs, and that these are no larger than the feeds need, are LinuxCNC's own (docs/motion.md).
    """
    return write_machine(case, name, limits, limits.acceleration,
                         f"rule = \"blend\"\narcs = \"as-needed\"\nacross_share = {math.sqrt(0.75)!r}\n"
                         "along_share = 0.5\n")


def write_machine(case, name, limits, acceleration, corner):
    axes = "".join(f"[{axis}]\nmax_speed_mm_per_s = {limits.speed!r}\nmax_acceleration_mm_per_s2 = {acceleration!r}\n"
                   for axis in "xy")
    file = case.folder / f"{name}.toml"
    file.write_text(f"schema = 1\nname = \"{name}\"\n[corner]\n{corner}{axes}", encoding="ascii")
    return file


def plan(case, name, *words, timeout=dwell_program.TIMEOUT_S):
    """Plans into the folder `name`; returns its summary."""
    dwell_program.run("plan", *case.words, "--remove", TERMS, "--max-feed", MAX_FEED, *words, "--out", name,
                      folder=case.folder, accepted=DONE, timeout=timeout)
    return json.loads((case.folder / name / "summary.json").read_text(encoding="utf-8"))


def program_with(case, name, mode):
    """The plan's program with a path mode of its own, or with none, in a file of its own."""
    text = (case.folder / name / "program.nc").read_text(encoding="utf-8")
    text = re.sub(r"(?m)^G6[14](\.1)?( [PQ][0-9.]+)*\n", "", text)
    file = case.folder / f"{name}-{(mode or 'any').replace(' ', '-').lower()}.nc"
    file.write_text(controller.with_path_mode(text, mode) if mode else text, encoding="utf-8")
    return file


def record(program, limits, seconds, k=controller.SPEED_UP):
    return Run(program, controller.run(program.read_text(encoding="ascii"), limits, seconds, k))


def simulate(case, program, machine):
    """What dwell says of a program on a machine: the motion, and the removal of it [nm]."""
    dwell_program.run("simulate", *case.words, "--remove", "none", "--program", program.name, "--machine", machine.name,
                      "--motion-table", "motion.csv", "--residual", "left.npy", folder=case.folder, accepted=DONE)
    return motion.read_table(case.folder / "motion.csv"), case.part.heights - read_npy(case.folder / "left.npy").heights


def simulated_motion(case, program, machine):
    """The motion alone, which neither the map nor the tool changes: a few coarse pixels in their place are quicker."""
    x, y = case.part.x(), case.part.y()
    pixel = float(max(x[-1] - x[0], y[-1] - y[0])) / COARSE
    shape = [math.ceil((axis[-1] - axis[0]) / pixel) + 1 for axis in (y, x)]
    slope = numpy.add.outer(numpy.arange(shape[0]), 2.0 * numpy.arange(shape[1]))
    write_text(case.folder / "coarse.csv", HeightMap(slope, (pixel, pixel), (float(x[0]), float(y[0]))))
    dwell_program.run("simulate", "--map", "coarse.csv", "--other-map", "--tif",
                      f"gaussian:peak=1,fwhm={4 * pixel:.6g}", "--other-tif", "--remove", "none", "--program", program.name,
                      "--machine", machine.name, "--motion-table", "motion.csv", folder=case.folder, accepted=DONE)
    return motion.read_table(case.folder / "motion.csv")


def removal_of(case, work):
    """What a motion takes off, by the quadrature of tests/independent [nm]."""
    places, seconds = motion.pieces(work, case.function.width)
    steps = [Step(tuple(place), tuple(place), time, True) for place, time in zip(places, seconds)]
    return removal(Program(steps, 0.0), case.function, case.part, case.points)


def rms(case, heights):
    """RMS without the form terms, over the part."""
    left = without_form(numpy.where(numpy.isfinite(case.part.heights), heights, math.nan), TERMS, case.part)
    return float(numpy.sqrt(numpy.nanmean(left**2)))


@dataclasses.dataclass
class Comparison:
    recorded_s: float
    simulated_s: float
    latest_s: float  # largest difference of the times at which a stop is passed; NaN where it is not stopped
    from_path_mm: float  # largest distance of a recorded place from the simulated way
    residual_nm: float  # left by the recorded motion
    simulated_nm: float
    difference: float  # RMS of the difference of the motions' removals, by one quadrature, over the recorded residual

    def time_share(self):
        return abs(self.simulated_s / self.recorded_s - 1)

    def lag_share(self):
        return self.latest_s / self.recorded_s


def compare(case, run, table, removed, stops=True):
    """A recorded run against a simulated one. `stops`: it comes to rest at corners, which a blended path does not."""
    latest, way = math.nan, table.places
    if stops:
        places, times = table.stops()
        late = motion.stops_of_work(run.work, places) - times
        latest = float(numpy.abs(late).max()) if len(late) else 0.0
        way = numpy.concatenate([table.places[:1], places, table.places[-1:]])
    off = motion.distance_from_path(run.work, way[numpy.diff(way, axis=0, prepend=math.inf).any(axis=1)])
    recorded = removal_of(case, run.work)
    residual = rms(case, case.part.heights - recorded)
    return Comparison(run.work.total(), table.total(), latest, off, residual, rms(case, case.part.heights - removed),
                      rms(case, recorded - removal_of(case, motion.sampled(table))) / residual)


@dataclasses.dataclass
class Fit:
    acceleration: float  # mm/s^2
    delay: float  # s at a stop
    scatter: float  # of the times from stop to stop that is left [s]
    stops: int


def fit(case, run, limits):
    """The acceleration and the rest at a stop with which dwell's model comes nearest to the times from stop to stop.

    The times between the stops of the record against those that dwell simulates: for an acceleration, the mean
    difference is the rest, and the acceleration is the one with the least scatter about it.
    """
    recorded = None

    def look(acceleration):
        nonlocal recorded
        table = simulated_motion(case, run.program, machine_file(case, "trial", limits, acceleration, 0.0))
        places, times = table.stops()
        if len(places) < 20:
            raise controller.ControllerFault(f"{run.program.name}: {len(places)} stops; 20 are needed for a fit")
        if recorded is None:
            recorded = numpy.diff(motion.stops_of_work(run.work, places))
        late = recorded - numpy.diff(times)
        return Fit(acceleration, max(0.0, float(late.mean())), float(late.std()), len(places))

    golden = (math.sqrt(5) - 1) / 2
    low, high = 0.6 * limits.acceleration, 1.05 * limits.acceleration
    left, right = (look(high - golden * (high - low)), look(low + golden * (high - low)))
    for _ in range(SEARCHES):
        if left.scatter < right.scatter:
            high, right = right.acceleration, left
            left = look(high - golden * (high - low))
        else:
            low, left = left.acceleration, right
            right = look(low + golden * (high - low))
    return min(left, right, key=lambda f: f.scatter)


def kept(logs, name, program):
    """The run of such a program that keep() left, if it did."""
    folder = logs / name
    if not (folder / "log.csv").exists() or (folder / "program.nc").read_bytes() != program.read_bytes():
        return None
    rows = numpy.loadtxt(folder / "log.csv", delimiter=",", skiprows=1)
    return Run(program, controller.Recording(rows[:, 1:]))


def keep(logs, name, run, machine, limits):
    """A log of a run as controllers' loggers write them: time and places, with its program and machine file."""
    if logs is None:
        return
    folder = logs / name
    folder.mkdir(parents=True, exist_ok=True)
    shutil.copy(run.program, folder / "program.nc")
    shutil.copy(machine, folder / "machine.toml")
    rows = numpy.column_stack([run.recording.seconds(), run.recording.places])
    numpy.savetxt(folder / "log.tmp", rows, delimiter=",", header="t_s,x_mm,y_mm,z_mm", comments="",
                  fmt=["%.3f", "%.6f", "%.6f", "%.6f"])
    (folder / "log.tmp").replace(folder / "log.csv")  # whole or not at all
    (folder / "README").write_text(
        f"LinuxCNC, axes of {limits.name()}, {run.program.name}: commanded places of every {1e3 * controller.PERIOD_S:g} "
        "ms, from before the\nprogram began to after its end; z > 0 is lifted. machine.toml is the machine file that it "
        "was planned for.\n", encoding="ascii")
