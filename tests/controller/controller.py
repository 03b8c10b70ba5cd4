"""A real controller: runs a program on LinuxCNC (Debian's linuxcnc-uspace, without a screen) and records its motion.

LinuxCNC counts its time in servo periods, so a busy machine changes nothing, and it can run faster than the clock: with
every feed and speed limit times k, every acceleration times k^2 and the period divided by k (and its one other time,
of short moves with G64, likewise) the motion is the same, sampled at the same places, in 1/k of the time.
"""

import dataclasses
import decimal
import json
import os
import pathlib
import pwd
import re
import shutil
import signal
import subprocess
import tempfile

import numpy

SPEED_UP = 5  # at 10 it was measured to be the same still, at 20 the interpreter cannot feed the planner
PERIOD_S = 0.001  # of the motion, whatever the speed-up
RAMP_FREQUENCY = 100.0  # LinuxCNC's default [1/s of the motion]: with G64, moves that take less than its inverse are ramps
LOCK = pathlib.Path("/tmp/linuxcnc.lock")  # LinuxCNC's own: one runs on a machine at a time
STARTING_S = 60  # of the clock, for all that is not motion
HERE = pathlib.Path(__file__).resolve().parent
UNPRIVILEGED = "nobody"  # LinuxCNC refuses root
LIMIT_MM = 1000  # travel of every axis


class ControllerFault(Exception):
    """The controller cannot be run, or did not run the program."""


@dataclasses.dataclass(frozen=True)
class Limits:
    """Of every axis and of the path."""

    speed: float  # [mm/s]
    acceleration: float  # [mm/s^2]

    def name(self):
        return f"{self.speed:g} mm/s, {self.acceleration:g} mm/s^2"


@dataclasses.dataclass
class Recording:
    """Commanded places, one row for every PERIOD_S of the motion: x, y, z [mm]."""

    places: numpy.ndarray

    def seconds(self):
        return PERIOD_S * numpy.arange(len(self.places))


def require():
    """Says what is missing, if LinuxCNC is not here."""
    missing = [name for name in ("linuxcnc", "halsampler", "rs274") if not shutil.which(name)]
    if missing:
        raise ControllerFault(f"not installed: {', '.join(missing)}; apt-get install linuxcnc-uspace (./dev real does it "
                              "as root or with sudo)")


def with_path_mode(text, mode):
    """The program with a line such as G61 before its first motion."""
    lines = text.splitlines(keepends=True)
    first = next((i for i, line in enumerate(lines) if re.match(r"\s*(N\d+\s*)?G0*[014]\b", line)), None)
    if first is None:
        raise ControllerFault("the program has no line that begins with G0, G1 or G4")
    return "".join(lines[:first] + [f"{mode}\n"] + lines[first:])


def faster(text, factor):
    """The program with every F times the factor and the P of every G4 divided by it, to the last digit.

    In G94 F is mm/min, in G93 as LinuxCNC reads it 1/min: both grow with the speed.
    """
    def scaled(match):
        return match[1] + format(decimal.Decimal(match[2]) * factor, "f")

    lines = []
    for line in text.splitlines(keepends=True):
        if not line.startswith(("(", ";")):
            line = re.sub(r"(F)\s*([0-9.]+)", scaled, line)
            if re.match(r"\s*G0*4\b", line):
                line = re.sub(r"(P)\s*([0-9.]+)",
                              lambda m: m[1] + format(decimal.Decimal(m[2]) / factor, ".9f"), line)
        lines.append(line)
    return "".join(lines)


