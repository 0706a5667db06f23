"""Where blocks run: a server, programs on the PATH, and for each page a folder that looks like the
repository, with sample bodies in it."""
from __future__ import annotations

import json
import os
import pathlib
import struct
import subprocess
import time

DOCUMENTED_PORT = "50051"
# Stands for capfit-server in the blocks: on any free port, until it listens, then an orderly end.
SERVER_SHIM = """#!/usr/bin/env bash
set -euo pipefail
case " $* " in *" --help "*|*" --version "*) exec {server} "$@" ;; esac
folder=$(mktemp -d)
words=()
while [ $# -gt 0 ]; do
  case "$1" in
    --listen) shift 2 ;;
    --listen=*|--port-file=*) shift ;;
    --port-file) shift 2 ;;
    *) words+=("$1"); shift ;;
  esac
done
{server} --listen 127.0.0.1:0 --port-file "$folder/port" ${{words[@]+"${{words[@]}}"}} &
server=$!
for _ in $(seq 300); do
  [ -s "$folder/port" ] && break
  kill -0 "$server" 2>/dev/null || {{ wait "$server"; exit $?; }}
  sleep 0.1
done
[ -s "$folder/port" ] || {{ echo "the server does not listen" >&2; kill -KILL "$server"; exit 1; }}
kill -TERM "$server"
wait "$server"
"""
# grpcurl is no package of Debian: its calls are made by buf curl.
GRPCURL_SHIM = """#!/usr/bin/env bash
set -euo pipefail
data=(-d "{{}}") words=()
while [ $# -gt 0 ]; do
  case "$1" in
    -plaintext|-emit-defaults) shift ;;
    -max-msg-sz|-max-time) shift 2 ;;
    -d) if [ "$2" = @ ]; then data=(-d @-); else data=(-d "$2"); fi; shift 2 ;;
    -*) echo "grpcurl: the stand-in of tests/docs does not know $1" >&2; exit 1 ;;
    *) words+=("$1"); shift ;;
  esac
done
call() {{ {buf} curl --protocol grpc --http2-prior-knowledge "$@"; }}
url=http://${{words[0]}}
case "${{words[1]}}" in
  list) if [ ${{#words[@]}} -gt 2 ]; then call --list-methods "$url" | sed -n "s|^${{words[2]}}/||p" | grep .
        else call --list-services "$url"; fi ;;
  describe) call --list-services "$url" >/dev/null
            name=${{words[2]##*.}}; name=${{name##*/}}
            grep -rhE "^ *(service|message|enum|rpc) $name\\b" {root}/proto/capfit {root}/proto/grpc ;;
  *) call "${{data[@]}}" "$url/${{words[1]}}" ;;
esac
"""


def _run(*command):
    subprocess.run([str(word) for word in command], check=True, stdout=subprocess.DEVNULL)


def _read_triangles(path):
    positions, faces = [], []
    for words in (line.split() for line in path.read_text().splitlines()):
        if words[:1] == ["v"]:
            positions.append([float(word) for word in words[1:4]])
        elif words[:1] == ["f"]:
            faces.append([int(word.split("/")[0]) - 1 for word in words[1:]])
    return positions, faces


def write_glb(positions, faces, path):
    """One mesh of triangles, as binary glTF."""
    vertices = b"".join(struct.pack("<3f", *p) for p in positions)
    indices = b"".join(struct.pack("<3I", *f) for f in faces)
    low, high = ([pick(p[i] for p in positions) for i in range(3)] for pick in (min, max))
    text = json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "buffers": [{"byteLength": len(vertices) + len(indices)}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": len(vertices)},
                        {"buffer": 0, "byteOffset": len(vertices), "byteLength": len(indices)}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": len(positions), "type": "VEC3",
                       "min": low, "max": high},
                      {"bufferView": 1, "componentType": 5125, "count": 3 * len(faces), "type": "SCALAR"}],
    }).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text
    chunks += struct.pack("<I4s", len(vertices + indices), b"BIN\0") + vertices + indices
    path.write_bytes(struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks)


