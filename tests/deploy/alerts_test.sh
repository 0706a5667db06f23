#!/usr/bin/env bash
# Prometheus' own checks of its settings and rules; made-up series raise each alert, and the usual ones
# none; the dashboard asks only for what the rules know or the server counts.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
command -v promtool >/dev/null || { echo "SKIPPED: no promtool: deploy/install_packages.sh deploy" >&2; exit 77; }
promtool check config deploy/prometheus/prometheus.yml
promtool test rules tests/deploy/alerts_test.yml
# Every expression of the dashboard, as rules of a file that promtool reads.
/usr/bin/python3 - <<'PYTHON' >/tmp/capfit_dashboard_$$.yml
import json
panels = json.load(open("deploy/grafana/dashboards/capfit.json"))["panels"]
rules = [{"record": f"panel:{k}", "expr": target["expr"]}
         for k, target in enumerate(t for panel in panels for t in panel["targets"])]
assert len(rules) >= len(panels) >= 6
print(json.dumps({"groups": [{"name": "dashboard", "rules": rules}]}))
PYTHON
trap 'rm -f /tmp/capfit_dashboard_$$.yml' EXIT
promtool check rules "/tmp/capfit_dashboard_$$.yml"
