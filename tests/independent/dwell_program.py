"""Runs the program under test, which ctest names in the environment variable DWELL_PROGRAM."""

import json
import os
import subprocess

TIMEOUT_S = 300  # far above what a job of these tests takes, also under a sanitizer


def run(*arguments, folder, accepted=(0,), timeout=TIMEOUT_S):
    """Runs `dwell ARGUMENTS` in a folder and returns its standard output; an exit code not accepted is an error."""
    program = os.path.abspath(os.environ["DWELL_PROGRAM"])
    command = [program, *map(str, arguments)]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=timeout, check=False)
    if done.returncode not in accepted:
        raise AssertionError(f"{' '.join(command)}\nended with {done.returncode}:\n{done.stdout}{done.stderr}")
    return done.stdout


def run_json(*arguments, folder):
    """Runs a command with --json and returns what it printed."""
    return json.loads(run(*arguments, "--json", folder=folder))
