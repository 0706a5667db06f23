"""Runs the evaluation and writes its page. Called by evaluation.sh, which says how."""

import argparse
import glob
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import evaluation_cells as cells  # noqa: E402
import evaluation_page as page  # noqa: E402
import evaluation_plots as plots  # noqa: E402
import program_version  # noqa: E402

BUDGETS = [22, 32, 48, 64, 95, 128, 167, 207, 250, 299, 346]
QUICK_BUDGETS = [32, 64, 128]
QUICK_BODIES = ["female_average_rest", "male_heavy_rest", "female_average_rest_no_hands_feet_head"]
TIME_BODY = "female_average_tri_064k"
QUICK_SCALES = ["female_average_tri_05k", "female_average_tri_25k", TIME_BODY]
FIGURE_10_BUDGET = 64
MANNEQUINS = {
    "female_a": ["--sex", "female", "--height-m", "1.66", "--pose", "a"],
    "female_t": ["--sex", "female", "--height-m", "1.66", "--pose", "t"],
    "female_curvy_a": ["--sex", "female", "--height-m", "1.62", "--bust-m", "1.10",
                       "--waist-m", "0.90", "--hip-m", "1.14", "--pose", "a"],
    "male_a": ["--sex", "male", "--height-m", "1.78", "--pose", "a"],
    "male_t": ["--sex", "male", "--height-m", "1.78", "--pose", "t"],
    "male_stout_sides": ["--sex", "male", "--height-m", "1.74", "--waist-m", "1.10",
                         "--pose", "sides"],
}


def stem(path):
    return os.path.splitext(os.path.basename(path))[0]


def make_mannequins(capfit, folder):
    """Bodies and scales from the built-in mannequin, where there are no others."""
    os.makedirs(folder, exist_ok=True)
    bodies, scales = [], []
    for name, flags in MANNEQUINS.items():
        bodies.append(os.path.join(folder, f"{name}.obj"))
        cells.run([capfit, "mannequin", "-o", bodies[-1], "--parts", "all"] + flags)
    for faces in (5000, 10000, 25000, 64000, 100000, 200000):
        scales.append(os.path.join(folder, f"mannequin_{faces // 1000:03d}k.ply"))
        cells.run([capfit, "mannequin", "-o", scales[-1], "--parts", "all", "--triangles",
                   "--faces", str(faces)] + MANNEQUINS["female_a"])
    return bodies, scales


def find_bodies(arguments, folder):
    """Bodies, bodies of other densities, and the one of those that Table 1 is for."""
    root = os.environ.get("CAPFIT_BODIES", "../shared/bodies")
    bodies = sorted(glob.glob(os.path.join(root, "*.obj")))
    scales = sorted(glob.glob(os.path.join(root, "scale", "*.ply")))
    if not bodies or not scales:
        print("no bodies found (CAPFIT_BODIES): the built-in mannequin in six variations")
        bodies, scales = make_mannequins(arguments.capfit, os.path.join(folder, "mannequins"))
        if arguments.quick:
            bodies, scales = bodies[:3], scales[:4]
        return bodies, scales, next(s for s in scales if stem(s).endswith("064k")), False
    if arguments.quick:
        bodies = [b for b in bodies if stem(b) in QUICK_BODIES]
        scales = [s for s in scales if stem(s) in QUICK_SCALES]
    return bodies, scales, next(s for s in scales if stem(s) == TIME_BODY), True


def measure_times(store, progress, time_body, scales, budgets, runs):
    """Table 1 and Figure 10, before anything heats the machine up."""
    times = {cells.SPHERE_MESHES: store.sphere_mesh_times(time_body, budgets, runs)}
    for method in cells.METHODS:
        times[method] = {}
        for n in budgets:
            kept = store.has_time(store.key(f"time{runs}", time_body, method, n))
            cell = times[method][n] = store.time_cell(time_body, method, n, runs)
            progress.step(f"time   {stem(time_body)} {method} {n}  "
                          f"{cell.get('failure') or format(cell['seconds'], '.3f') + ' s'}", kept)
    ratios = {}
    for scale in scales:
        row = ratios[stem(scale)] = {
            "faces": page.triangle_count(scale),
            # The others are other surfaces or come from quads: not on one line with these.
            "is_series": "_tri_" in stem(scale) or stem(scale).startswith("mannequin_")}
        row[cells.SPHERE_MESHES] = store.sphere_mesh_times(
            scale, [FIGURE_10_BUDGET], runs)[FIGURE_10_BUDGET]
        for method in ("paper enclose", "balanced enclose", "tight enclose", "tight best"):
            kept = store.has_time(store.key(f"time{runs}", scale, method, FIGURE_10_BUDGET))
            cell = row[method] = store.time_cell(scale, method, FIGURE_10_BUDGET, runs)
            progress.step(f"scale  {stem(scale)} {method}  "
                          f"{cell.get('failure') or format(cell['seconds'], '.3f') + ' s'}", kept)
    return times, ratios


