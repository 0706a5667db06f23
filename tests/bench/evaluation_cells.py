"""One cell of the evaluation: a body, a method and a budget. Fitted, measured, and kept."""

import hashlib
import json
import os
import subprocess
import time

# The published method's last step; a program of its own fits it.
PUBLISHED = "published enclose"
# Name and the arguments of `capfit approximate`.
METHODS = {
    PUBLISHED: [],
    "paper enclose": ["--quality", "paper", "--fit", "enclose"],
    "paper best": ["--quality", "paper", "--fit", "best"],
    "balanced enclose": ["--quality", "balanced", "--fit", "enclose"],
    "tight enclose": ["--quality", "tight", "--fit", "enclose"],
    "tight best": ["--quality", "tight", "--fit", "best"],
}
# The best of several settings, with more steps than the published method has: for the errors.
SPHERE_MESHES = "Sphere-Meshes"
# One collapse, as published: for the times, which the settings and steps would only make longer.
PUBLISHED_SPHERE_MESHES = ["--radius-bounds", "0.75", "--steps", "collapse"]
THREADS = "2"
# What `capfit evaluate` calls the figures that the pages know by the paper's names.
OWN_NAMES = {"E_r": "volume_error", "E_M": "mean_distance_percent",
             "hausdorff": "max_distance_percent"}
LIMIT_S = 180
NOT_MEASURED = {"failure": "not measured"}
# A furrow of at most this between the capsules that stand for a triangle of a sphere mesh.
SAG_MM = "0.1"


def digest(path):
    with open(path, "rb") as file:
        return hashlib.sha256(file.read()).hexdigest()[:12]


def run(command):
    """Its standard output; RuntimeError with the last line of the complaint."""
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=LIMIT_S)
    except subprocess.TimeoutExpired:
        raise RuntimeError(f"took more than {LIMIT_S} s") from None
    if done.returncode != 0:
        raise RuntimeError((done.stderr.strip().splitlines() or ["failed"])[-1])
    return done.stdout


def time_figures(times):
    return {"seconds": min(times), "most": max(times), "load": os.getloadavg()[0]}