def ini_text(limits, k):
    """LinuxCNC's machine: three axes without a screen, homed where they stand."""
    speed, acceleration = limits.speed * k, limits.acceleration * k * k
    axis = (f"MIN_LIMIT = {-LIMIT_MM}\nMAX_LIMIT = {LIMIT_MM}\nMAX_VELOCITY = {speed!r}\n"
            f"MAX_ACCELERATION = {acceleration!r}\n")
    joint = axis + ("TYPE = LINEAR\nHOME = 0\nHOME_OFFSET = 0\nHOME_SEARCH_VEL = 0\nHOME_LATCH_VEL = 0\n"
                    "HOME_SEQUENCE = 0\nFERROR = 100\nMIN_FERROR = 100\n")
    axes = "".join(f"[AXIS_{letter}]\n{axis}[JOINT_{number}]\n{joint}" for number, letter in enumerate("XYZ"))
    return f"""[EMC]
VERSION = 1.1
MACHINE = dwell
DEBUG = 0
[DISPLAY]
DISPLAY = ./drive.py
[TASK]
TASK = milltask
CYCLE_TIME = 0.001
[RS274NGC]
PARAMETER_FILE = parameters.var
[EMCMOT]
EMCMOT = motmod
COMM_TIMEOUT = 4.0
SERVO_PERIOD = {round(PERIOD_S * 1e9 / k)}
[HAL]
HALFILE = machine.hal
[TRAJ]
COORDINATES = X Y Z
LINEAR_UNITS = mm
ANGULAR_UNITS = degree
DEFAULT_LINEAR_VELOCITY = {speed!r}
MAX_LINEAR_VELOCITY = {speed!r}
DEFAULT_LINEAR_ACCELERATION = {acceleration!r}
ARC_BLEND_RAMP_FREQ = {RAMP_FREQUENCY * k!r}
MAX_LINEAR_ACCELERATION = {acceleration!r}
NO_FORCE_HOMING = 1
[EMCIO]
EMCIO = io
CYCLE_TIME = 0.1
TOOL_TABLE = tools.tbl
[KINS]
KINEMATICS = trivkins
JOINTS = 3
{axes}"""


HAL_TEXT = """loadrt trivkins
loadrt [EMCMOT]EMCMOT servo_period_nsec=[EMCMOT]SERVO_PERIOD num_joints=[KINS]JOINTS
loadrt sampler depth=200000 cfg=fff
addf motion-command-handler servo-thread
addf motion-controller servo-thread
addf sampler.0 servo-thread
net x-place joint.0.motor-pos-cmd => joint.0.motor-pos-fb sampler.0.pin.0
net y-place joint.1.motor-pos-cmd => joint.1.motor-pos-fb sampler.0.pin.1
net z-place joint.2.motor-pos-cmd => joint.2.motor-pos-fb sampler.0.pin.2
net estop-loop iocontrol.0.user-enable-out => iocontrol.0.emc-enable-in
net tool-prepare-loop iocontrol.0.tool-prepare => iocontrol.0.tool-prepared
net tool-change-loop iocontrol.0.tool-change => iocontrol.0.tool-changed
"""


def unprivileged():
    """The user that LinuxCNC runs as: (uid, gid), or None if this is no root already."""
    if os.geteuid() != 0:
        return None
    entry = pwd.getpwnam(UNPRIVILEGED)
    return entry.pw_uid, entry.pw_gid


def launch(command, folder, log):
    """Starts a command in its own session as the unprivileged user, whose home is the folder."""
    user = unprivileged()
    as_user = {} if user is None else {"user": user[0], "group": user[1], "extra_groups": []}
    environment = {"PATH": "/usr/local/bin:/usr/bin:/bin", "HOME": str(folder), "LANG": "C.UTF-8"}
    return subprocess.Popen(command, cwd=folder, env=environment, stdin=subprocess.DEVNULL, stdout=log,
                            stderr=subprocess.STDOUT, start_new_session=True, **as_user)