class Workshop:
    """Use in a `with`. `context(page)` is what the runners get."""

    def __init__(self, root, build, python_site, scratch):
        self.root, self.build, self.scratch = root, build, scratch
        self.capfit, self.server = build / "client/capfit", build / "server/capfit-server"
        self.buf = root / "node_modules/.bin/buf"
        self.has_buf = self.buf.exists()
        self.python_site = python_site
        self.has_python_package = (python_site / "capfit/__init__.py").exists()
        self.cpp_flags = ["-std=c++20", f"-I{root}", "-isystem", str(build / "proto"), "-isystem",
                          "/usr/include/eigen3"]

    def __enter__(self):
        self._make_programs()
        self._make_bodies()
        self._start_server()
        return self

    def __exit__(self, *_):
        self.process.terminate()
        self.process.wait(timeout=60)

    def _make_programs(self):
        programs = self.scratch / "bin"
        programs.mkdir()
        (programs / "capfit").symlink_to(self.capfit)
        (programs / "python3").symlink_to("/usr/bin/python3")
        if self.has_buf:
            (programs / "buf").symlink_to(self.buf)
        # Scripts that blocks call may not reach for these either.
        for name in ("apt-get", "sudo", "docker", "cmake", "ctest", "npm", "pip", "pip3"):
            (programs / name).write_text(f"#!/bin/sh\necho 'tests/docs: no {name} here' >&2; exit 1\n")
            (programs / name).chmod(0o755)
        for name, text in (("capfit-server", SERVER_SHIM), ("grpcurl", GRPCURL_SHIM)):
            (programs / name).write_text(text.format(server=self.server, buf=self.buf, root=self.root))
            (programs / name).chmod(0o755)
        self.programs = programs
        self.environment = {**os.environ, "PATH": f"{programs}:/usr/bin:{os.environ['PATH']}",
                            "PYTHONPATH": str(self.python_site), "PYTHONDONTWRITEBYTECODE": "1",
                            "BUF": str(self.buf)}

    def _make_bodies(self):
        """body.obj, .ply and .glb with the same triangles; frames.bin with two frames of them."""
        bodies = self.scratch / "bodies"
        bodies.mkdir()
        for ending in ("obj", "ply"):
            _run(self.capfit, "mannequin", "--triangles", "--faces", 6000, "-o", bodies / f"body.{ending}")
        positions, faces = _read_triangles(bodies / "body.obj")
        write_glb(positions, faces, bodies / "body.glb")
        flat = [value for position in positions for value in position]
        (bodies / "frames.bin").write_bytes(2 * struct.pack(f"<{len(flat)}f", *flat))
        self.bodies = bodies

    def _start_server(self):
        port_file = self.scratch / "port"
        log = open(self.scratch / "server.log", "w")
        self.process = subprocess.Popen([self.server, "--listen", "127.0.0.1:0", "--port-file", port_file],
                                        stderr=log)
        for _ in range(300):
            if port_file.exists() and port_file.read_text().strip():
                break
            if self.process.poll() is not None:
                raise RuntimeError((self.scratch / "server.log").read_text())
            time.sleep(0.1)
        self.port = port_file.read_text().strip()

    def context(self, page):
        return Context(self, page)


class Context:
    """One page's folder: links to all of the repository, copies of the bodies, and a build folder
    whose server is the stand-in."""

    def __init__(self, workshop, page):
        for name in ("root", "environment", "has_buf", "has_python_package", "cpp_flags"):
            setattr(self, name, getattr(workshop, name))
        self._port = workshop.port
        self.folder = workshop.scratch / str(page).replace("/", "_")
        self.folder.mkdir()
        for entry in workshop.root.iterdir():
            if entry.name not in ("build", "out", ".git"):
                (self.folder / entry.name).symlink_to(entry)
        for program, name in (("server", "capfit-server"), ("client", "capfit")):
            place = self.folder / "build/release" / program
            place.mkdir(parents=True)
            (place / name).symlink_to(workshop.programs / name)
        for body in workshop.bodies.iterdir():
            (self.folder / body.name).write_bytes(body.read_bytes())

    def with_port(self, code):
        return code.replace(DOCUMENTED_PORT, self._port)
