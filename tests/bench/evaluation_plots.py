"""The plots of the evaluation, as SVG: the paper's figures 9 and 10 and its table 1."""

import statistics

import matplotlib

matplotlib.use("svg")
matplotlib.rcParams.update({"svg.hashsalt": "capfit", "svg.fonttype": "none", "font.size": 11,
                            "axes.grid": True, "grid.color": "#dddddd", "axes.axisbelow": True})
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator  # noqa: E402

SPHERE_MESHES = "Sphere-Meshes"
STYLE = {
    "published enclose": ("#b2182b", "D", ":", "the paper's method as published"),
    "paper enclose": ("#e08214", "s", "-", "capfit, paper"),
    "paper best": ("#e08214", "s", "-", "capfit, paper"),
    "balanced enclose": ("#1b9e77", "v", "-", "capfit, balanced"),
    "tight enclose": ("#2166ac", "o", "-", "capfit, tight"),
    "tight best": ("#2166ac", "o", "-", "capfit, tight"),
    SPHERE_MESHES: ("#555555", "^", "--", "improved Sphere-Meshes, own code"),
}
# Seconds in the paper's table 1 (i7-7700, 64k faces).
PAPER_S = {22: .005, 32: .044, 48: .035, 64: .048, 95: .110, 128: .106, 167: .163, 207: .153,
           250: .147, 299: .143, 346: .146}
PAPER_SPHERE_MESHES_S = {22: 4.327, 32: 4.354, 48: 4.315, 64: 4.965, 95: 4.303, 128: 4.450,
                         167: 4.232, 207: 4.108, 250: 4.124, 299: 4.126, 346: 4.099}


def spread(errors, method, budget, name):
    """Median, least and most over the bodies; None where no body has a figure."""
    values = [t[method][budget][name] for t in errors.values() if name in t[method][budget]]
    return (statistics.median(values), min(values), max(values)) if values else None


def log_axis(axis, ticks, words):
    axis.set_major_locator(FixedLocator(ticks))
    axis.set_minor_locator(NullLocator())
    axis.set_major_formatter(FuncFormatter(lambda value, _: words(value)))


def budget_axis(axes, budgets):
    axes.set_xscale("log")
    log_axis(axes.xaxis, budgets, lambda value: f"{value:.0f}")
    axes.tick_params(axis="x", labelsize=9)


def save(figure, path):
    figure.savefig(path, metadata={"Date": None})
    plt.close(figure)


def figure_9(errors, budgets, path):
    figure, grid = plt.subplots(2, 2, figsize=(10, 8), sharex=True, sharey="row",
                                layout="constrained")
    rows = [("E_r", "$E_r$: wrong volume / body's volume", [.02, .05, .1, .2, .5, 1, 2, 5]),
            ("E_M", "$E_M$: mean distance, % of the diagonal", [.05, .1, .2, .5, 1, 2, 5])]
    columns = [("ENCLOSE: nothing of the body sticks out", "enclose"),
               ("BEST_FIT: least $E_r$", "best")]
    for row, (name, label, ticks) in enumerate(rows):
        for column, (title, fit) in enumerate(columns):
            axes = grid[row][column]
            for method in (SPHERE_MESHES, f"published {fit}", f"paper {fit}",
                           f"balanced {fit}", f"tight {fit}"):
                if method not in STYLE:
                    continue
                color, marker, line, words = STYLE[method]
                found = {n: spread(errors, method, n, name) for n in budgets}
                x = [n for n in budgets if found[n]]
                axes.fill_between(x, [found[n][1] for n in x], [found[n][2] for n in x],
                                  color=color, alpha=.14, linewidth=0)
                axes.plot(x, [found[n][0] for n in x], color=color, marker=marker, markersize=5,
                          linestyle=line, label=words)
            axes.set_yscale("log")
            log_axis(axes.yaxis, ticks, lambda value: f"{value:g}")
            budget_axis(axes, budgets)
            if row == 0:
                axes.set_title(title, fontsize=11)
                axes.legend(fontsize=9, loc="lower left")
            else:
                axes.set_xlabel("$n_p$: spheres + cones + plates")
        grid[row][0].set_ylabel(label)
    save(figure, path)


