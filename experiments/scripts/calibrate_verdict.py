#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The quatro authors
# SPDX-License-Identifier: MIT
"""Fits the verdict's probability that a pose is correct, and shows how reliable it is.

    experiments/scripts/with_python.sh numpy,matplotlib experiments/scripts/calibrate_verdict.py \\
        [--picture=verdict.png] [--report=RESULTS.csv ...] RESULTS.csv ...

The results come from run_pairs.py, for pairs with and without overlap. A pose is
correct if it is within the tolerance in the JSON, which follows the scale of the scans
(2 m and 10 deg with preset kitti). The model is

    P = 1 / (1 + exp(-(w_0 + sum_j w_j x_j))),   w_j >= 0,

with the features x_j in the results. It is fitted to one half of the pairs by
minimizing the negative log-likelihood with a ridge on w_j (1e-3 per pair). A hash of
the scans' names selects the halves, so that they are the same in every run. The table,
the ROC curve and the reliability diagram use the other half. The model of matches alone
is fitted without places that have a twin, which matches cannot distinguish. Poses that
were searched for have a model of their own. The weights for
robust/verdict/success_model.cc are printed for the fitted half: the reported model is the
shipped one. With --report, all pairs of RESULTS.csv are fitted, and those of --report are
reported.

Exit code: 0; 2 if a flag or a file is invalid, with one line that says which.
"""
import collections
import contextlib
import hashlib

import numpy as np

from script_support import (BadInput, Parser, check_picture, read_rows, run_script,
                            save_picture, summary_stream)

Case = collections.namedtuple("Case", "set is_right features probability status is_reported")
COLUMNS = ("set", "source", "target", "status", "within_tolerance", "probability", "features")


def read_cases(paths, is_reported=None):
    """A hash of the names says which cases are reported, unless it is given."""
    cases = []
    for path in paths:
        for line, row in read_rows(path, COLUMNS)[0]:
            name = f"{row['source']} {row['target']}"
            digest = hashlib.sha256(name.encode()).digest()
            try:
                features = dict(item.split("=") for item in row["features"].split(";") if item)
                cases.append(Case(row["set"], row["within_tolerance"] == "1",
                                  {key: float(value) for key, value in features.items()},
                                  float(row["probability"] or 0.0), row["status"],
                                  digest[0] % 2 == 1 if is_reported is None else is_reported))
            except (AttributeError, ValueError):
                raise BadInput(f"{path}: line {line} is not of run_pairs.py") from None
    if not any(case.features for case in cases):
        raise BadInput(f"{paths[0]}: there are no pairs with an answer to fit to")
    return cases


def fit(x, y, ridge=1e-3, num_steps=200):
    """Intercept and weights >= 0: Newton's method, a weight that would go below 0 stays there."""
    x = np.hstack([np.ones((len(x), 1)), x])
    w = np.zeros(x.shape[1])
    penalty = np.full(x.shape[1], ridge * len(x))
    penalty[0] = 0.0
    free = np.ones(x.shape[1], bool)
    for _ in range(num_steps):
        p = 1.0 / (1.0 + np.exp(-x @ w))
        gradient = x.T @ (p - y) + penalty * w
        # Fixed at 0 only while it would become negative.
        free = (w > 0.0) | (gradient < 0.0)
        free[0] = True
        hessian = (x.T * (p * (1.0 - p))) @ x + np.diag(penalty + 1e-9)
        step = np.zeros_like(w)
        step[free] = np.linalg.solve(hessian[np.ix_(free, free)], gradient[free])
        scale = min(1.0, 5.0 / max(1e-12, np.abs(step).max()))
        w = w - scale * step
        w[1:] = np.maximum(w[1:], 0.0)
        if np.abs(step).max() < 1e-9:
            break
    return w


def probability(w, x):
    return 1.0 / (1.0 + np.exp(-(w[0] + x @ w[1:])))


def matrix(cases, names):
    return np.array([[case.features[name] for name in names] for case in cases])


def wilson(k, n):
    """95 % interval of a rate."""
    if n == 0:
        return 0.0, 1.0
    z, p = 1.96, k / n
    middle = (p + z * z / (2 * n)) / (1 + z * z / n)
    half = z / (1 + z * z / n) * (p * (1 - p) / n + z * z / (4 * n * n)) ** 0.5
    return max(0.0, middle - half), min(1.0, middle + half)


def report(title, y, p, threshold):
    right, wrong = p[y == 1], p[y == 0]
    accepted, mistaken = int((right >= threshold).sum()), int((wrong >= threshold).sum())
    low, high = wilson(mistaken, len(wrong))
    auc = np.mean([(right > q).mean() + 0.5 * (right == q).mean() for q in wrong]) \
        if len(right) and len(wrong) else float("nan")
    print(f"{title}: registered {accepted} of {len(right)} correct poses "
          f"({100 * accepted / max(1, len(right)):.1f} %), {mistaken} of {len(wrong)} incorrect poses "
          f"({100 * mistaken / max(1, len(wrong)):.2f} %, 95 % interval {100 * low:.2f}-"
          f"{100 * high:.2f} %), area under the curve {auc:.4f}")


