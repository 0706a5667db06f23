#!/usr/bin/env python3
"""A server at twice what it can do, beside callers who only hold what they can get.

    overload.py --server build/release/server/capfit-server --capfit build/release/client/capfit \
        [--seconds 600] [--times 2] [--uploads 200] [--readers 100] [--json FILE] [-- FLAGS OF THE SERVER]

1. One client calls a server that has nothing else to do: how long a body takes.
2. Some clients call it as fast as it answers: how many bodies a second it can do.
3. `--times` as many a second for `--seconds`, while `--uploads` uploads stop in the middle and `--readers`
   readers never read.

It fails unless no call failed but by a refusal of a full server with the time to come again, every answer had
the right bits, the 99th percentile of answered calls is at most four times that of a server with nothing else
to do, resident memory stays within the budget and does not grow after the first third, and the server ends
with 0 at SIGTERM. Times are compared with times of the same run only; the load of the machine is printed.
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

from servers import Server, load, parser_of

ROOT = pathlib.Path(__file__).resolve().parents[2]
FACES = ("--faces", "4000,20000,60000")
MOST_TIMES_UNLOADED = 4.0
# What the program is and what running fits work with, beside its budget.
BESIDE_BUDGET_MIB = 300
# Of the middle third's mean: what an allocator moves to and fro.
MOST_GROWTH = 1.10


def start_crowd(arguments, server):
    body = server.folder / "body.ply"
    subprocess.run([arguments.capfit, "mannequin", "-o", body, "--faces", "20000"], check=True, stdout=subprocess.DEVNULL)
    return subprocess.Popen(["/usr/bin/python3", ROOT / "tests/load/crowd.py", server.address, ROOT / "proto", body,
                             str(arguments.uploads), str(arguments.readers), "token-of-crowd"],
                            stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)


def thirds(samples):
    size = len(samples) // 3
    return [sum(part) / len(part) for part in (samples[:size], samples[size:2 * size], samples[2 * size:])]


def judge(report, held_mib):
    """What is wrong, in words."""
    wrong = []
    busy = report["busy"]
    for code in busy["codes"]:
        if code not in ("OK", "RESOURCE_EXHAUSTED"):
            wrong.append(f"{busy['codes'][code]} calls ended with {code}: {busy['first_messages'].get(code)}")
    for name in ("empty_results", "differing_results", "refused_without_pushback"):
        if busy[name]:
            wrong.append(f"{name}: {busy[name]}")
    if busy["codes"].get("RESOURCE_EXHAUSTED", 0) == 0:
        wrong.append("nothing was refused: this was no overload")
    if report["p99_times_unloaded"] > MOST_TIMES_UNLOADED:
        wrong.append(f"the 99th percentile is {report['p99_times_unloaded']:.2f} times that without load")
    _, middle, last = report["resident_mib_by_third"]
    if last > MOST_GROWTH * middle:
        wrong.append(f"resident memory grew from {middle:.0f} to {last:.0f} MiB")
    if report["most_resident_mib"] > held_mib + BESIDE_BUDGET_MIB:
        wrong.append(f"resident memory reached {report['most_resident_mib']:.0f} MiB of a budget of {held_mib}")
    if report["exit_code"] != 0:
        wrong.append(f"the server ended with {report['exit_code']}")
    return wrong


def run(arguments, folder):
    # A queue that is as long as callers may wait who shall have their answer within four times the usual.
    flags = ["--max-held-mb", str(arguments.held_mb), *arguments.flags]
    server = Server(arguments.server, folder, flags)
    report = {"flags": flags, "cores": os.cpu_count(), "load_average_before": os.getloadavg()}
    try:
        load(arguments, [server], *FACES, "--clients", "1", "--duration", "5")  # the server learns what fits cost
        alone = load(arguments, [server], *FACES, "--clients", "1", "--duration", str(arguments.calibrate))
        most = load(arguments, [server], *FACES, "--clients", "4", "--duration", str(arguments.calibrate))
        rate = arguments.times * most["results_per_second"]
        crowd = start_crowd(arguments, server)
        time.sleep(min(10, arguments.seconds / 6))
        begin = len(server.samples)
        busy = load(arguments, [server], *FACES, "--rate", f"{rate:.3f}", "--clients", "200", "--duration", str(arguments.seconds))
        samples = server.samples[begin:]
        report["crowd"] = json.loads(crowd.communicate(input="", timeout=60)[0] or "{}")
    finally:
        report["exit_code"] = server.stop()
    report.update({"alone": alone, "capacity_per_second": most["results_per_second"], "rate": rate, "busy": busy,
                   "p99_times_unloaded": busy["answered"]["p99_seconds"] / alone["answered"]["p99_seconds"],
                   "p99_times_unloaded_by_body": {
                       name: busy["bodies"][name]["p99_seconds"] / alone["bodies"][name]["p99_seconds"]
                       for name in alone["bodies"] if busy["bodies"][name]["calls"]},
                   "resident_mib_by_third": thirds(samples), "most_resident_mib": max(samples),
                   "load_average_after": os.getloadavg()})
    return report


def show(report, wrong):
    alone, busy = report["alone"], report["busy"]
    print(f"server flags: {' '.join(report['flags'])}; load average {report['load_average_before'][0]:.1f} before, "
          f"{report['load_average_after'][0]:.1f} after, {report['cores']} cores")
    print(f"capacity {report['capacity_per_second']:.2f} a second, asked {report['rate']:.2f}, "
          f"answered {busy['results_per_second']:.2f}; {busy['codes']}")
    print(f"{'milliseconds':18} {'alone p50':>10} {'p99':>8} {'busy p50':>10} {'p99':>8} {'times':>6}")
    rows = {"all": (alone["answered"], busy["answered"], report["p99_times_unloaded"])}
    for name, times in report["p99_times_unloaded_by_body"].items():
        rows[name] = (alone["bodies"][name], busy["bodies"][name], times)
    for name, (one, other, times) in rows.items():
        print(f"{name:18} {1e3 * one['p50_seconds']:10.0f} {1e3 * one['p99_seconds']:8.0f} "
              f"{1e3 * other['p50_seconds']:10.0f} {1e3 * other['p99_seconds']:8.0f} {times:6.2f}")
    first, middle, last = report["resident_mib_by_third"]
    print(f"resident MiB by thirds {first:.0f}, {middle:.0f}, {last:.0f}, most {report['most_resident_mib']:.0f}; "
          f"the crowd's calls ended {report['crowd']}")
    print("good" if not wrong else "WRONG: " + "; ".join(wrong))


def main():
    parser = parser_of(__doc__, "of the server, after --")
    parser.add_argument("--seconds", type=float, default=600.0)
    parser.add_argument("--calibrate", type=float, default=20.0)
    parser.add_argument("--times", type=float, default=2.0)
    parser.add_argument("--uploads", type=int, default=200)
    parser.add_argument("--readers", type=int, default=100)
    parser.add_argument("--held-mb", type=int, default=1024)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="capfit_overload_") as folder:
        report = run(arguments, pathlib.Path(folder))
    wrong = judge(report, arguments.held_mb)
    if arguments.json:
        pathlib.Path(arguments.json).write_text(json.dumps(report, indent=1))
    show(report, wrong)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
