"""capfit-server under load from `capfit load`, for the measurements beside this file."""
import argparse
import hashlib
import json
import os
import signal
import subprocess
import sys
import threading
import time

MEBIBYTE = 1 << 20


def resident_mib(pid):
    with open(f"/proc/{pid}/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGESIZE") / MEBIBYTE


class Server:
    """capfit-server with two callers known to it: the load, and the crowd. `core`: the only one it may use."""

    def __init__(self, program, folder, flags, core=None):
        self.folder = folder
        pin = [] if core is None else ["taskset", "-c", str(core)]
        lines = []
        for name in ("load", "crowd"):
            (folder / name).write_text(f"token-of-{name}\n")
            lines.append(f"{name} {hashlib.sha256(f'token-of-{name}'.encode()).hexdigest()}\n")
        (folder / "tokens").write_text("".join(lines))
        port_file = folder / "port"
        with open(folder / "log", "w", encoding="utf8") as log:
            self.process = subprocess.Popen([*pin, program, "--listen", "127.0.0.1:0", "--port-file", port_file,
                                             "--token-file", folder / "tokens", *flags], stderr=log)
        while not port_file.exists():
            if self.process.poll() is not None:
                sys.exit((folder / "log").read_text())
            time.sleep(0.05)
        self.address = "127.0.0.1:" + port_file.read_text().strip()
        self.samples = []
        threading.Thread(target=self.sample, daemon=True).start()

    def sample(self):
        while self.process.poll() is None:
            try:
                self.samples.append(resident_mib(self.process.pid))
            except OSError:
                return
            time.sleep(0.5)

    def stop(self):
        self.process.send_signal(signal.SIGTERM)
        return self.process.wait(timeout=120)


def load(arguments, servers, *flags):
    """What `capfit load` of all these servers found."""
    folder = servers[0].folder
    out = folder / "load.json"
    subprocess.run([arguments.capfit, "load", "--server", ",".join(server.address for server in servers),
                    "--token-file", folder / "load", "--json", out, *flags], stdout=subprocess.DEVNULL, check=False)
    return json.loads(out.read_text())


def parser_of(doc, flags_help):
    """With what every measurement is told: the programs, where the figures go, and what follows `--`."""
    parser = argparse.ArgumentParser(description=doc, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--server", required=True)
    parser.add_argument("--capfit", required=True)
    parser.add_argument("--json")
    parser.add_argument("flags", nargs="*", help=flags_help)
    return parser
