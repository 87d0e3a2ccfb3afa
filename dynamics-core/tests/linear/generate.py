"""Writes reference.json: random linear models, what is exact of them, and how far SciPy and slycot are from that.

    python3 -m venv v && v/bin/pip install numpy==2.4.6 scipy==1.17.1 slycot==0.7.1 mpmath==1.4.1
    v/bin/python generate.py > reference.json

Entries of the models are multiples of 1/8, of the badly scaled ones times powers of two: they are exact in the file.
Results are computed with 50 digits, rounded to doubles. Matrices are lists of rows; a P is its upper triangle. Errors of P
are max |dP_ij|/sqrt(P_ii P_jj), of others max |dX_ij| in the units in which states are of size 1, relative to max |X_ij|
there: so they do not depend on the states' units.
"""

import json

import mpmath as mp
import numpy as np
import scipy
import scipy.linalg
import scipy.signal
import slycot

mp.mp.dps = 50
SEED = 20251125
# states, inputs, the binary exponents of the states' units (spread), the decimal spread of rates
CASES = [
    (1, 1, 0, 0), (2, 1, 0, 0), (3, 2, 0, 0), (4, 1, 0, 0), (6, 2, 0, 0), (8, 3, 0, 0), (12, 3, 0, 0),
    (4, 2, 20, 0), (6, 2, 15, 0), (12, 1, 12, 0), (4, 2, 0, 3), (6, 1, 0, 2),
]


def matrix(rows, of=mp.mpf):
    return mp.matrix([[of(float(x)) for x in row] for row in rows])


def solve(a, b):
    """A^-1 B of matrices; mpmath's takes columns."""
    columns = [mp.lu_solve(a, b[:, j]) for j in range(b.cols)]
    return mp.matrix([[column[i] for column in columns] for i in range(a.rows)])


def rounded(m):
    return [[float(m[i, j]) for j in range(m.cols)] for i in range(m.rows)]


def upper(m):
    return [float(m[i, j]) for i in range(m.rows) for j in range(i, m.cols)]


def newton(a, g, q, p, discrete):
    """Polishes a stabilising P: A'P + PA - PGP + Q = 0, or P = A'P(1 + GP)^-1 A + Q."""
    n = a.rows
    one = mp.eye(n)
    for _ in range(12):
        if discrete:
            closed = solve(one + g * p, a)
            rest = a.T * p * closed - p + q
        else:
            closed = a - g * p
            rest = a.T * p + p * a - p * g * p + q
        rest = (rest + rest.T) / 2
        system = mp.zeros(n * n)
        for i in range(n):
            for j in range(n):
                for k in range(n):
                    if discrete:
                        for l in range(n):
                            system[i * n + j, k * n + l] += closed[k, i] * closed[l, j]
                    else:
                        system[i * n + j, k * n + j] += closed[k, i]
                        system[i * n + j, i * n + k] += closed[k, j]
                if discrete:
                    system[i * n + j, i * n + j] -= 1
        step = mp.lu_solve(system, mp.matrix([-rest[i, j] for i in range(n) for j in range(n)]))
        step = mp.matrix([[step[i * n + j] for j in range(n)] for i in range(n)])
        p = p + (step + step.T) / 2
        if mp.norm(step, mp.inf) < mp.mpf(10) ** -40 * mp.norm(p, mp.inf):
            return p
    raise ArithmeticError("Newton's method does not converge")


def error_of_p(p, exact):
    n = exact.rows
    p = matrix(p)
    sizes = [mp.sqrt(exact[i, i]) for i in range(n)]
    return float(max(abs(p[i, j] - exact[i, j]) / sizes[i] / sizes[j] for i in range(n) for j in range(n)))


def error(x, exact, left, right):
    """Of a map from coordinates in units `right` to those in units `left`."""
    x = matrix(x)
    places = [(i, j) for i in range(exact.rows) for j in range(exact.cols)]
    size = max(abs(exact[i, j]) * right[j] / left[i] for i, j in places)
    return float(max(abs(x[i, j] - exact[i, j]) * right[j] / left[i] for i, j in places) / size)


def eighths(random, *shape):
    return random.integers(-16, 17, shape) / 8


def riccati(a, b, q, r, discrete):
    ours = (scipy.linalg.solve_discrete_are if discrete else scipy.linalg.solve_continuous_are)(a, b, q, r)
    g = b @ np.linalg.solve(r, b.T)
    try:
        # In discrete time with A itself, the eigenvalues wanted are those outside of the circle. It overwrites.
        dico, sort = ("D", "U") if discrete else ("C", "S")
        theirs = slycot.sb02md(len(a), a.copy(), g.copy(), q.copy(), dico, hinv="D", sort=sort)[0]
    except (slycot.exceptions.SlycotError, ValueError):  # some of the badly scaled ones
        theirs = None
    mb = matrix(b)
    exact = newton(matrix(a), mb * solve(matrix(r), mb.T), matrix(q), matrix(ours), discrete)
    weight = matrix(r) + mb.T * exact * mb if discrete else matrix(r)
    gain = solve(weight, mb.T * exact * matrix(a) if discrete else mb.T * exact)
    return {
        "p": upper(exact),
        "k": rounded(gain),
        "scipy": error_of_p(ours, exact),
        "slycot": None if theirs is None else error_of_p(theirs, exact),
    }


