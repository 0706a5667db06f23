#!/usr/bin/env bash
# deploy/compose.yaml: what its services are told is what the programs know, and they may do no more than they need.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
server=$1 client=$2
/usr/bin/python3 -c 'import yaml' 2>/dev/null || { echo "SKIPPED: no python3-yaml: deploy/install_packages.sh deploy" >&2; exit 77; }
/usr/bin/python3 - "$root/deploy/compose.yaml" "$server" "$client" <<'PYTHON'
import os, pathlib, re, subprocess, sys, yaml

path, server, client = sys.argv[1:]
services = yaml.safe_load(pathlib.Path(path).read_text())["services"]
wrong = []

def complain(condition, text):
    if condition:
        wrong.append(text)

replicas = {name: service for name, service in services.items() if re.fullmatch(r"capfit-\d+", name)}
complain(len(replicas) < 2, "fewer than two replicas")
for name, service in replicas.items():
    environment = service["environment"]
    # As the container: what the image sets besides is in Dockerfile.
    ran = subprocess.run([server, "--listen", "127.0.0.1:0", "--check-config"], env={**os.environ, **environment},
                         capture_output=True, text=True, check=False)
    complain(ran.returncode != 0, f"{name}: {ran.stderr}")
    # The server ignores variables that it does not know, so each must be one of its settings.
    settings = subprocess.run([server, "--print-config"], capture_output=True, text=True, check=True).stdout
    for variable in environment:
        setting = variable.removeprefix("CAPFIT_").lower().replace("_", "-")
        complain(not re.search(rf"^{setting}=", settings, re.MULTILINE), f"{name}: {variable} is no setting")
    grace = int(service["stop_grace_period"].removesuffix("s"))
    needed = float(environment["CAPFIT_DRAIN_DELAY_SECONDS"]) + float(environment["CAPFIT_DRAIN_SECONDS"])
    complain(grace <= needed, f"{name} is killed after {grace} s, and drains for {needed}")
    complain(not service["deploy"]["resources"]["limits"]["memory"], f"{name} has no limit of memory")
    complain(environment["CAPFIT_CACHE_REDIS"].split(":")[0] not in services, f"{name} asks a Redis that is not there")
for name, service in services.items():
    complain(":latest" in service["image"] or not re.search(r":[\w.-]+$|CAPFIT_IMAGE", service["image"]),
             f"{name} has no version")
    for volume in service.get("volumes", []):
        complain(not (pathlib.Path(path).parent / volume.split(":")[0]).exists(), f"{name}: {volume} is not there")
    for port in service.get("ports", []):
        complain(not port.startswith("127.0.0.1:"), f"{name}: {port} is open to everybody")
for name in [*replicas, "redis", "load"]:
    complain(services[name].get("read_only") is not True or services[name].get("cap_drop") != ["ALL"],
             f"{name} may do more than it needs")
for flag in re.findall(r"--[a-z-]+", " ".join(services["load"]["command"])):
    known = subprocess.run([client, "load", "--help"], capture_output=True, text=True, check=True).stdout
    complain(flag not in known, f"load has no {flag}")
if wrong:
    sys.exit("\n".join(wrong))
print(f"{len(services)} services as they should be")
PYTHON
