"""Iterative Fourier inversion with thresholding: what workshops of ion-beam figuring use.

Written from the rule of Wang, Huang, Kang, Choi, Kim, Tayabaly and Idir, "RIFTA: a robust iterative Fourier
transform-based dwell time algorithm for ultra-precision ion beam figuring of synchrotron mirrors", Sci. Rep. 10:8135,
2020:

    dwell = inverse transform of Z / B',   B' = B where |B| > gamma max |B|, else B / |B| gamma max |B|,

with Z the transform of the surface and B that of the removal function. gamma is the one that leaves the least RMS in
the clear aperture, found by the simplex of Nelder and Mead. The surface is raised until its least height is zero, and
dwell times below zero are set to zero; then the same is done with what is left, and added, as long as that gains. The
surface lies on the lattice of the dwell points; beyond what is measured it goes on with its nearest height, and beyond
the lattice as its mirror image, so that the transform meets no step.

Where the text leaves a choice, the one that serves the method better is taken. On ibfest-70x30 that is setting dwell
below zero to zero, not taking off the least dwell everywhere, which left the same RMS in over twice the time; a
surface that goes on as its mirror image (0.301 nm), not periodically (0.47 nm); and the plane of the whole surface
taken off, not that of the clear aperture (14,800 s in place of 18,900 s).

Reads the folder that bench/field_method.cpp writes, and writes answer.npy and end.json.
"""

import json
import pathlib
import sys
import time

import numpy as np
import scipy.fft
import scipy.ndimage
import scipy.optimize

MOST_ITERATIONS = 10
LEAST_GAIN = 1e-3  # of the RMS, in an iteration


def plane_of(z, where):
    """Piston and tilt of z over the pixels `where`."""
    r, c = np.mgrid[: z.shape[0], : z.shape[1]]
    terms = np.stack([np.ones_like(z), r / max(z.shape), c / max(z.shape)])
    fit, *_ = np.linalg.lstsq(terms[:, where].T, z[where], rcond=None)
    return np.tensordot(fit, terms, axes=1)


class Inversion:
    """The tool on the lattice: what a dwell removes, and the thresholded inverse."""

    def __init__(self, kernel, shape, threads):
        self.kernel, self.grid, self.threads = kernel, shape, threads
        self.pad = [kernel.shape[0] // 2, kernel.shape[1] // 2]
        self.shape = [scipy.fft.next_fast_len(n + 2 * p, real=True) for n, p in zip(shape, self.pad)]
        centred = np.zeros(self.shape)
        centred[: kernel.shape[0], : kernel.shape[1]] = kernel
        self.b = self._forward(np.roll(centred, [-p for p in self.pad], (0, 1)))
        self.largest = np.abs(self.b).max()

    def _forward(self, field):
        return scipy.fft.rfft2(field, s=self.shape, workers=self.threads)

    def _back(self, spectrum):
        return scipy.fft.irfft2(spectrum, s=self.shape, workers=self.threads)

    def removal(self, dwell):
        """What it removes on the lattice: a linear convolution, no dwell beyond the lattice."""
        return self._back(self._forward(dwell) * self.b)[: self.grid[0], : self.grid[1]]

    def transform(self, z):
        """Of the surface with its mirror image around."""
        after = [s - n - p for s, n, p in zip(self.shape, self.grid, self.pad)]
        return self._forward(np.pad(z, list(zip(self.pad, after)), mode="symmetric"))

    def invert(self, spectrum, gamma):
        size = np.abs(self.b)
        floor = gamma * self.largest
        filter_ = np.where(size > floor, self.b, floor * np.where(size > 0.0, self.b / np.maximum(size, 1e-300), 1.0))
        field = self._back(spectrum / filter_)
        return field[self.pad[0]: self.pad[0] + self.grid[0], self.pad[1]: self.pad[1] + self.grid[1]]


def rms_left(z, where):
    left = z - plane_of(z, where)
    return np.sqrt(np.mean(left[where] ** 2))


def possible(dwell, allowed):
    """No dwell below zero, and none where the tool does not go."""
    return np.where(allowed, np.maximum(dwell, 0.0), 0.0)


def rifta(z, kernel, counted, allowed, threads):
    """The dwell, the first gamma and the number of iterations."""
    tool = Inversion(kernel, z.shape, threads)
    dwell, best, gamma_of_first, done = np.zeros(z.shape), np.inf, 0.0, 0
    for done in range(1, MOST_ITERATIONS + 1):
        spectrum = tool.transform(z - tool.removal(dwell))

        def next_dwell(log_gamma):
            return possible(dwell + tool.invert(spectrum, 10.0 ** log_gamma), allowed)

        def rms(x):
            log_gamma = float(np.clip(x[0], -6.0, -0.01))
            return rms_left(z - tool.removal(next_dwell(log_gamma)), counted)

        found = scipy.optimize.minimize(rms, [-1.5], method="Nelder-Mead",
                                        options={"initial_simplex": [[-2.0], [-1.0]], "xatol": 0.01, "maxiter": 60})
        log_gamma = float(np.clip(found.x[0], -6.0, -0.01))
        if not found.fun < best * (1.0 - LEAST_GAIN):
            done -= 1
            break
        best, dwell = found.fun, next_dwell(log_gamma)
        gamma_of_first = gamma_of_first or 10.0 ** log_gamma
    return dwell, gamma_of_first, done


def main():
    folder = pathlib.Path(sys.argv[1])
    words = json.loads((folder / "field.json").read_text())
    shape = words["rows"], words["cols"]
    heights = np.load(folder / "heights.npy").reshape(shape)
    counted = np.load(folder / "counted.npy").reshape(shape) > 0.0
    allowed = np.load(folder / "allowed.npy").reshape(shape) > 0.0
    kernel = np.load(folder / "kernel.npy").reshape(words["kernel_rows"], words["kernel_cols"])
    begin = time.perf_counter()
    missing = ~np.isfinite(heights)
    nearest = scipy.ndimage.distance_transform_edt(missing, return_distances=False, return_indices=True)
    z = heights[tuple(nearest)]
    z = z - plane_of(z, ~missing)
    z = z - z.min()
    dwell, gamma, iterations = rifta(z, kernel, counted, allowed, words["threads"])
    seconds = time.perf_counter() - begin
    np.save(folder / "answer.npy", dwell)
    end = {"seconds": seconds, "gamma": gamma, "iterations": iterations}
    (folder / "end.json").write_text(json.dumps(end))


if __name__ == "__main__":
    main()