def measure_errors(store, progress, bodies, budgets):
    """errors[body][method][budget]"""
    errors = {}
    for body in bodies:
        table = errors[stem(body)] = {cells.SPHERE_MESHES: store.sphere_mesh_cells(body, budgets)}
        for method in cells.METHODS:
            table[method] = {}
            for n in budgets:
                kept = store.get(store.key("error", body, method, n)) is not None
                cell = table[method][n] = store.error_cell(body, method, n)
                told = cell.get("failure") or f"E_r {cell['E_r']:.3f}  {cell['seconds']:.2f} s"
                progress.step(f"errors {stem(body)} {method} {n}  {told}", kept)
    return errors


def draw_pictures(store, errors, bodies, folder, budget):
    """The bodies with the lowest and the highest E_r, and the baseline on the latter."""
    by_name = {stem(b): b for b in bodies}
    pictures = []

    def render(name, method, result, file_name, words):
        path = os.path.join(folder, file_name)
        cells.run([store.capfit, "render", by_name[name], result, "-o", path, "--title", words,
                   "--width", "1100", "--height", "760"])
        pictures.append((file_name, words))

    for method in ("tight best", "tight enclose"):
        ranked = page.ranked_bodies(errors, method, budget)
        if not ranked:
            continue
        for rank, name in (("best", ranked[0]), ("worst", ranked[-1])):
            words = (f"{name}, {page.WORDS[method]}, n_p {budget}, "
                     f"E_r {errors[name][method][budget]['E_r']:.3f}")
            render(name, method, store.result_path(by_name[name], method, budget),
                   f"{method.replace(' ', '_')}_{rank}.png", words)
    ranked = page.ranked_bodies(errors, "tight best", budget)
    ranked = [name for name in ranked if "E_r" in errors[name][cells.SPHERE_MESHES][budget]]
    if not ranked:
        return pictures
    name = ranked[-1]
    words = (f"{name}, {page.WORDS[cells.SPHERE_MESHES]}, n_p {budget}, "
             f"E_r {errors[name][cells.SPHERE_MESHES][budget]['E_r']:.3f}")
    prefix = store.sphere_mesh_prefix(by_name[name])
    if not os.path.exists(f"{prefix}.{budget}.capsules.json"):
        store.fit_sphere_meshes(by_name[name], [budget])
    render(name, cells.SPHERE_MESHES, f"{prefix}.{budget}.capsules.json", "sphere_meshes_worst.png",
           words)
    return pictures


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--capfit", required=True)
    parser.add_argument("--published", required=True)
    parser.add_argument("--sphere-mesh", required=True)
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--budgets", type=lambda text: sorted(map(int, text.split(","))),
                        help="numbers of primitives, among the eleven, with 64 among them")
    parser.add_argument("--kept", action="store_true",
                        help="fit nothing: the page of what is measured so far")
    arguments = parser.parse_args()
    work = "build/evaluation"
    docs = os.path.join(work, "quick") if arguments.quick else "docs"
    pictures_folder = os.path.join(docs, "evaluation")
    os.makedirs(pictures_folder, exist_ok=True)

    told_version = program_version.version(arguments.capfit)  # now: the tree may change while this runs
    judge = os.environ.get("CAPFIT_JUDGE")
    if not judge:
        print("CAPFIT_JUDGE names no program: `capfit evaluate` measures")
    store = cells.Store(work, arguments.capfit, arguments.published, arguments.sphere_mesh, judge,
                        arguments.kept)
    budgets = arguments.budgets or (QUICK_BUDGETS if arguments.quick else BUDGETS)
    if FIGURE_10_BUDGET not in budgets or not set(budgets) <= set(BUDGETS):
        parser.error(f"--budgets must be some of {BUDGETS} and have {FIGURE_10_BUDGET} among them")
    runs = 1 if arguments.quick else 3
    bodies, scales, time_body, are_real = find_bodies(arguments, work)
    progress = cells.Progress(len(cells.METHODS) * len(budgets) * (len(bodies) + 1)
                              + 3 * len(scales))
    times, ratios = measure_times(store, progress, time_body, scales, budgets, runs)
    errors = measure_errors(store, progress, bodies, budgets)
    if arguments.kept:
        errors = {name: table for name, table in errors.items()
                  if any("E_r" in c for m in cells.METHODS for c in table[m].values())}
        if not errors:
            parser.error("--kept: these programs have measured nothing yet")

    plots.figure_9(errors, budgets, os.path.join(pictures_folder, "figure_9.svg"))
    plots.table_1(times, budgets, os.path.join(pictures_folder, "table_1.svg"))
    plots.figure_10(ratios, os.path.join(pictures_folder, "figure_10.svg"))
    pictures = draw_pictures(store, errors, bodies, pictures_folder, FIGURE_10_BUDGET)
    text = page.write(errors=errors, times=times, ratios=ratios, budgets=budgets, runs=runs,
                      pictures=pictures, are_real=are_real, is_judged=bool(judge),
                      time_body=stem(time_body), figure_10_budget=FIGURE_10_BUDGET,
                      version=told_version)
    path = os.path.join(docs, "evaluation.md")
    with open(path, "w") as file:
        file.write(text)
    print(f"wrote {path}")


if __name__ == "__main__":
    main()
