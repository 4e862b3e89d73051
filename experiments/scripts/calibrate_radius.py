#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The quatro authors
# SPDX-License-Identifier: MIT
"""Fits the error radius by split conformal prediction, and measures its coverage.

    experiments/scripts/with_python.sh numpy,scipy experiments/scripts/calibrate_radius.py \\
        RESULTS.csv ...

The results come from run_pairs.py. Only registered poses within 2 m and 10 deg of the true
pose count. A hash of the scans' names selects the half that is fitted, as in
calibrate_verdict.py, and all numbers under "other half" are of the other one. For each
regime three factors are printed, those of robust/verdict/error_radius.cc:

    covariance   multiplies the covariance so that 95 % of the ellipsoids of 95 % cover the
                 true pose; at least 1
    translation  multiplies the deviation of the translation and rotation that of the rotation
                 (error_radius in the JSON), so that both errors are within the radius for 95 %
                 of the poses, of simulated pairs and of real ones; at least those of the
                 regime with the most pairs

The quantile of n values is the smallest that at least 0.95 (n + 1) of them do not exceed; with
fewer than 19 values it does not exist, and the largest value is taken. --shipped lists the
covariance factors that the program multiplied by. The listed true pose of real pairs has an
error of its own. Its covariance is added for the sets of --real: --truth_m on each axis and
--truth_deg about each axis, both at the source's origin.

Exit code: 0; 2 if a flag or a file is invalid, with one line that says which.
"""
import collections
import hashlib
import math

import numpy as np
from scipy import stats

from script_support import BadInput, Parser, parse_number, read_rows, run_script

COLUMNS = ("set", "source", "target", "status", "success_2m_10deg", "translation_error_m",
           "rotation_error_deg", "regime", "pose_error", "covariance", "deviation_m", "deviation_deg")
LIMIT = stats.chi2.ppf(0.95, 6)

# covariance is as the program gave it, over its factor; error is (w [rad], d [m]); scores are
# the errors over the deviations.
Case = collections.namedtuple("Case", "file set regime error covariance truth is_real scores "
                              "deviations is_reported")


def read_cases(paths, shipped, real, truth_m, truth_deg):
    """The registered poses near the true one, and how many registered poses have no radius."""
    truth = np.diag([math.radians(truth_deg) ** 2] * 3 + [truth_m ** 2] * 3)
    cases, num_without = [], 0
    for path in paths:
        for line, row in read_rows(path, COLUMNS)[0]:
            if row["status"] != "registered" or row["success_2m_10deg"] != "1":
                continue
            if not row["regime"] or not row["covariance"]:
                num_without += 1
                continue
            try:
                error = np.array([float(x) for x in row["pose_error"].split(";")])
                matrix = np.array([float(x) for x in row["covariance"].split(";")]).reshape(6, 6)
                deviations = np.array([float(row["deviation_m"]), float(row["deviation_deg"])])
                errors = [float(row["translation_error_m"]), float(row["rotation_error_deg"])]
            except ValueError:
                raise BadInput(f"{path}: line {line} is not of run_pairs.py") from None
            is_real = row["set"] in real
            digest = hashlib.sha256(f"{row['source']} {row['target']}".encode()).digest()
            cases.append(Case(path, row["set"], row["regime"], error,
                              matrix / shipped.get(row["regime"], 1.0),
                              truth if is_real else 0.0 * truth, is_real,
                              errors / deviations, deviations, digest[0] % 2 == 1))
    if not cases:
        raise BadInput(f"{paths[0]}: there are no registered poses with a radius")
    return cases, num_without


def nees(case, factor):
    return case.error @ np.linalg.solve(factor * case.covariance + case.truth, case.error)


def conformal(values, share=0.95):
    values = sorted(values)
    return values[min(len(values), math.ceil(share * (len(values) + 1))) - 1]


