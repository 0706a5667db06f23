"""Runs or checks one fenced block. Each function gives a list of problems; Missing: a tool is not there."""
from __future__ import annotations

import json
import os
import pathlib
import re
import signal
import subprocess
import tempfile

TIMEOUT_SECONDS = 900  # against blocks that never end; a busy machine may take minutes for seconds
# What would change the machine, build for minutes or call these tests again: must be marked.
FORBIDDEN = re.compile(r"(?<![\w/-])(apt-get|sudo|docker|npm|pip3?|ctest|cmake|"
                       r"(?:\./)?(?:deploy|tests|\.ci)/[\w./-]+)(?![\w-])")


class Missing(Exception):
    """A tool that the block needs; its message says how to get it."""


def _report(block, line, what, output):
    code = block.code.splitlines()
    command = code[line] if 0 <= line < len(code) else ""
    tail = "\n".join("    | " + text for text in output.strip().splitlines()[-25:])
    return [f"{block.path}:{block.line + max(line, 0)}: {what}\n    > {command.strip()}\n{tail}"]


def run_shell(block, context):
    """As a script of bash -eu in the page's folder; the line that fails is named."""
    forbidden = FORBIDDEN.search(block.code)
    if forbidden:
        return [f"{block.place}: has '{forbidden[1]}' and must be marked: "
                "<!-- docs-test: skip because ... -->"]
    for tool in ("buf", "grpcurl"):
        if re.search(rf"(?<![\w/-]){tool}\b", block.code) and not context.has_buf:
            raise Missing("buf, which npm install gives")
    before = block.mark("before\n") or ""
    script = (f"set -euo pipefail\n{before}\n"
              "trap 'echo \"docs-test: line $((LINENO - first))\" >&2' ERR\nset -E\nfirst=$((LINENO + 1))\n")
    script += context.with_port(block.code)
    with tempfile.NamedTemporaryFile("w", suffix=".sh") as file:
        file.write(script)
        file.flush()
        return _run(block, ["bash", file.name], context)


def run_python(block, context):
    if not context.has_python_package:
        raise Missing("the Python package: test python_client.install")
    before = block.mark("before\n") or ""
    code = context.with_port(before + "\n" + block.code)
    return _run(block, ["/usr/bin/python3", "-c", code], context, lines_before=before.count("\n") + 1)


def _run(block, command, context, lines_before=0):
    # A session of its own, so that what a block leaves behind can be ended with it.
    process = subprocess.Popen(command, cwd=context.folder, env=context.environment, text=True,
                               stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                               stderr=subprocess.STDOUT, start_new_session=True)
    try:
        told, _ = process.communicate(timeout=TIMEOUT_SECONDS)
        what = f"ends with {process.returncode}"
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        told, _ = process.communicate()
        what = f"still runs after {TIMEOUT_SECONDS} s"
    if process.returncode == 0:
        return []
    line = re.findall(r'docs-test: line (\d+)|File "<string>", line (\d+)', told)
    first = next((int(a) if a else int(b) - 1 - lines_before for a, b in line), 0)
    return _report(block, first, what, re.sub(r"docs-test: line \d+\n", "", told))


def compile_cpp(block, context):
    """Whole programs as they are; statements in a main(), with the includes before it."""
    code, before = block.code, block.mark("before\n") or ""
    if not re.search(r"\bint main\(", code):
        lines = (before + "\n" + code).splitlines()
        includes = [line for line in lines if line.startswith(("#include", "using "))]
        code = "\n".join(includes + ["int main() {"]
                         + [line for line in lines if line not in includes] + ["}", ""])
    return _compile(block, code, context.cpp_flags)