def placed(a, b, units):
    """The one gain of a single input, by Ackermann's formula in 50 digits."""
    n = len(a)
    desired = [complex(-1 - k // 2, 1 + k // 2) if k % 2 == 0 and k + 1 < n else
               complex(-1 - k // 2, -1 - k // 2) if k % 2 else complex(-n, 0) for k in range(n)]
    ma, mb = matrix(a), matrix(b)
    powers = mp.zeros(n)
    column = mb
    for j in range(n):
        for i in range(n):
            powers[i, j] = column[i]
        column = ma * column
    polynomial = mp.eye(n)
    for pole in desired:
        polynomial = polynomial * (ma - mp.mpc(pole) * mp.eye(n))
    last = mp.zeros(n, 1)
    last[n - 1] = 1
    gain = (mp.lu_solve(powers.T, last).T * polynomial).apply(mp.re)
    theirs = scipy.signal.place_poles(a, b, desired).gain_matrix
    return {"desired": [[p.real, p.imag] for p in desired], "k": rounded(gain)[0],
            "scipy": error(theirs, gain, [1], units)}


def case(random, n, m, spread, rates):
    units = [2.0 ** int(e) for e in random.integers(-spread, spread + 1, n)] if spread else [1.0] * n
    a = eighths(random, n, n)
    if rates:
        a = np.diag([10.0 ** float(k) for k in np.round(np.linspace(0, rates, n))]) @ a
    b, root = eighths(random, n, m), eighths(random, n, n)
    q = root.T @ root
    r = np.eye(m) + np.ones((m, m)) / 4
    d, inverse = np.diag(units), np.diag([1 / u for u in units])
    a, b, q = d @ a @ inverse, d @ b, inverse @ q @ inverse
    # A step in which the fastest mode turns by half a radian.
    step = 2.0 ** round(np.log2(0.5 / max(abs(np.linalg.eigvals(inverse @ a @ d)))))
    ma, mb = matrix(a), matrix(b)
    block = mp.zeros(n + 2 * m)  # Van Loan's block matrix of the first-order hold
    block[:n, :n], block[:n, n:n + m] = ma * step, mb * step
    block[n:n + m, n + m:] = mp.eye(m)
    whole = mp.expm(block, method="taylor")
    phi, gamma, ramp = whole[:n, :n], whole[:n, n:n + m], whole[:n, n + m:]
    triangle = gamma + phi * ramp - ramp
    zoh = scipy.signal.cont2discrete((a, b, np.eye(n), np.zeros((n, m))), step, "zoh")
    poles, _ = mp.eig(ma)
    result = {
        "a": a.tolist(), "b": b.tolist(), "q": q.tolist(), "r": r.tolist(), "units": units, "step": step,
        "poles": sorted([[float(z.real), float(z.imag)] for z in poles], key=lambda z: (-z[0], -z[1])),
        "phi": rounded(phi), "gamma": rounded(gamma), "triangle": rounded(triangle),
        "phi_scipy": error(zoh[0], phi, units, units), "gamma_scipy": error(zoh[1], gamma, units, [1] * m),
        "continuous": riccati(a, b, q, r, False),
        "discrete": riccati(np.eye(n) + step * a, step * b, q, r, True),
    }
    if m == 1:
        result["placed"] = placed(a, b, units)
    return result


def staircase(random, n, m, lost):
    """A model of which `lost` modes are out of reach, in turned coordinates; slycot's rank."""
    a, b = eighths(random, n, n), eighths(random, n, m)
    a[n - lost:, :n - lost] = 0
    b[n - lost:] = 0
    # A rotation with entries that are exact: products of Householder's reflections of vectors of ±1, over 2^k.
    turn = np.eye(n)
    for _ in range(2):
        v = random.choice([-1.0, 1.0], n)
        v[: n - 4] = 0
        turn = turn @ (np.eye(n) - np.outer(v, v) / 2)
    a, b = turn @ a @ turn.T, turn @ b
    found = slycot.ab01nd(n, m, a, b)[2]
    return {"a": a.tolist(), "b": b.tolist(), "reached": n - lost, "slycot": int(found)}


random = np.random.default_rng(SEED)
models = [case(random, *what) for what in CASES]
pairs = [staircase(random, 6, 2, lost) for lost in (0, 1, 2, 3)]
versions = {"numpy": np.__version__, "scipy": scipy.__version__, "slycot": slycot.__version__, "mpmath": mp.__version__}
document = {"versions": versions, "seed": SEED, "models": models, "pairs": pairs}
lines = json.dumps(document, separators=(",", ":")).replace('{"a"', '\n{"a"').replace('},"pairs"', '},\n"pairs"')
print(lines)
