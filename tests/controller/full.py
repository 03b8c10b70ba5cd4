"""The tables of docs/proof.md: the measured mirror udo-raster on LinuxCNC, a run at a time.

Every run that is done is kept in out/real/results.json, with what it depends on (its program, the axes, the path mode),
so that an interrupted judgement goes on where it was; so are the records, in out/real/logs unless --logs names a folder.
docs/proof.md is written anew after every run.
"""

import datetime
import hashlib
import json
import math
import os
import pathlib

import numpy

import dwell_program
import run as runs
from controller import SPEED_UP, ControllerFault, Limits
from height_map import HeightMap
from run import G61, G64, Case
from sampled_function import sampled

ROOT = pathlib.Path(__file__).resolve().parents[2]
DATA = ROOT.parent / "shared" / "data" / "udo-raster"
OUT = ROOT / "out" / "real"
SPECK = (26.18, 12.2, 0.7)  # circle that is dropped: x, y, radius [mm]
MACHINES = (Limits(50.0, 500.0), Limits(50.0, 50.0), Limits(20.0, 20.0))
CALIBRATION = ("random, seed 7", "random:pitch=1,overrun=5,seed=7", "0.1")
PLANS = (("raster, smooth", "raster:pitch=1,overrun=5", "0.1"), ("raster, rough", "raster:pitch=1,overrun=5", "1e-4"),
         ("random, seed 3", "random:pitch=1,overrun=5,seed=3", "0.1"),
         ("random, seed 4", "random:pitch=1,overrun=5,seed=4", "0.1"))
TIME_SHARE = {G61: 0.003, G64: 0.02}
REMOVALS = {"raster": 0.05, "random": 0.50}
BLENDED_REMOVALS = 0.15  # no target; of runs at 50 mm/s, 500 mm/s^2: raster, smooth 0.12, random 0.09
OVER_PLAN = {("raster, rough", "50-50"): 1.1, ("random, seed 3", "50-500"): 1.2, ("random, seed 4", "50-500"): 1.2,
             ("random, seed 3", "50-50"): 1.5, ("random, seed 4", "50-50"): 1.5}

PLAN_TIMEOUT_S = 3600  # rough plans solve many times

LEARNING = PLANS[2]
LOGS = 2  # rounds of correction by a run's own log
CORRECTED = {"50-500": 1.1, "50-50": 1.2}  # after the last of them: left over planned


class Results:
    """The runs that are done, on disk: each is written whole or not at all."""

    def __init__(self, file):
        self.file = file
        self.runs = json.loads(file.read_text(encoding="utf-8")) if file.exists() else {}

    def add(self, key, figures):
        self.runs[key] = figures
        partial = self.file.with_suffix(".tmp")
        partial.write_text(json.dumps(self.runs, indent=1), encoding="utf-8")
        os.replace(partial, self.file)


def key_of(program, limits, mode, machine=None):
    """Of a run, and of what is said of it with a machine file."""
    digests = [hashlib.sha256(file.read_bytes()).hexdigest()[:16] for file in (program, machine) if file]
    return f"{' '.join(digests)} {limits.speed:g} {limits.acceleration:g} {mode} x{SPEED_UP}"


def udo_raster():
    """The case of the measured mirror without its speck."""
    if not DATA.is_dir():
        raise ControllerFault(f"the measured data of ./dev real --full are missing: {DATA}")
    OUT.mkdir(parents=True, exist_ok=True)
    meta = json.loads((DATA / "meta.json").read_text(encoding="utf-8"))
    pixel, tif_pixel = meta["pixel_mm"][0], meta["tif_pixel_mm"][0]
    words = ["--map", str(DATA / "map_nm.csv"), "--map-pixel", repr(pixel), "--tif", str(DATA / "tif_nm_per_s.csv"),
             "--tif-pixel", repr(tif_pixel), "--map-steps", "drop:circle:" + ",".join(map(str, SPECK))]
    tool = dwell_program.run_json("tif", words[5], "--tif-pixel", repr(tif_pixel), folder=OUT)["tool"]
    part = HeightMap(numpy.loadtxt(DATA / "map_nm.csv", delimiter=","), (pixel, pixel), (0.0, 0.0))
    x, y = numpy.meshgrid(part.x(), part.y())
    part.heights[numpy.hypot(x - SPECK[0], y - SPECK[1]) <= SPECK[2]] = math.nan
    rates = HeightMap(numpy.loadtxt(DATA / "tif_nm_per_s.csv", delimiter=","), (tif_pixel, tif_pixel), (0.0, 0.0), "nm/s")
    function = sampled(rates, tool["axis_in_file_mm"], tool["fwhm_x_mm"])
    return Case(OUT, words, part, function, 1)


