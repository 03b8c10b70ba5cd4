"""Holds docs/scale.md to real schedulers: GNU parallel and Slurm run its scripts, and what is merged from their parts is
compared, byte for byte, with the sweep done at once.

Part of ./dev real. The program under test is named by the environment variable DWELL_PROGRAM.
"""

import concurrent.futures
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

from slurm import Slurm, SlurmFault

HERE = pathlib.Path(__file__).resolve().parent
DOCUMENT = HERE.parent.parent / "docs" / "scale.md"
# Wall-clock seconds of the solves, which no two runs have alike.
SECONDS = [(re.compile(rb'"wall_s": [-+.0-9e]+'), b'"wall_s": *'),
           (re.compile(rb"operator applications?, [.0-9]+ s"), b"operator applications, * s")]
# The sweeps: that of the document, and one of each other command in its place.
SWEEPS = {
    "pareto": None,
    "paths": "exec dwell paths --job example/demo.toml --aperture circle:0,0,12 --smoothness 0.3 --time-price 0 "
             '--threads 1 --paths raster:pitch=2,spiral:pitch=2,hilbert:pitch=2 "$@"',
    "campaigns": "exec dwell figure simulate mirror --runs 1 --samples 4 --uncertainty tif-rate=15%,offset=0.3mm "
                 '"$@"',
}


def blocks_of(text):
    """The indented blocks of a document, without their indentation."""
    blocks, lines = [], []
    for line in [*text.splitlines(), "end"]:
        if line.startswith("    ") or (lines and not line):
            lines.append(line[4:])
        elif lines:
            blocks.append("\n".join(lines).strip() + "\n")
            lines = []
    return blocks


def block_with(blocks, word):
    found = [block for block in blocks if word in block]
    if len(found) != 1:
        raise AssertionError(f"{DOCUMENT}: {len(found)} blocks with '{word}', one is required")
    return found[0]


def without_seconds(data):
    for pattern, mask in SECONDS:
        data = pattern.sub(mask, data)
    return data


def result_of(folder, printed):
    """Everything that a sweep left: what it printed, and the bytes of its files by name."""
    files = {"(printed)": without_seconds(printed)}
    for file in sorted(folder.rglob("*")) if folder.exists() else []:
        if file.is_file():
            files[str(file.relative_to(folder))] = without_seconds(file.read_bytes())
    return files


class Judge:
    def __init__(self, folder, document):
        self.folder = folder
        self.blocks = blocks_of(document)
        (folder / "bin").mkdir()
        (folder / "bin" / "dwell").symlink_to(os.path.abspath(os.environ["DWELL_PROGRAM"]))
        self.environment = dict(os.environ, PATH=f"{folder / 'bin'}:{os.environ['PATH']}")
        self.failures = []

    def bash(self, script, folder, environment=None, accepted=(0,)):
        done = subprocess.run(["bash", "-euo", "pipefail", "-c", script], cwd=folder, capture_output=True, timeout=300,
                              env=environment or self.environment, check=False)
        if done.returncode not in accepted:
            raise AssertionError(f"{script}\nended with {done.returncode}:\n{done.stdout.decode()}{done.stderr.decode()}")
        return done.stdout

    def prepare(self, name):
        """A folder with the sweep's script and its inputs."""
        folder = self.folder / name
        folder.mkdir()
        script = block_with(self.blocks, "# sweep.sh")
        if SWEEPS[name]:
            script = re.sub(r"^exec dwell .*?\n$", lambda _: SWEEPS[name] + "\n", script, flags=re.S | re.M)
        (folder / "sweep.sh").write_text(script)
        (folder / "sweep.sh").chmod(0o755)
        (folder / "sweep.slurm").write_text(block_with(self.blocks, "#SBATCH"))
        (folder / "example").symlink_to(self.folder / "example")
        if name == "campaigns":
            self.bash("dwell figure new mirror --map example/mirror.csv --aperture circle:0,0,12 "
                      "--tif example/tif.csv --path raster:pitch=2 --threads 1", folder)
        return folder

    def at_once(self, name, folder):
        out = "" if name == "campaigns" else " --out sweep"
        printed = self.bash("./sweep.sh" + out, folder)
        result = result_of(folder / "sweep", printed)
        shutil.rmtree(folder / "sweep", ignore_errors=True)
        return result

    def compare(self, what, whole, folder, printed):
        merged = result_of(folder / "sweep", printed)
        differ = sorted(set(whole) ^ set(merged)) + [name for name in whole if whole[name] != merged.get(name)]
        shutil.rmtree(folder / "sweep", ignore_errors=True)
        shutil.rmtree(folder / "parts")
        if differ:
            self.failures.append(f"{what}: differ: {', '.join(differ)}")
            print(f"  NOT ACCEPTED: {self.failures[-1]}", flush=True)
        else:
            print(f"  {what}: {len(whole) - 1} files and what is printed are the same bytes as at once", flush=True)

    def merge_words(self, name):
        words = block_with(self.blocks, "parallel ").splitlines()[-1]
        return words if name != "campaigns" else re.sub(r" --out \S+", "", words)

    def try_parallel(self, wholes, folders):
        if not shutil.which("parallel"):
            self.not_tried("GNU parallel", "it is not installed (Debian's package is parallel)")
            return
        run = "\n".join(block_with(self.blocks, "parallel ").splitlines()[:-1])
        for name, folder in folders.items():
            self.bash(run, folder)
            self.compare(f"GNU parallel, {name}", wholes[name], folder, self.bash(self.merge_words(name), folder))

    def try_slurm(self, wholes, folders):
        try:
            place = self.folder / "slurm"
            place.mkdir()
            with Slurm(place) as slurm:
                environment = dict(self.environment, SLURM_CONF=slurm.environment["SLURM_CONF"])
                submit = block_with(self.blocks, "sbatch --parsable")

                def run(name):
                    merge = self.merge_words(name)
                    self.bash(re.sub(r"dwell merge [^']*(?=')", lambda _: merge, submit), folders[name], environment)

                with concurrent.futures.ThreadPoolExecutor(len(folders)) as pool:  # sbatch --wait asks every ten seconds
                    list(pool.map(run, folders))
                for name, folder in folders.items():
                    printed = (folder / "merged.txt").read_bytes()
                    self.compare(f"Slurm, {name}", wholes[name], folder, printed)
        except SlurmFault as fault:
            self.not_tried("Slurm", str(fault))

    def not_tried(self, what, why):
        bar = "#" * 80
        print(f"\n{bar}\n##  {what} WAS NOT TRIED, so that what docs/scale.md says of it IS NOT CHECKED:\n##  "
              + why.replace("\n", "\n##  ") + f"\n{bar}", flush=True)


def main():
    begin = time.monotonic()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(128 + signal.SIGTERM))  # the daemons are ended on the way out
    print("docs/scale.md on real schedulers", flush=True)
    with tempfile.TemporaryDirectory(prefix="dwell-scale-") as folder:
        judge = Judge(pathlib.Path(folder), DOCUMENT.read_text())
        judge.bash("dwell example --out example", judge.folder)
        folders = {name: judge.prepare(name) for name in SWEEPS}
        wholes = {name: judge.at_once(name, folder) for name, folder in folders.items()}
        done = time.monotonic()
        judge.try_parallel(wholes, folders)
        parallel = time.monotonic()
        judge.try_slurm(wholes, folders)
    print(f"  at once {done - begin:.0f} s, with GNU parallel {parallel - done:.0f} s, with Slurm "
          f"{time.monotonic() - parallel:.0f} s", flush=True)
    sys.exit(1 if judge.failures else 0)


main()