def table_1(times, budgets, path):
    figure, axes = plt.subplots(figsize=(9, 5.6), layout="constrained")
    lines = [(SPHERE_MESHES, "-", SPHERE_MESHES + " (2013), own code, one thread"),
             ("paper enclose", "-", "capfit, paper, ENCLOSE"),
             ("paper best", ":", "capfit, paper, BEST_FIT"),
             ("balanced enclose", "-", "capfit, balanced, ENCLOSE"),
             ("tight enclose", "-", "capfit, tight, ENCLOSE"),
             ("tight best", ":", "capfit, tight, BEST_FIT")]
    for method, line, words in lines:
        color, marker, _, _ = STYLE[method]
        x = [n for n in budgets if "seconds" in times[method][n]]
        axes.plot(x, [times[method][n]["seconds"] for n in x], color=color, marker=marker,
                  markersize=5, linestyle=line, label=words)
    for stated, marker, words in ((PAPER_SPHERE_MESHES_S, "2", "Sphere-Meshes, stated in the paper"),
                                  (PAPER_S, "1", "the paper's method, stated in the paper")):
        axes.plot(budgets, [stated[n] for n in budgets], color="#b2182b", marker=marker,
                  markersize=8, linestyle="-.", linewidth=1, label=words)
    axes.set_yscale("log")
    log_axis(axes.yaxis, [.005, .01, .02, .05, .1, .2, .5, 1, 2, 5, 10], lambda v: f"{v:g}")
    budget_axis(axes, budgets)
    axes.set_xlabel("$n_p$: spheres + cones + plates")
    axes.set_ylabel("time, s")
    axes.legend(fontsize=9, ncols=2, loc="upper center", bbox_to_anchor=(.5, -.12))
    save(figure, path)


def figure_10(ratios, path):
    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4.6), layout="constrained")
    rows = sorted(ratios.values(), key=lambda row: row["faces"])
    ticks = [5000, 10000, 25000, 50000, 100000, 200000]

    def seconds(row, method):
        return row[method].get("seconds", float("nan"))

    def draw(axes, value, method, line, label):
        """A line through one surface at several densities; other meshes as hollow marks."""
        color, marker, _, _ = STYLE[method]
        for is_series, style in ((True, {"linestyle": line, "label": label}),
                                 (False, {"linestyle": "", "markerfacecolor": "none"})):
            chosen = [row for row in rows if row["is_series"] == is_series]
            axes.plot([row["faces"] for row in chosen], [value(row) for row in chosen],
                      color=color, marker=marker, markersize=5, **style)

    for method in ("paper enclose", "balanced enclose", "tight enclose", "tight best"):
        fit, line = ("BEST_FIT", ":") if method.endswith("best") else ("ENCLOSE", "-")
        label = f"{STYLE[method][3]}, {fit}"
        draw(left, lambda row, m=method: seconds(row, SPHERE_MESHES) / seconds(row, m), method, line,
             label)
        draw(right, lambda row, m=method: seconds(row, m), method, line, label)
    draw(right, lambda row: seconds(row, SPHERE_MESHES), SPHERE_MESHES, "--",
         "Sphere-Meshes (2013), own code")
    left.axhline(1, color="#999999", linewidth=1)
    left.set_ylabel("time of Sphere-Meshes / time of capfit")
    right.set_ylabel("time, s")
    right.set_yscale("log")
    log_axis(right.yaxis, [.01, .02, .05, .1, .2, .5, 1, 2, 5, 10], lambda v: f"{v:g}")
    for axes in (left, right):
        axes.set_xscale("log")
        log_axis(axes.xaxis, ticks, lambda value: f"{value / 1000:.0f}k")
        axes.set_xlabel("triangles of the mesh")
        axes.legend(fontsize=9)
    left.set_ylim(bottom=0)
    save(figure, path)