def recorded(logs, name, program, limits, seconds, machine):
    """The run of a program, from the logs if it is there."""
    run = runs.kept(logs, name, program)
    if run is None:
        run = runs.record(program, limits, seconds)
        runs.keep(logs, name, run, machine, limits)
    return run


def judge(report, logs):
    logs = logs or OUT / "logs"
    case, results = udo_raster(), Results(OUT / "results.json")
    for limits in MACHINES:
        machine = f"{limits.speed:g}-{limits.acceleration:g}"
        report.say(f"\naxes of {limits.name()}")
        found = calibrate(case, results, limits, machine, logs)
        report.say(f"  fitted on {CALIBRATION[0]}: {found['acceleration']:.4g} mm/s^2, {1e3 * found['delay']:.3g} ms at a "
                   f"stop, {1e3 * found['scatter']:.3g} ms scatter")
        learnt = (found["acceleration"], found["delay"])
        machines = {G61: runs.machine_file(case, f"fitted-{machine}", limits, *learnt),
                    G64: runs.blending_file(case, f"blending-{machine}", limits)}
        for title, path, smoothness in PLANS:
            judge_plan(report, case, results, limits, machine, machines, title, path, smoothness, logs)
        if machine in CORRECTED:
            correct(report, case, results, limits, machine, logs)


def folder_of(title, machine):
    return title.replace(", ", "-").replace(" ", "-") + "-" + machine


def planned(case, results, name, *words):
    """The summary of a plan, made unless it was."""
    key = "plan " + " ".join(map(str, (name, *words)))
    if key not in results.runs or not (case.folder / name / "program.nc").exists():
        summary = runs.plan(case, name, *words, timeout=PLAN_TIMEOUT_S)
        results.add(key, {"planned_nm": summary["motion"]["planned_rms_nm"],
                          "said_nm": summary["program"]["residual_rms_nm"], "total_s": summary["program"]["total_s"]})
    return results.runs[key]


def calibrate(case, results, limits, machine, logs):
    title, path, smoothness = CALIBRATION
    name = folder_of(title, machine)
    ideal = runs.machine_file(case, f"ideal-{machine}", limits, limits.acceleration, 0.0)
    plan = planned(case, results, name, "--path", path, "--smoothness", smoothness, "--machine", ideal.name)
    program = runs.program_with(case, name, G61)
    key = "fit " + key_of(program, limits, G61)
    if key not in results.runs:
        run = recorded(logs, name + "-g61", program, limits, plan["total_s"], ideal)
        found = runs.fit(case, run, limits)
        results.add(key, vars(found))
    return results.runs[key]


def judge_plan(report, case, results, limits, machine, machines, title, path, smoothness, logs):
    name = folder_of(title, machine)
    plan = planned(case, results, name, "--path", path, "--smoothness", smoothness, "--machine", machines[G61].name)
    report.say(f"\n{title} on {limits.name()}: planned {plan['planned_nm']:.4g} nm, executed as dwell says "
               f"{plan['said_nm']:.4g} nm in {plan['total_s']:.5g} s")
    for mode in (G61, G64):
        program = runs.program_with(case, name, mode)
        key = key_of(program, limits, mode, machines[mode])
        if key not in results.runs:
            simulated = runs.simulate(case, program, machines[mode])
            run = recorded(logs, f"{name}-{mode[:3].lower()}", program, limits, plan["total_s"], machines[mode])
            seen = runs.compare(case, run, *simulated, stops=mode == G61)
            results.add(key, {**vars(seen), "title": title, "machine": machine, "mode": mode, **plan,
                              "date": datetime.date.today().isoformat()})
        hold(report, results.runs[key])
        write_proof(results)


def correct(report, case, results, limits, machine, logs):
    """A path of corners that is planned for the machine of the data sheet, and again by the logs of its runs."""
    title, path, smoothness = LEARNING
    words = ("--path", path, "--smoothness", smoothness, "--machine", f"ideal-{machine}.toml")
    last, planned_nm = None, None
    for number in range(LOGS + 1):
        name = f"{folder_of(title, machine)}-log-{number}"
        by_log = ("--log", str(logs.resolve() / f"{last}-g61" / "log.csv"), "--log-plan", last) if last else ()
        plan = planned(case, results, name, *words, *by_log)
        planned_nm = planned_nm or plan["planned_nm"]
        program = runs.program_with(case, name, G61)
        key = "corrected " + key_of(program, limits, G61)
        if key not in results.runs:
            run = recorded(logs, f"{name}-g61", program, limits, plan["total_s"], case.folder / f"ideal-{machine}.toml")
            left = case.part.heights - runs.removal_of(case, run.work)
            results.add(key, {"title": title, "machine": machine, "logs": number, "recorded_s": run.work.total(),
                              "said_s": plan["total_s"], "said_nm": plan["said_nm"], "planned_nm": planned_nm,
                              "residual_nm": runs.rms(case, left), "date": datetime.date.today().isoformat()})
        row = results.runs[key]
        report.say(f"\n{title} on {limits.name()} as set, corrected by {number} of its logs: {row['recorded_s']:.2f} s, "
                   f"{row['residual_nm']:.4g} nm left, as dwell says {row['said_nm']:.4g} nm in {row['said_s']:.2f} s "
                   f"({row['date']})")
        if number == LOGS:
            report.hold("left over planned", row["residual_nm"] / row["planned_nm"], CORRECTED[machine])
        write_proof(results)
        last = name


