#!/usr/bin/env python3
"""Whether two replicas with a core of their own each do twice what one does.

    replicas.py --server build/release/server/capfit-server --capfit build/release/client/capfit \
        [--rounds 7] [--seconds 15] [--json FILE] [-- FLAGS OF LOAD]

Each replica computes with one thread and is kept on one core. In every round the first serves alone, both
serve, the second serves alone; the ratio of a round is both over the mean of the single ones, so that what
else goes on in the machine counts on both sides. The load generator has no core of its own where there are
two: its part of the work is in the figures of both, as it would be beside a client on the same host.
"""
import json
import os
import pathlib
import statistics
import sys
import tempfile

from servers import Server, load, parser_of


def rate(arguments, servers, clients, seconds):
    report = load(arguments, servers, "--clients", str(clients), "--duration", str(seconds), *arguments.flags)
    if list(report["codes"]) != ["OK"]:
        sys.exit(f"calls failed: {report['codes']} {report['first_messages']}")
    return report["results_per_second"]


def run(arguments, folder):
    servers = []
    for core in range(2):
        place = folder / str(core)
        place.mkdir()
        servers.append(Server(arguments.server, place, ["--threads", "1", "--max-concurrent-fits", "1"], core))
    rounds = []
    try:
        for server in servers:
            rate(arguments, [server], 2, 3)  # what they know of the cost of fits
        for _ in range(arguments.rounds):
            first = rate(arguments, servers[:1], 3, arguments.seconds)
            both = rate(arguments, servers, 6, arguments.seconds)
            second = rate(arguments, servers[1:], 3, arguments.seconds)
            ratio = 2 * both / (first + second)
            rounds.append({"first": first, "second": second, "both": both, "ratio": ratio})
            print(f"first {first:.2f}, second {second:.2f}, both {both:.2f} a second: {ratio:.2f} times one", flush=True)
    finally:
        codes = [server.stop() for server in servers]
    return {"rounds": rounds, "median_ratio": statistics.median(r["ratio"] for r in rounds), "exit_codes": codes,
            "load_average": os.getloadavg()}


def main():
    parser = parser_of(__doc__, "of `capfit load`, after --")
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--seconds", type=float, default=15.0)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="capfit_replicas_") as folder:
        report = run(arguments, pathlib.Path(folder))
    if arguments.json:
        pathlib.Path(arguments.json).write_text(json.dumps(report, indent=1))
    print(f"median {report['median_ratio']:.2f} times one; load average {report['load_average'][0]:.1f}")
    return 0 if report["exit_codes"] == [0, 0] else 1


if __name__ == "__main__":
    sys.exit(main())
