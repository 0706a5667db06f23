"""What the documents say about paths, flags and ranges, held against the repository."""
from __future__ import annotations

import re
import shlex
import subprocess

import documents

TOP_LEVEL = ("proto/", "server/", "client/", "core/", "deploy/", "tests/", "docs/", ".ci/")
FLAG = re.compile(r"(?<![\w-])--[a-z][a-z0-9-]*")
COMMANDS = ("approximate", "batch", "load", "inspect", "render", "evaluate", "animate", "export",
            "mannequin", "info")
# A range of a table: flags and fields by what the contract calls them, and what one of it is there.
RANGES = {
    "max_primitives": ("max_primitives", 1), "max_spheres": ("max_spheres", 1),
    "max_capsules": ("max_capsules", 1), "polygon_error": ("max_polygon_error", 1),
    "max_polygon_error": ("max_polygon_error", 1), "tolerance_mm": ("tolerance_m", 0.001),
    "tolerance_m": ("tolerance_m", 1),
}


def broken_links(root, document):
    for line, target in document.links():
        if re.match(r"[a-z]+:", target):
            continue
        path, _, anchor = target.partition("#")
        file = (root / document.path).parent / path
        if path and not file.exists():
            yield f"{document.path}:{line}: link to {target}, which does not exist"
        elif anchor and (not path or file.suffix == ".md"):
            linked = documents.Document(file, file.read_text()) if path else document
            if anchor not in linked.anchors():
                yield f"{document.path}:{line}: {path or 'this page'} has no heading '#{anchor}'"


def missing_paths(root, document):
    """Paths of the repository in code spans. NAME in capitals, * and {a,b} stand for anything."""
    for line, span in document.spans():
        for word in span.split():
            path = word.strip(",;:()").split("#")[0]
            if not path.startswith(TOP_LEVEL):
                continue
            pattern = re.sub(r"\{[^}]*\}|(?<![a-z])[A-Z]{4,}(?![a-z])", "*", path)
            # (Programs and modules may be named without their sources' ending.)
            found = any(root.glob(pattern.rstrip("/"))) or any(root.glob(pattern.rstrip("/") + ".*"))
            if not found:
                yield f"{document.path}:{line}: names {path}, which does not exist"


class Flags:
    """The flags of the programs, by command, as their --help tells them."""

    def __init__(self, capfit, server):
        def ask(*command):
            text = subprocess.run([*map(str, command), "--help"], capture_output=True, text=True,
                                  check=True).stdout
            return set(FLAG.findall(text)) | {"--help"}
        self.of = {command: ask(capfit, command) for command in COMMANDS}
        self.of[""] = ask(capfit) | {"--version"}
        self.of["server"] = ask(server) | {"--version"}
        self.all = set().union(*self.of.values())


def unknown_flags(document, flags, others):
    """`others`: text of the scripts, whose flags a page may name too."""
    for line, span in document.spans():
        lone = FLAG.match(span)
        yield from _unknown_of_command(f"{document.path}:{line}", span, flags)
        if lone and lone[0] not in flags.all and lone[0] not in others:
            yield f"{document.path}:{line}: names {lone[0]}, which no program or script has"
    for block in document.blocks:
        if block.language not in ("sh", "bash", "shell", "console"):
            continue
        text = block.code.replace("\\\n", "  ")  # (as long, so that lines keep their numbers)
        for index, command in enumerate(text.split("\n")):
            yield from _unknown_of_command(f"{block.path}:{block.line + index}", command, flags)


def _unknown_of_command(place, text, flags):
    for part in re.split(r"&&|\|\||[|;]", text.split(" #")[0]):
        try:
            words = shlex.split(part)
        except ValueError:
            words = part.split()
        programs = [i for i, word in enumerate(words)
                    if word in ("capfit", "capfit-server") or word.endswith(("/capfit", "/capfit-server"))]
        if not programs or words[0] in ("docker", "podman"):  # there it is an image's name
            continue
        rest = words[programs[0] + 1:]
        server = words[programs[0]].endswith("capfit-server")
        command = "server" if server else (rest[0] if rest and rest[0] in COMMANDS else "")
        if command == "" and rest and re.fullmatch("[a-z]+", rest[0]) and FLAG.search(part):
            yield f"{place}: capfit has no command '{rest[0]}'"
            continue
        known = flags.all if rest[:1] == ["COMMAND"] else flags.of[command]
        for word in rest:
            flag = FLAG.match(word)
            if flag and flag[0] not in known:
                yield f"{place}: `capfit{'-server' if server else ' ' + command}` has no {flag[0]}"


def ranges_of_contract(root):
    """Field: (low, high), from the comments of options.proto."""
    ranges, comment = {}, ""
    for line in (root / "proto/capfit/v1/options.proto").read_text().splitlines():
        line = line.strip()
        if line.startswith("//"):
            comment += line[2:]
            continue
        field = re.match(r"(?:optional |repeated )?[\w.]+ (\w+) = \d+;", line)
        told = re.search(r"Range:\s*\[([-\d.]+), ([-\d.]+)\]", comment)
        if field and told:
            ranges[field[1]] = (float(told[1]), float(told[2]))
        comment = ""
    return ranges


def wrong_ranges(document, contract, compared):
    """Rows of tables that name fields or flags with ranges. Adds to `compared` what was compared."""
    for line, row in document.prose:
        if not row.startswith("|"):
            continue
        names = [name for name in (word.lstrip("-").replace("-", "_") for word in
                                   re.findall(r"`(--[a-z-]+|[a-z_]+)`", row)) if name in RANGES]
        ranges = re.findall(r"(?<![\w.])(\d[\d.]*)(?: ?\u2013 ?| to )(\d[\d.]*\d|\d)(?![\w.]*\d)", row)
        if not names or not ranges:
            continue
        if len(names) != len(ranges):
            yield (f"{document.path}:{line}: {len(names)} options ({', '.join(names)}) but {len(ranges)} "
                   f"ranges ({', '.join('-'.join(r) for r in ranges)}): write 'LOW to HIGH' for each")
            continue
        for name, (low, high) in zip(names, ranges):
            field, unit = RANGES[name]
            told = (float(low) * unit, float(high) * unit)
            if any(abs(a - b) > 1e-9 for a, b in zip(told, contract[field])):
                yield (f"{document.path}:{line}: {name} is said to be in {low} to {high}; the contract "
                       f"has {field} in [{contract[field][0]:g}, {contract[field][1]:g}]")
            compared.add((str(document.path), field))
