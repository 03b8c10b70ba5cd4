"""scipy.optimize.minimize(method="L-BFGS-B") with the objective and gradient by FFT."""

import numpy as np
import scipy.optimize

import problem as dwell


def solve(problem):
    options = {"maxiter": 10**9, "maxfun": 10**9, "maxcor": 17, "ftol": 0.0, "gtol": 0.0}
    bounds = scipy.optimize.Bounds(problem.lower, np.full(problem.n, np.inf))
    # The solver's own first step is the gradient, in its units: the objective is brought to the order of one.
    scale = 1.0 / problem.best

    def scaled(t):
        f, g = problem.objective_and_gradient(t)
        return scale * f, scale * g

    answer = scipy.optimize.minimize(scaled, problem.lower, jac=True, method="L-BFGS-B", bounds=bounds, options=options)
    return str(answer.message)


if __name__ == "__main__":
    dwell.main(solve)