def end_session(process, folder, log):
    """Ends a LinuxCNC that did not end by itself, and what it left: its real-time part and its lock."""
    for number in (signal.SIGTERM, signal.SIGKILL):
        try:
            os.killpg(process.pid, number)
            process.wait(20)
        except ProcessLookupError:
            pass
        except subprocess.TimeoutExpired:
            continue
        break
    launch(["halrun", "-U"], folder, log).wait(30)
    user = unprivileged()
    if LOCK.exists() and LOCK.stat().st_uid == (os.geteuid() if user is None else user[0]):
        LOCK.unlink()


def write_inputs(folder, program, limits, k, timeout):
    (folder / "program.nc").write_text(faster(program, k), encoding="ascii")
    (folder / "machine.ini").write_text(ini_text(limits, k), encoding="ascii")
    (folder / "machine.hal").write_text(HAL_TEXT, encoding="ascii")
    (folder / "tools.tbl").write_text("", encoding="ascii")
    (folder / "parameters.var").write_text("", encoding="ascii")
    (folder / "drive.json").write_text(json.dumps({"timeout_s": timeout}), encoding="ascii")
    shutil.copy(HERE / "drive.py", folder / "drive.py")
    (folder / "drive.py").chmod(0o755)
    user = unprivileged()
    if user is not None:
        for path in [folder, *folder.iterdir()]:
            os.chown(path, *user)


def log_of(folder):
    """What LinuxCNC said, the last lines of each of its logs."""
    texts = []
    for name in ("linuxcnc.log", "linuxcnc_debug.txt", "linuxcnc_print.txt"):
        file = folder / name
        lines = file.read_text(errors="replace").splitlines() if file.exists() else []
        texts += [f"  {name}: {line}" for line in lines[-25:]]
    return "\n".join(texts)


def read_samples(file):
    """The places of a record, refused if a period is missing."""
    text = file.read_text(encoding="ascii")
    if "overrun" in text:
        raise ControllerFault(f"{file.name}: periods were lost (\"overrun\"); the record must be whole")
    whole = text[:text.rfind("\n") + 1]
    rows = numpy.array(whole.split(), dtype=float).reshape(-1, 4) if whole else numpy.zeros((0, 4))
    if len(rows) < 2:
        raise ControllerFault(f"{file.name}: {len(rows)} samples; at least 2 are needed")
    steps = numpy.diff(rows[:, 0])
    if (steps != 1).any():
        raise ControllerFault(f"{file.name}: sample {rows[int(numpy.argmax(steps != 1)), 0]:.0f} is not followed by the "
                              "next; the record must be whole")
    return rows[:, 1:]


def run(program, limits, seconds, k=SPEED_UP):
    """Runs the text of a program, of about so many seconds of motion, and returns its Recording."""
    require()
    if LOCK.exists():
        raise ControllerFault(f"{LOCK} exists: another LinuxCNC runs on this machine, or one ended without tidying up; end "
                              "it, or remove the file")
    folder = pathlib.Path(tempfile.mkdtemp(prefix="dwell-controller-", dir="/tmp"))
    try:
        timeout = STARTING_S + 2 * seconds / k
        write_inputs(folder, program, limits, k, timeout)
        with open(folder / "linuxcnc.log", "wb") as log:
            process = launch(["linuxcnc", "-r", str(folder / "machine.ini")], folder, log)
            try:
                process.wait(timeout + 2 * STARTING_S)
            except BaseException:
                end_session(process, folder, log)
                raise
        outcome = folder / "outcome.json"
        if not outcome.exists():
            raise ControllerFault(f"LinuxCNC ended with {process.returncode} before it ran the program:\n{log_of(folder)}")
        fault = json.loads(outcome.read_text())["fault"]
        if fault:
            raise ControllerFault(f"LinuxCNC: {fault}\n{log_of(folder)}")
        return Recording(read_samples(folder / "samples.txt"))
    except subprocess.TimeoutExpired as error:
        raise ControllerFault(f"LinuxCNC did not end within {error.timeout:.0f} s:\n{log_of(folder)}") from error
    finally:
        shutil.rmtree(folder, ignore_errors=True)
