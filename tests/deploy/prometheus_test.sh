#!/usr/bin/env bash
# A real Prometheus, with the settings of deploy/, watches two real replicas under load: both are found,
# every rule is evaluated, every expression of the dashboard has an answer, and the alert for a replica that
# is gone comes when one is killed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
server=$1 capfit=$2
command -v prometheus >/dev/null || { echo "SKIPPED: no prometheus: deploy/install_packages.sh deploy" >&2; exit 77; }
source tests/deploy/replicas.sh
one_metrics=127.0.0.1:$(free_port)
two_metrics=127.0.0.1:$(free_port)
prometheus=127.0.0.1:$(free_port)
start_replica one --metrics-listen "$one_metrics"
start_replica two --metrics-listen "$two_metrics"
# The settings as they are, but for where the replicas are, and how often they are asked.
sed "s/capfit-1:9464/$one_metrics/; s/capfit-2:9464/$two_metrics/; s/10s/1s/" \
  deploy/prometheus/prometheus.yml >"$scratch/prometheus.yml"
sed "s/for: 1m$/for: 2s/" deploy/prometheus/alerts.yml >"$scratch/alerts.yml"
prometheus --config.file="$scratch/prometheus.yml" --storage.tsdb.path="$scratch/data" \
  --web.listen-address="$prometheus" >"$scratch/prometheus.log" 2>&1 &
pids+=($!)
one=$(address_of one)
two=$(address_of two)
"$capfit" load --server "$one,$two" --faces 2000 --parts torso --clients 2 --duration 8 \
  --strict >"$scratch/load"
/usr/bin/python3 - "$prometheus" "${pids[1]}" "$scratch/prometheus.log" <<'PYTHON'
import json, os, signal, sys, time, urllib.parse, urllib.request

address, second_replica, log = sys.argv[1:]

def ask(path, **parameters):
    url = f"http://{address}/api/v1/{path}?{urllib.parse.urlencode(parameters)}"
    with urllib.request.urlopen(url, timeout=10) as answer:
        return json.load(answer)["data"]

def wait_for(what, seconds, condition):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        try:
            if condition():
                return
        except OSError:
            pass
        time.sleep(0.3)
    sys.exit(f"not within {seconds} s: {what}\n{open(log, encoding='utf8').read()}")

def values(expression):
    return [float(series["value"][1]) for series in ask("query", query=expression)["result"]]

wait_for("both replicas are up", 30, lambda: values('up{job="capfit"}') == [1, 1])
panels = json.load(open("deploy/grafana/dashboards/capfit.json", encoding="utf8"))["panels"]
expressions = [target["expr"] for panel in panels for target in panel["targets"]]
assert len(expressions) >= 10
# Nothing was refused, so its share is 0 / rate and has no series: what has one is asked instead.
empty = [e for e in expressions if "RESOURCE_EXHAUSTED" not in e and not values(e)]
assert not empty, f"the dashboard shows nothing for {empty}"
assert values('sum(capfit_calls_total{code="OK"})')[0] > 10
rules = [rule for group in ask("rules")["groups"] for rule in group["rules"]]
wait_for("every rule is evaluated", 20, lambda: all(
    rule["health"] == "ok" for group in ask("rules")["groups"] for rule in group["rules"]))
assert len(rules) >= 7
assert not ask("alerts")["alerts"], ask("alerts")
os.kill(int(second_replica), signal.SIGKILL)
wait_for("the alert for the replica that is gone", 30, lambda: [
    alert["labels"]["alertname"] for alert in ask("alerts")["alerts"] if alert["state"] == "firing"] == ["CapfitReplicaDown"])
print(f"{len(expressions)} expressions of the dashboard, {len(rules)} rules, and the alert that had to come")
PYTHON
