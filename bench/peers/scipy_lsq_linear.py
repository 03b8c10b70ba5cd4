"""scipy.optimize.lsq_linear with a LinearOperator by FFT: trust-region reflective steps, each solved by LSMR.

It knows sums of squares only, so smoothness and price become rows below the removal:

    |P (A s + A l - z)|^2 + |sqrt(alpha) D s|^2 + |eps sum(s) + gamma / eps|^2,   s = t - l >= 0,

whose last row is 2 gamma sum(s) and a constant but for eps^2 sum(s)^2, which is kept at 1e-7 of the objective. It has no
callback: it is run from the start with 1, 2, 4, ... iterations, and each of its answers is timed as if it had been the
only run.
"""

import time

import numpy as np
import scipy.optimize
import scipy.sparse.linalg

import problem as dwell


def solve(problem):
    n, m = problem.n, problem.m
    eps = np.sqrt(2e-7 * problem.scale_of_objective) / problem.scale_of_total
    root = np.sqrt(problem.alpha)

    begin = time.perf_counter()

    def rows(s):
        # The steps within an iteration have no end of their own.
        if time.perf_counter() - begin > problem.max_seconds:
            raise dwell.Done("time limit")
        s = np.asarray(s).ravel()
        return np.concatenate([problem.project(problem.apply(s)), root * problem.steps(s), [eps * s.sum()]])

    def columns(r):
        r = np.asarray(r).ravel()
        return (problem.adjoint(problem.project(r[:m])) + root * problem.steps_adjoint(r[m:m + n]) + eps * r[m + n])

    a = scipy.sparse.linalg.LinearOperator((m + n + 1, n), matvec=rows, rmatvec=columns, dtype=float)
    rest = problem.z - problem.apply(problem.lower)
    b = np.concatenate([problem.project(rest), np.zeros(n), [-problem.gamma / eps]])
    most = 1
    while True:
        problem.applications = 0
        begin = time.perf_counter()
        answer = scipy.optimize.lsq_linear(a, b, bounds=(0.0, np.inf), method="trf", lsq_solver="lsmr", tol=1e-15,
                                           lsmr_tol="auto", max_iter=most)
        seconds = time.perf_counter() - begin
        t = np.maximum(answer.x, 0.0) + problem.lower
        problem.note(*problem.judge(t), t, seconds)
        if answer.nit < most:
            return f"{answer.message} after {answer.nit} iterations"
        # The runs before are not counted, but they must end.
        if time.perf_counter() - problem.begin > 2.0 * problem.max_seconds:
            raise dwell.Done("time limit")
        most *= 2


if __name__ == "__main__":
    dwell.main(solve)
