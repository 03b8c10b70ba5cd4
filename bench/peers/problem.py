"""A dwell problem as bench/script_problem.cpp writes it, for solvers of other people.

    minimise  1/2 |P (A t - z)|^2 + alpha/2 |D (t - l)|^2 + gamma sum(t)   subject to  t >= l

Shares no code with the program: the removal is put together here from the kernel and the strokes, and compared with
what the program's own operator removes before anything is timed.
"""

import json
import os
import pathlib
import signal
import sys
import time

import numpy as np
import scipy.fft
import scipy.sparse


class Done(Exception):
    """Raised out of a solver that has arrived or has no time left."""


def bspline_weights(f):
    """The cubic B-spline's four weights at the fraction f between two nodes, one row a point."""
    g = 1.0 - f
    return np.stack([g**3, 3.0 * f**3 - 6.0 * f**2 + 4.0, 3.0 * g**3 - 6.0 * g**2 + 4.0, f**3], axis=-1) / 6.0


class Problem:
    """The arrays of the folder, and what is computed from them."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        words = json.loads((self.folder / "problem.json").read_text())
        self.alpha, self.gamma = words["alpha"], words["gamma"]
        self.max_seconds, self.target = words["max_seconds"], words["target_objective"]
        self.scale_of_total, self.scale_of_objective = words["scale_of_total"], words["scale_of_objective"]
        self.threads = words["threads"]
        self.n, self.m = words["points"], words["pixels"]
        self.z = self._load("target")
        self.form = self._load("form").reshape(words["form_terms"], self.m)
        self.lower = self._load("lower")
        self.scale, self.linked = self._load("smooth_scale"), self._load("smooth_linked") > 0.0
        self.applications = 0
        self._make_operator(words)
        self._check_operator()
        # Whoever finds nothing better has the least dwell.
        self.best, r = self.judge(self.lower)
        self.best_t = self.lower.copy()
        self.trace = [[0.0, self.best, self._rms(r), 0.0]]
        self.begin = time.perf_counter()

    def _load(self, name):
        return np.load(self.folder / (name + ".npy"))

    def _make_operator(self, words):
        kernel = self._load("kernel").reshape(words["kernel_rows"], words["kernel_cols"])
        u, v = self._load("point_u"), self._load("point_v")
        weight, stroke = self._load("point_weight"), self._load("point_stroke").astype(np.int64)
        on_nodes = len(u) == self.n and np.abs(u - np.rint(u)).max() < 1e-9 and np.abs(v - np.rint(v)).max() < 1e-9
        if on_nodes:
            # Halts on nodes of the lattice: the spline of the kernel is wanted at nodes alone, so one entry a point will
            # do in place of sixteen.
            b = np.array([1.0, 4.0, 1.0]) / 6.0
            kernel = np.apply_along_axis(np.convolve, 0, kernel, b)
            kernel = np.apply_along_axis(np.convolve, 1, kernel, b)
        half_r, half_c = kernel.shape[0] // 2, kernel.shape[1] // 2
        cols = words["cols"]
        pixel = self._load("pixel").astype(np.int64)
        r0, c0 = pixel.min() // cols, (pixel % cols).min()
        r1, c1 = pixel.max() // cols, (pixel % cols).max()
        # Nodes that reach a counted pixel, and room for what wraps around.
        self.shape = (scipy.fft.next_fast_len(int(r1 - r0) + 1 + 2 * half_r, real=True),
                      scipy.fft.next_fast_len(int(c1 - c0) + 1 + 2 * half_c, real=True))
        field = (int(r1 - r0) + 1 + 2 * half_r, int(c1 - c0) + 1 + 2 * half_c)
        padded = np.zeros(self.shape)
        padded[: kernel.shape[0], : kernel.shape[1]] = kernel
        self.transfer = scipy.fft.rfft2(padded, workers=self.threads)
        # The full linear convolution begins at the kernel's first row; a pixel (r, c) is its row r - r0 + 2 half.
        self.pick = (pixel // cols - r0 + 2 * half_r) % self.shape[0], (pixel % cols - c0 + 2 * half_c) % self.shape[1]
        self.pick = self.pick[0] * self.shape[1] + self.pick[1]
        origin = np.array([r0 - half_r, c0 - half_c])
        self.gather = self._gather(u, v, weight, stroke, origin, field, on_nodes)
        self.spread = self.gather.T.tocsr()

    def _gather(self, u, v, weight, stroke, origin, field, on_nodes):
        """The nodes' shares of the strokes: a sparse matrix of strokes x nodes, made from some strokes at a time."""
        blocks = []
        size, some = self.shape[0] * self.shape[1], 50_000
        for first in range(0, self.n, some):
            last = min(first + some, self.n)
            part = slice(*np.searchsorted(stroke, [first, last]))
            if on_nodes:
                r, c = np.rint(v[part]).astype(np.int64), np.rint(u[part]).astype(np.int64)
                w, j = weight[part], stroke[part]
            else:
                fu, fv = np.floor(u[part]), np.floor(v[part])
                wx, wy = bspline_weights(u[part] - fu), bspline_weights(v[part] - fv)
                w = (weight[part, None, None] * wy[:, :, None] * wx[:, None, :]).ravel()
                near = np.arange(-1, 3)
                r = np.repeat(fv.astype(np.int64)[:, None] + near, 4, axis=1).ravel()
                c = np.tile(fu.astype(np.int64)[:, None] + near, (1, 4)).ravel()
                j = np.repeat(stroke[part], 16)
            r, c = r - origin[0], c - origin[1]
            keep = (r >= 0) & (r < field[0]) & (c >= 0) & (c < field[1])
            node = r[keep] * self.shape[1] + c[keep]
            blocks.append(scipy.sparse.coo_matrix((w[keep], (j[keep] - first, node)), shape=(last - first, size)).tocsr())
        return scipy.sparse.vstack(blocks, format="csr")

    def apply(self, t):
        """A t [nm]."""
        self.applications += 1
        field = (self.spread @ t).reshape(self.shape)
        field = scipy.fft.rfft2(field, workers=self.threads)
        field *= self.transfer
        return scipy.fft.irfft2(field, s=self.shape, workers=self.threads).ravel()[self.pick]

    def adjoint(self, r):
        """A' r."""
        self.applications += 1
        field = np.zeros(self.shape[0] * self.shape[1])
        field[self.pick] = r
        field = scipy.fft.rfft2(field.reshape(self.shape), workers=self.threads)
        field *= self.transfer.conj()
        return self.gather @ scipy.fft.irfft2(field, s=self.shape, workers=self.threads).ravel()

    def _check_operator(self):
        wanted = self._load("check_removal")
        error = np.abs(self.apply(self._load("check_dwell")) - wanted).max() / np.abs(wanted).max()
        if not error <= 1e-6:
            sys.exit(f"the removal differs from the program's by {error:.2e} of its largest")
        self.applications = 0

    def project(self, r):
        """P r: piston and tilt taken out."""
        return r - self.form.T @ (self.form @ r)

    def steps(self, s):
        """D s for a surplus s; 0 where two strokes are not linked."""
        d = np.zeros(self.n)
        scaled = self.scale * s
        d[1:] = np.where(self.linked[1:], scaled[1:] - scaled[:-1], 0.0)
        return d

    def steps_adjoint(self, d):
        """D' d."""
        d = np.where(self.linked, d, 0.0)
        d[0] = 0.0
        out = d.copy()
        out[:-1] -= d[1:]
        return self.scale * out

    def _value(self, r, t):
        d = self.steps(t - self.lower)
        return 0.5 * r @ r + 0.5 * self.alpha * d @ d + self.gamma * t.sum()

    def objective_and_gradient(self, t):
        """The objective at t and its gradient. Notes the value beside the time."""
        r = self.project(self.apply(t) - self.z)
        f = self._value(r, t)
        d = self.steps(t - self.lower)
        g = self.adjoint(r) + self.alpha * self.steps_adjoint(d) + self.gamma
        self.note(f, r, t)
        return f, g

    def judge(self, t):
        """The objective at t and the residual, which is not counted as work."""
        applications = self.applications
        r = self.project(self.apply(t) - self.z)
        self.applications = applications
        return self._value(r, t), r

    def start(self):
        """The clock starts here: the solve alone, without imports and without putting the operator together."""
        self.applications = 0
        self.begin = time.perf_counter()

    def _rms(self, r):
        return np.sqrt(r @ r / self.m)

    def note(self, f, r, t, seconds=None):
        """Keeps the best dwell with time, objective, residual RMS and work; ends the solve where it has arrived or is late."""
        now = time.perf_counter() - self.begin if seconds is None else seconds
        if f < self.best and (t >= self.lower).all():
            self.best, self.best_t = f, t.copy()
            self.trace.append([now, f, self._rms(r), float(self.applications)])
        if self.target > 0.0 and self.best <= self.target:
            raise Done("target reached")
        if now > self.max_seconds:
            raise Done("time limit")

    def finish(self, status, message):
        """Writes the answer: the best dwell, the trace and one line of words."""
        np.save(self.folder / "answer.npy", self.best_t.reshape(1, -1))
        np.save(self.folder / "trace.npy", np.array(self.trace, dtype=float))
        words = {"status": status, "message": message, "seconds": time.perf_counter() - self.begin,
                 "applications": self.applications}
        # Last and in one step: it stands for a whole answer.
        (self.folder / "end.tmp").write_text(json.dumps(words))
        os.replace(self.folder / "end.tmp", self.folder / "end.json")


def main(solve):
    """Runs solve(problem), which returns a message, or raises Done."""
    problem = Problem(sys.argv[1])
    # Written before the solve: what is ended without an answer was late, and not broken.
    (problem.folder / "ready").write_text("")
    # Compiled solvers do not look at the clock: the alarm ends the process.
    signal.setitimer(signal.ITIMER_REAL, 4.0 * problem.max_seconds + 5.0)
    problem.start()
    try:
        status, message = "stopped by itself", solve(problem)
    except Done as end:
        status = message = str(end)
    problem.finish(status, message)