def fit(cases):
    """The three factors of a regime."""
    factor = 1.0
    for _ in range(60):  # The covariance of the truth does not scale.
        largest = conformal([nees(case, factor) for case in cases])
        if largest <= LIMIT:
            break
        factor *= 1.05 if largest < 2.0 * LIMIT else 1.5
    # The larger factor of simulated and real pairs, if there are enough of both.
    radius = np.zeros(2)
    for is_real in (False, True):
        both = np.array([case.scores for case in cases if case.is_real == is_real])
        if len(both) < 19 and len(both) < len(cases) / 2:
            continue
        units = np.quantile(both, 0.9, axis=0)
        radius = np.maximum(radius, conformal((both / units).max(axis=1)) * units)
    return (factor, *radius)


def interval(k, n):
    """Of a rate, by Clopper and Pearson, 95 %."""
    low = stats.beta.ppf(0.025, k, n - k + 1) if k > 0 else 0.0
    high = stats.beta.ppf(0.975, k + 1, n - k) if k < n else 1.0
    return f"{k} of {n} ({100 * low:.0f}-{100 * high:.0f} %)"


def describe(name, cases, factors):
    if not cases:
        return
    q = np.array([nees(case, factors[case.regime][0]) for case in cases])
    radius = np.array([case.scores for case in cases])
    limits = np.array([factors[case.regime][1:] for case in cases])
    sizes = limits * [case.deviations for case in cases]
    covered, within = int((q <= LIMIT).sum()), int((radius <= limits).all(axis=1).sum())
    n = len(cases)
    print(f"{name}: normalized squared error {np.median(q):.2f} in the median; ellipsoid covers "
          f"{interval(covered, n)}, p = {stats.binomtest(covered, n, 0.95).pvalue:.2f}; radius "
          f"{np.median(sizes[:, 0]):.3f} m and {np.median(sizes[:, 1]):.2f} deg in the median, holds "
          f"for {interval(within, n)}, p = {stats.binomtest(within, n, 0.95).pvalue:.2f}")


def main(args):
    parser = Parser(__doc__)
    parser.add_argument("results", metavar="RESULTS.csv", nargs="+", help="of run_pairs.py")
    parser.add_argument("--shipped", default="", metavar="REGIME=F,...",
                        help="covariance factors of the program that made the results")
    parser.add_argument("--real", default="", metavar="SET,SET", help="sets of real pairs")
    parser.add_argument("--truth_m", type=float, default=0.03, help="(default: 0.03)")
    parser.add_argument("--truth_deg", type=float, default=0.1, help="(default: 0.1)")
    options = parser.parse_args(args)
    shipped = {}
    for item in filter(None, options.shipped.split(",")):
        name, _, value = item.partition("=")
        shipped[name] = parse_number(value, f"--shipped={item}")
    real = set(options.real.split(","))
    cases, num_without = read_cases(options.results, shipped, real, options.truth_m,
                                    options.truth_deg)
    print(f"{len(cases)} registered poses with a radius, {num_without} without")
    fitted = collections.defaultdict(list)
    for case in cases:
        if not case.is_reported:
            fitted[case.regime].append(case)
    without = {case.regime for case in cases} - fitted.keys()
    if without:
        raise BadInput(f"regime {min(without)}: there is no pair to fit to")
    factors = {regime: fit(of_regime) for regime, of_regime in sorted(fitted.items())}
    largest = factors[max(fitted, key=lambda regime: len(fitted[regime]))]
    for regime, (covariance, *radius) in factors.items():
        factors[regime] = (covariance, *np.maximum(radius, largest[1:]))
        print("{}: covariance {:.3g}, translation {:.3g}, rotation {:.3g}, fitted to {} pairs"
              .format(regime, *factors[regime], len(fitted[regime])))
    print("\nother half")
    reported = [case for case in cases if case.is_reported]
    simulated = [case for case in reported if case.set not in real]
    describe("simulated", simulated, factors)
    for regime in sorted(factors):
        describe(f"simulated, {regime}", [c for c in simulated if c.regime == regime], factors)
    describe("real", [case for case in reported if case.set in real], factors)
    for regime in sorted(factors):
        describe(f"real, {regime}", [c for c in reported if c.set in real and c.regime == regime],
                 factors)
    for path in sorted({case.file for case in reported}):
        describe(path, [case for case in reported if case.file == path], factors)


if __name__ == "__main__":
    run_script(main)
