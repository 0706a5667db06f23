"""The tables of tests/bench/compare: two builds of the command line, run by turns."""
import argparse
import json
import os
import platform
import statistics
import subprocess
import tempfile
import textwrap

import program_version

# Name, options now, and options of the other build where they differ.
CASES = [("PAPER, 64", ["--quality", "paper", "--max-primitives", "64"]),
         ("PAPER → BALANCED, 64", ["--quality", "balanced", "--max-primitives", "64"],
          ["--quality", "paper", "--max-primitives", "64"]),
         ("TIGHT, 64", ["--quality", "tight", "--max-primitives", "64"]),
         ("TIGHT, 128", ["--quality", "tight", "--max-primitives", "128"]),
         ("TIGHT, 250", ["--quality", "tight", "--max-primitives", "250"]),
         ("TIGHT best fit, 64", ["--quality", "tight", "--fit", "best", "--max-primitives", "64"])]
SCALE = ["female_average_tri_05k.ply", "female_average_tri_064k.ply", "female_average_tri_200k.ply"]


def fit(program, body, options, threads, folder):
    """Stages in ms, all in ms, E_r, peak memory in MB."""
    result = os.path.join(folder, "result.json")
    child = subprocess.Popen([program, "approximate", body, "-o", result, "--local", "--parts", "all",
                              "--threads", str(threads), *options],
                             stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode != 0:
        raise SystemExit(f"{program} failed on {body}: exit code {child.returncode}")
    with open(result, encoding="utf-8") as file:
        told = json.load(file)
    metrics = told["metrics"]
    error = metrics["volume_error"] if "volume_error" in metrics else metrics["E_r"]
    stages = {name: 1e3 * seconds for name, seconds in told["stages"].items()}
    return {**stages, "all": 1e3 * told["seconds"], "E_r": error, "MB": usage.ru_maxrss / 1024}


def median(runs, name):
    return statistics.median(run.get(name, 0.0) for run in runs)


def measure(arguments, body, folder):
    for case, options, *other in CASES:
        for threads in (1, 2):
            before, after = [], []
            for _ in range(arguments.runs):
                before.append(fit(arguments.other, body, (other or [options])[0], threads, folder))
                after.append(fit(arguments.this, body, options, threads, folder))
            yield case, threads, before, after


def rows(arguments, body, folder):
    names = ["mesh", "body", "section", "circle", "capsule", "refine", "coverage", "metrics"]
    yield "| fit | threads | " + " | ".join(names) + " | all | ratio | E_r | peak MB |"
    yield "|---|---:|" + "---:|" * (len(names) + 4)
    for case, threads, before, after in measure(arguments, body, folder):
        def cell(name, form="{:.1f}", before=before, after=after):
            return form.format(median(before, name)) + " → " + form.format(median(after, name))
        ratio = median(before, "all") / median(after, "all")
        yield (f"| {case} | {threads} | " + " | ".join(cell(name) for name in names) +
               f" | {cell('all')} | {ratio:.1f} | {cell('E_r', '{:.3f}')} | {cell('MB', '{:.0f}')} |")


def bodies_of(arguments, folder):
    if arguments.bodies:
        return arguments.bodies
    scale = os.path.join(os.environ.get("CAPFIT_BODIES", "../shared/bodies"), "scale")
    if os.path.isdir(scale):
        return [os.path.join(scale, name) for name in SCALE]
    mannequin = os.path.join(folder, "mannequin.obj")
    subprocess.run([arguments.this, "mannequin", "-o", mannequin], check=True)
    return [mannequin]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--ref", required=True)
    parser.add_argument("--other", required=True)
    parser.add_argument("--this", required=True)
    parser.add_argument("--runs", type=int, default=7)
    parser.add_argument("--bodies", nargs="*")
    parser.add_argument("--markdown")
    arguments = parser.parse_args()
    now = program_version.version(arguments.this)
    told = (f"Made by `tests/bench/compare {arguments.ref} --markdown docs/performance.md`: milliseconds "
            "of the whole fit and of its stages, everything included but reading the file, medians of "
            f"{arguments.runs} runs, each in a process of its own; before → now ({now}), both by "
            f"turns on the same machine ({platform.machine()}, {os.cpu_count()} logical cores). Ratios "
            "are before / now. All parts. On a machine that is shared with others single cells can be "
            "far off, and other machines have other milliseconds: the ratios are what to compare.")
    lines = ["# Performance", "", *textwrap.wrap(told, 100)]
    with tempfile.TemporaryDirectory() as folder:
        for body in bodies_of(arguments, folder):
            lines += ["", f"## {os.path.splitext(os.path.basename(body))[0]}", ""]
            print("\n".join(lines[-3:]))
            for row in rows(arguments, body, folder):
                print(row, flush=True)
                lines.append(row)
    if arguments.markdown:
        with open(arguments.markdown, "w", encoding="utf-8") as file:
            file.write("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