def hold(report, row):
    kind = row["title"].partition(",")[0]
    report.say(f"  {row['mode']}: {row['recorded_s']:.2f} s, {row['residual_nm']:.4g} nm left ({row['date']})")
    report.hold("total time, share of difference", abs(row["simulated_s"] / row["recorded_s"] - 1), TIME_SHARE[row["mode"]])
    report.hold("difference of the removals over the residual", row["difference"],
                REMOVALS[kind] if row["mode"] == G61 else BLENDED_REMOVALS)
    if row["mode"] == G61:
        bound = OVER_PLAN.get((row["title"], row["machine"]))
        if bound:
            report.hold("left over planned", row["residual_nm"] / row["planned_nm"], bound)


def write_proof(results):
    rows = [row for row in results.runs.values() if "mode" in row]
    text = ["# What a real controller makes of the programs", "",
            "Written by `./dev real --full`: LinuxCNC (Debian's linuxcnc-uspace, in simulation, "
            f"{SPEED_UP} times as fast as the clock) ran each program and its commanded position was recorded every "
            "millisecond of the motion.",
            "The mirror is `udo-raster` without its speck (docs/papers.md), feeds up to 600 mm/min. Every plan was made "
            f"for a machine file that was fitted on the log of another program ({CALIBRATION[0]}), and",
            "`dwell simulate --machine` with that file says what should happen. What the recorded motion leaves was "
            "computed from the record by tests/independent, at the middle of every pixel (dwell's figure is of the mean over "
            "it), and so is the difference of the removals from that "
            "of dwell's motion table; what is left as simulated is dwell's own figure. G64 P0.01 rounds corners: it is simulated by the "
            "corner rule `blend`, with the acceleration that the axes are set to.", ""]
    for limits in MACHINES:
        machine = f"{limits.speed:g}-{limits.acceleration:g}"
        text += [f"## Axes of {limits.name()}", ""]
        text += ["| plan | mode | recorded, s | simulated, s | difference | left as recorded, nm | as simulated, nm | "
                 "removals differ by, of what is left | planned, nm | left over planned | date |",
                 "|---|---|---|---|---|---|---|---|---|---|---|"]
        for title, _, _ in PLANS:
            for mode in (G61, G64):
                found = [row for row in rows if (row["title"], row["machine"], row["mode"]) == (title, machine, mode)]
                text.append(line_of(title, mode, found[-1] if found else None))
        text += ["", *lines_of_corrected(results, machine)]
    (ROOT / "docs" / "proof.md").write_text("\n".join(text), encoding="utf-8")


def lines_of_corrected(results, machine):
    rows = [row for row in results.runs.values() if "logs" in row and row["machine"] == machine]
    if machine not in CORRECTED:
        return []
    text = ["Planned for axes as they are set in the controller, with no delay at a stop, and planned again by the log of "
            "the run with G61 (`--log`), and by that of the next:", "",
            "| plan | logs | recorded, s | as dwell says, s | left as recorded, nm | as dwell says, nm | planned, nm | "
            "left over planned | date |", "|---|---|---|---|---|---|---|---|---|"]
    for row in sorted(rows, key=lambda row: row["logs"]):
        text.append(f"| {row['title']} | {row['logs']} | {row['recorded_s']:.2f} | {row['said_s']:.2f} | "
                    f"{row['residual_nm']:.4f} | {row['said_nm']:.4f} | {row['planned_nm']:.4f} | "
                    f"{row['residual_nm'] / row['planned_nm']:.3f} | {row['date']} |")
    return [*text, ""]


def line_of(title, mode, row):
    if row is None:
        return f"| {title} | {mode} | not run yet |" + " |" * 8
    return (f"| {title} | {mode} | {row['recorded_s']:.2f} | {row['simulated_s']:.2f} | "
            f"{100 * (row['simulated_s'] / row['recorded_s'] - 1):+.2f} % | {row['residual_nm']:.4f} | "
            f"{row['simulated_nm']:.4f} | {100 * row['difference']:.1f} % | {row['planned_nm']:.4f} | "
            f"{row['residual_nm'] / row['planned_nm']:.3f} | {row['date']} |")