def draw(path, models):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, (curve, diagram) = plt.subplots(1, 2, figsize=(11, 5), layout="constrained")
    for color, (title, y, p) in zip(("tab:blue", "tab:orange", "tab:green"), models):
        order = np.argsort(-p)
        found = np.cumsum(y[order]) / max(1, y.sum())
        mistaken = np.cumsum(1 - y[order]) / max(1, (1 - y).sum())
        curve.plot(np.maximum(mistaken, 1e-4), found, color=color, label=title)
        edges = np.array([0.0, 0.01, 0.05, 0.2, 0.5, 0.8, 0.9, 0.95, 0.99, 1.0 + 1e-9])
        for low, high in zip(edges[:-1], edges[1:]):
            inside = (p >= low) & (p < high)
            if not inside.any():
                continue
            bounds = wilson(y[inside].sum(), inside.sum())
            diagram.plot([p[inside].mean()] * 2, bounds, color=color, linewidth=1)
            diagram.plot(p[inside].mean(), y[inside].mean(), "o", color=color,
                         markersize=3 + 2 * np.log10(inside.sum()))
    curve.axvline(0.005, color="0.7", linestyle=":")
    curve.axhline(0.92, color="0.7", linestyle=":")
    curve.set_xscale("log")
    curve.set_xlabel("share of incorrect poses that are registered")
    curve.set_ylabel("share of correct poses that are registered")
    curve.set_title("held-out half")
    curve.legend(loc="lower right")
    diagram.plot([0, 1], [0, 1], color="0.7", linestyle=":")
    diagram.set_xlabel("predicted probability of a correct pose")
    diagram.set_ylabel("share of correct poses, with 95 % intervals")
    diagram.set_title("reliability")
    save_picture(figure, path, dpi=120)


# The feature that only poses have that were searched for.
SEARCHED = "guided"


def names_of(cases):
    return list(max((case.features for case in cases), key=len))


def report_all(options):
    """Prints it. Title, truth and probability of each model, for the picture."""
    cases = read_cases(options.results, False if options.report else None)
    if options.report:
        cases += read_cases(options.report, True)
    answered = [case for case in cases if case.features]
    print(f"{len(cases)} pairs, {len(answered)} with an answer, "
          f"{sum(case.is_right for case in answered)} of these right")
    own = [case for case in answered if SEARCHED not in case.features]
    searched = [case for case in answered if SEARCHED in case.features]
    names = names_of(own or searched)
    models = []
    twins, alike = options.twins.split(","), options.alike.split(",")
    of_clouds = [("matches and clouds", own, names)] if own else []
    if searched:
        of_clouds.append(("searched poses", searched, names_of(searched)))
    for title, of_model, chosen in [("matches alone", answered, names[:2])] + of_clouds:
        is_of_clouds = len(chosen) > 2
        left_out = alike if is_of_clouds else alike + twins
        usable = [case for case in of_model if all(name in case.features for name in chosen)
                  and case.set not in left_out]
        fitted = [case for case in usable if not case.is_reported]
        reported = [case for case in usable if case.is_reported]
        if not fitted or not reported:
            raise BadInput(f"{title}: too few pairs with an answer for two halves")
        w = fit(matrix(fitted, chosen), np.array([case.is_right for case in fitted], float))
        y = np.array([case.is_right for case in reported], float)
        p = probability(w, matrix(reported, chosen))
        print(f"\n{title}: intercept {w[0]:.3f}; " +
              ", ".join(f"{name} {value:.3f}" for name, value in zip(chosen, w[1:])))
        report(f"  fitted on {len(fitted)}, reported on {len(reported)}", y, p, options.threshold)
        models.append((title, y, p))
        if is_of_clouds:
            clear = np.array([not case.set.endswith("_twin") for case in reported])
            report("    without exact twins", y[clear], p[clear], options.threshold)
            clear = np.array([case.set not in twins for case in reported])
            report("    without the sets of --twins", y[clear], p[clear], options.threshold)
            others = [case for case in of_model if case.set in alike]
            if others:
                report("    different places that are built alike", np.zeros(len(others)),
                       probability(w, matrix(others, chosen)), options.threshold)
            for name in sorted({case.set for case in reported}):
                of_set = np.array([case.set == name for case in reported])
                report(f"    {name}", y[of_set], p[of_set], options.threshold)
    y = np.array([case.is_right for case in answered], float)
    p = np.array([case.probability for case in answered])
    report("\nas the program told, all pairs", y, p, options.threshold)
    return models


def main(args):
    parser = Parser(__doc__)
    parser.add_argument("results", metavar="RESULTS.csv", nargs="+", help="of run_pairs.py")
    parser.add_argument("--report", metavar="RESULTS.csv", action="append",
                        help="report on these pairs, and fit to all others; may be given again")
    parser.add_argument("--picture", metavar="FILE.png", help="file for the two diagrams")
    parser.add_argument("--twins", default="corridor,corridor_apart,symmetric,symmetric_twin,symmetric_apart",
                        metavar="SET,SET", help="of places that have a twin, which matches alone "
                        "cannot tell: left out of their model (default: %(default)s)")
    parser.add_argument("--alike", default="corridor_floor,hall_floor,room_floor", metavar="SET,SET",
                        help="of different places that are built alike, where a pose does fit: "
                        "left out, and told apart (default: %(default)s)")
    parser.add_argument("--threshold", type=float, default=0.8, metavar="P",
                        help="registered from this probability on (default: 0.8)")
    options = parser.parse_args(args)
    if options.picture:
        check_picture(options.picture, options.results)
    with contextlib.redirect_stdout(summary_stream(options.picture)):
        models = report_all(options)
    if options.picture:
        draw(options.picture, models)


if __name__ == "__main__":
    run_script(main)
