#!/usr/bin/env bash
# Time of each stage over the number of primitives, as a Markdown table, beside the paper's Table 1.
#
#   tests/bench/stage_times.sh BODY [PRIMITIVES ...]      default: 22 64 128
#
# RUNS (7) runs each, the median of each stage; THREADS (0: one per core).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
body=${1:?a mesh file}; shift
[ "$#" -gt 0 ] || set -- 22 64 128
capfit=${CAPFIT:-build/release/client/capfit}
folder=$(mktemp -d); trap 'rm -rf "$folder"' EXIT
for count in "$@"; do
  for run in $(seq "${RUNS:-7}"); do
    "$capfit" approximate "$body" -o "$folder/$count.$run.json" --local --threads "${THREADS:-0}" \
      --max-primitives "$count" --parts "${PARTS:-torso,arms,legs}" >/dev/null 2>&1
  done
done
python3 - "$folder" "$@" <<'PYTHON'
import glob, json, statistics, sys

PAPER_S = {22: .005, 32: .044, 48: .035, 64: .048, 95: .110, 128: .106, 167: .163, 207: .153,
           250: .147, 299: .143, 346: .146}
folder, counts = sys.argv[1], [int(n) for n in sys.argv[2:]]
runs = {n: [json.load(open(f)) for f in glob.glob(f"{folder}/{n}.*.json")] for n in counts}
median = lambda n, get: statistics.median(get(r) for r in runs[n])
stages = list(runs[counts[0]][0]["stages"])
print("| ms | " + " | ".join(f"n_p {n}" for n in counts) + " |")
print("|---|" + "---:|" * len(counts))
for stage in stages:
    print(f"| {stage} | " + " | ".join(f"{1e3 * median(n, lambda r: r['stages'].get(stage, 0)):.1f}" for n in counts) + " |")
print("| **all** | " + " | ".join(f"**{1e3 * median(n, lambda r: r['seconds']):.1f}**" for n in counts) + " |")
print("| paper, 2018 | " + " | ".join(f"{1e3 * PAPER_S[n]:.0f}" if n in PAPER_S else "" for n in counts) + " |")
print("| E_r | " + " | ".join(f"{median(n, lambda r: r['metrics']['volume_error']):.3f}" for n in counts) + " |")
PYTHON
