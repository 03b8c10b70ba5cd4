"""LinuxCNC's interpreter alone (rs274): whether it reads a program as the documents say that it is meant."""

import math
import pathlib
import re
import subprocess

from controller import ControllerFault
from machine_program import MM_PER_INCH, SECONDS_PER_MINUTE, part_of, read_gcode

DECIMAL = 1e-4  # the interpreter prints 4 decimals, of mm or, after G20, of inches
RATE_SHARE = 2e-6  # of a feed, beside its 4 decimals
TIMEOUT_S = 60
CALL = re.compile(r"\b([A-Z_]+)\(([^()]*)\)")


def canonical_calls(file, folder):
    """What the interpreter would have a machine do: [(name, [numbers])]."""
    (folder / "rs274.var").write_text("", encoding="ascii")
    (folder / "rs274.tbl").write_text("", encoding="ascii")
    done = subprocess.run(["rs274", "-v", "rs274.var", "-t", "rs274.tbl", "-g", str(file)], cwd=folder,
                          capture_output=True, text=True, timeout=TIMEOUT_S, stdin=subprocess.DEVNULL, check=False)
    calls = []
    for line in done.stdout.splitlines():
        found = CALL.search(line)
        if found and not found[1].startswith(("COMMENT", "MESSAGE")):
            numbers = [part.strip() for part in found[2].split(",")]
            calls.append((found[1], [float(n) for n in numbers if re.fullmatch(r"[-+]?[0-9.]+", n)]))
    if done.returncode != 0 or not any(name == "PROGRAM_END" for name, _ in calls):
        said = "\n".join((done.stdout + done.stderr).splitlines()[-6:])
        raise ControllerFault(f"{file}: LinuxCNC's interpreter stops (exit code {done.returncode}):\n{said}")
    return calls


def check(file, folder):
    """Holds what the interpreter makes of a program to what it should mean; returns the number of its moves and halts.

    The interpreter's places are the machine's; where they lie on the part, the program says.
    """
    text = pathlib.Path(file).read_text(encoding="ascii")
    unit = MM_PER_INCH if re.search(r"^(N\d+ )?G20$", text, re.MULTILINE) else 1
    on_part = part_of(text)
    feed, place, steps = math.nan, (math.nan,) * 3, []
    for name, numbers in canonical_calls(file, folder):
        if name == "SET_FEED_RATE":
            feed = unit * numbers[0]
        elif name == "DWELL":
            steps.append((place, place, numbers[0], None))
        elif name in ("STRAIGHT_FEED", "STRAIGHT_TRAVERSE"):
            before, place = place, (*on_part((unit * numbers[0], unit * numbers[1])), unit * numbers[2])
            if name == "STRAIGHT_FEED":
                steps.append((before, place, None, feed))
    meant = read_gcode(file).steps
    if len(steps) != len(meant):
        raise ControllerFault(f"{file}: LinuxCNC's interpreter makes {len(steps)} feed moves and halts of it; "
                              f"{len(meant)} are meant")
    for number, ((before, place, halt, rate), step) in enumerate(zip(steps, meant), 1):
        check_step(f"{file}: step {number}", before, place, halt, rate, step, unit * DECIMAL)
    return len(steps)


def check_step(where, before, place, halt, rate, step, decimal):
    """`decimal`: the last one of places [mm] and feeds [mm/min]."""
    off = max(math.dist(before[:2], step.start), math.dist(place[:2], step.end))
    if not off <= 2.2 * decimal:
        raise ControllerFault(f"{where}: from {before} to {place} mm in LinuxCNC's interpreter, meant from {step.start} to "
                              f"{step.end}")
    if halt is not None:
        if not abs(halt - step.seconds) <= 1e-4 + RATE_SHARE * step.seconds:
            raise ControllerFault(f"{where}: a halt of {halt} s in LinuxCNC's interpreter, meant {step.seconds} s")
        return
    length = step.length() or abs(place[2] - before[2])
    meant = SECONDS_PER_MINUTE * length / step.seconds
    # Of a move's length the interpreter knows what it reads, so that in G93 the rate is as exact as that.
    if not abs(rate - meant) <= decimal + RATE_SHARE * meant:
        raise ControllerFault(f"{where}: feed {rate} mm/min in LinuxCNC's interpreter, meant {meant:.6f}")