def _compile(block, code, flags):
    done = subprocess.run(["g++", "-fsyntax-only", "-x", "c++", *flags, "-"], input=code, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    return [] if done.returncode == 0 else _report(block, -1, "does not compile", done.stdout)


def check_proto(block, context):
    """Messages alone are given a head; whatever capfit.v1 has may be named."""
    code = block.code
    if "syntax" not in code:
        names = sorted(path.name for path in (context.root / "proto/capfit/v1").glob("*.proto"))
        code = ('syntax = "proto3";\npackage capfit.v1.docs;\n'
                + "".join(f'import "capfit/v1/{name}";\n' for name in names) + code)
    with tempfile.TemporaryDirectory() as folder:
        pathlib.Path(folder, "block.proto").write_text(code)
        done = subprocess.run(["protoc", f"-I{context.root / 'proto'}", f"-I{folder}",
                               f"--descriptor_set_out={folder}/out", "block.proto"],
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    return [] if done.returncode == 0 else _report(block, -1, "is no proto", done.stdout)


def check_json(block, context):
    """Parses; where values are elided, what is left must be JSON, with names of the real file."""
    code, elided = block.code, block.mark("elided")
    if elided is not None:
        code = without_elisions(code)
    try:
        value = json.loads(code)
    except json.JSONDecodeError as error:
        hint = "" if elided is not None else "; mark it `elided` where values are left out"
        return _report(block, error.lineno - 1, f"is not JSON: {error.msg}{hint}", "")
    name = (elided or "").removeprefix("as in").strip()
    if not name:
        return []
    file = context.folder / name
    if not file.exists():
        return [f"{block.place}: no block before it wrote {name}"]
    return [f"{block.place}: {name} has no {path}" for path in unknown_names(value, json.loads(file.read_text()))]


def without_elisions(code):
    """`, ...` goes; other `...`, `..` and words become null. Strings stay."""
    parts = re.split(r'("(?:[^"\\]|\\.)*")', code)
    for i in range(0, len(parts), 2):
        part = re.sub(r",\s*\.\.\.(?=\s*[\]}])", "", parts[i])
        part = re.sub(r"\.\.\.?(?![\d.])", "null", part)
        parts[i] = re.sub(r"\b(?!(?:true|false|null)\b)[A-Za-z_]\w*\b", "null", part)
    # What is left of `"...", ...` and of { ... }.
    return re.sub(r"\{\s*null\s*\}", "{}", re.sub(r",\s*null(?=\s*\})", "", "".join(parts)))


def unknown_names(told, real, path=""):
    """Names of `told` that `real` does not have at the same place."""
    if isinstance(told, dict) and isinstance(real, dict):
        for name, value in told.items():
            if name not in real:
                yield f"{path}{name}"
            else:
                yield from unknown_names(value, real[name], f"{path}{name}.")
    elif isinstance(told, list) and isinstance(real, list) and real:
        for value in told:
            yield from unknown_names(value, real[0], path)
    elif isinstance(told, (dict, list)) and not isinstance(real, type(told)):
        yield f"{path.rstrip('.')} of that form"


def check_excerpt(block, context):
    """Its lines are in the file, in this order; blanks do not count."""
    name = block.mark("excerpt of ")
    file = context.root / name
    if not file.exists():
        return [f"{block.place}: excerpt of {name}, which does not exist"]
    lines = [" ".join(line.split()) for line in file.read_text().splitlines()]
    at = 0
    for number, line in enumerate(block.code.splitlines()):
        wanted = " ".join(line.split())
        start = wanted.removesuffix("...").strip()
        if not start:
            continue
        for at in range(at, len(lines)):
            if lines[at] == wanted or (start != wanted and lines[at].startswith(start)):
                break
        else:
            return _report(block, number, f"is not in {name} any more, or not in this order", "")
        at += 1
    return []


RUNNERS = {
    **dict.fromkeys(("sh", "bash", "shell", "console"), run_shell),
    **dict.fromkeys(("python", "py"), run_python),
    **dict.fromkeys(("cpp", "c++"), compile_cpp),
    "json": check_json, "proto": check_proto, "protobuf": check_proto,
}


def check(block, context):
    """The problems of one block; Missing is raised where a tool is."""
    if block.mark("skip because ") is not None:
        return []
    if block.mark("excerpt of ") is not None:
        return check_excerpt(block, context)
    runner = RUNNERS.get(block.language)
    return runner(block, context) if runner else []