class Store:
    """Finished cells, one JSON line each, by a key that names programs and body by their bytes."""

    def __init__(self, folder, capfit, published, sphere_mesh, judge, only_kept=False):
        """With only_kept nothing is fitted: cells that are not there yet are NOT_MEASURED."""
        self.capfit, self.published, self.sphere_mesh = capfit, published, sphere_mesh
        self.judge = judge
        self.only_kept = only_kept
        measure = digest(judge or capfit)
        self.programs = {"capfit": f"{digest(capfit)}/{measure}",
                         PUBLISHED: f"{digest(published)}/{measure}",
                         SPHERE_MESHES: f"{digest(sphere_mesh)}/{measure}"}
        self.folder = folder
        self.body_digests = {}
        os.makedirs(os.path.join(folder, "results"), exist_ok=True)
        self.path = os.path.join(folder, "cells.jsonl")
        self.cells = {}
        if os.path.exists(self.path):
            with open(self.path) as file:
                for line in file:
                    try:
                        entry = json.loads(line)
                    except json.JSONDecodeError:  # the end of an interrupted run
                        continue
                    self.cells[entry["key"]] = entry["cell"]

    def key(self, kind, body, method, budget):
        if body not in self.body_digests:
            self.body_digests[body] = digest(body)
        program = self.programs.get(method, self.programs["capfit"])
        return "|".join([kind, program, self.body_digests[body], method, str(budget)])

    def get(self, key):
        return self.cells.get(key, NOT_MEASURED if self.only_kept else None)

    def put(self, key, cell):
        self.cells[key] = cell
        with open(self.path, "a") as file:
            file.write(json.dumps({"key": key, "cell": cell}) + "\n")

    def has_time(self, key):
        """Whether there is a time to keep: not one from a far busier machine than now."""
        kept = self.get(key)
        if kept is None or self.only_kept or "load" not in kept:
            return kept is not None
        return kept["load"] < 1.5 * os.cpu_count() or os.getloadavg()[0] > .5 * kept["load"]

    def result_path(self, body, method, budget):
        """Where the fitted set is: kept for as long as the same programs are evaluated."""
        stem = self.key("set", body, method, budget).replace("/", "-").replace("|", ".")
        return os.path.join(self.folder, "results", stem.replace(" ", "_") + ".json")

    def sphere_mesh_prefix(self, body):
        return self.result_path(body, SPHERE_MESHES, 0)[: -len(".0.json")]

    # -- work --

    def fit(self, body, method, budget):
        """Writes the result; its seconds, without reading the file."""
        path = self.result_path(body, method, budget)
        options = ["--threads", THREADS, "--max-primitives", str(budget)]
        if method == PUBLISHED:
            run([self.published, body, path] + options)
        else:
            run([self.capfit, "approximate", body, "-o", path, "--local", "--parts", "all", "--quiet"]
                + options + METHODS[method])
        with open(path) as file:
            return json.load(file)["seconds"]

    def fit_sphere_meshes(self, body, budgets):
        """All budgets in one run."""
        run([self.sphere_mesh, body, self.sphere_mesh_prefix(body), "--budgets",
             ",".join(map(str, budgets)), "--sag-mm", SAG_MM])

    def time_published_sphere_meshes(self, body, budgets):
        """The seconds of each budget."""
        prefix = self.sphere_mesh_prefix(body) + ".published"
        run([self.sphere_mesh, body, prefix, "--budgets", ",".join(map(str, budgets)),
             *PUBLISHED_SPHERE_MESHES])
        seconds = {}
        for budget in budgets:
            with open(f"{prefix}.{budget}.json") as file:
                seconds[budget] = json.load(file)["seconds"]
        return seconds

    def measure(self, body, path, plain_path=None):
        """Figures of the set in `path`; `plain_path` is the same without triangles."""
        with open(path) as file:
            result = json.load(file)
        if self.judge:
            m = json.loads(run([self.judge, body, path, "--json", "--columns", "320",
                                "--samples", "20000"]))
            m["max_out_m"] = m["max_out_mm"] / 1e3
            m["mirror_error"] = m["asym"]
        else:
            m = json.loads(run([self.capfit, "evaluate", body, plain_path or path, "--json",
                                "--parts", "all", "--threads", THREADS]))
            for name, own in OWN_NAMES.items():
                m[name] = m[own]
        cell = {name: m[name] for name in ("E_r", "outside", "uncovered", "E_M", "hausdorff",
                                           "vertices_out", "max_out_m", "mirror_error")}
        cell["max_gap_m"] = m.get("max_gap_m")
        cell["n_p"] = result["n_p"] if "n_p" in result else result["metrics"]["primitive_count"]
        cell["seconds"] = result["seconds"]
        return cell

    def error_cell(self, body, method, budget):
        key = self.key("error", body, method, budget)
        if self.get(key) is None:
            try:
                self.fit(body, method, budget)
                cell = self.measure(body, self.result_path(body, method, budget))
            except RuntimeError as error:
                cell = {"failure": str(error)}
            self.put(key, cell)
        return self.get(key)

    def sphere_mesh_cells(self, body, budgets):
        keys = {n: self.key("error", body, SPHERE_MESHES, n) for n in budgets}
        if any(self.get(key) is None for key in keys.values()):
            self.fit_sphere_meshes(body, budgets)
        for budget, key in keys.items():
            if self.get(key) is None:
                prefix = f"{self.sphere_mesh_prefix(body)}.{budget}"
                self.put(key, self.measure(body, prefix + ".json", prefix + ".capsules.json"))
        return {n: self.get(key) for n, key in keys.items()}

    def time_cell(self, body, method, budget, runs):
        """Seconds of `runs` fits, one after the other: other programs only ever add, so the least."""
        key = self.key(f"time{runs}", body, method, budget)
        if not self.has_time(key):
            try:
                times = [self.fit(body, method, budget) for _ in range(runs)]
                cell = time_figures(times)
            except RuntimeError as error:
                cell = {"failure": str(error)}
            self.put(key, cell)
        return self.get(key)

    def sphere_mesh_times(self, body, budgets, runs):
        keys = {n: self.key(f"time{runs}", body, SPHERE_MESHES, n) for n in budgets}
        if not all(self.has_time(key) for key in keys.values()):
            times = [self.time_published_sphere_meshes(body, budgets) for _ in range(runs)]
            for n, key in keys.items():
                self.put(key, time_figures([t[n] for t in times]))
        return {n: self.get(key) for n, key in keys.items()}


class Progress:
    def __init__(self, total):
        self.total, self.done, self.start, self.worked = total, 0, time.time(), 0

    def step(self, text, was_kept=False):
        self.done += 1
        self.worked += not was_kept
        left = self.total - self.done
        rate = (time.time() - self.start) / max(1, self.worked)
        print(f"[{self.done:4d}/{self.total}] {text}"
              + (" (kept)" if was_kept else f"   {left * rate / 60:.0f} min left"), flush=True)
