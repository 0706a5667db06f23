"""Holds README and docs to the truth: every block runs or is checked, every path, flag and range that
they name is there.

  run_docs.py --build BUILD [--python-site FOLDER] [PAGE ...]

Blocks run in order, each page in a folder of its own that looks like the repository and has body.obj,
body.ply, body.glb (the same triangles) and frames.bin. capfit, capfit-server, buf and grpcurl are on
the PATH; the port 50051 is that of a real server. Marks for what cannot run: documents.py.

Exit code 77: all that could run is true, but a tool was missing.
"""
from __future__ import annotations

import argparse
import pathlib
import sys
import tempfile

import documents
import runners
import statements
import workshop


def script_texts(root):
    """The scripts, whose flags a page may name too."""
    files = [*root.glob(".ci/*"), *root.glob("deploy/*.sh"), *root.glob("tests/**/*.sh"),
             *root.glob("tests/bench/*.py")]
    return "\n".join(file.read_text() for file in files if file.is_file())


def statement_problems(root, pages, flags):
    contract, scripts, compared = statements.ranges_of_contract(root), script_texts(root), set()
    for page in pages:
        yield from page.problems
        yield from statements.broken_links(root, page)
        yield from statements.missing_paths(root, page)
        yield from statements.unknown_flags(page, flags, scripts)
        yield from statements.wrong_ranges(page, contract, compared)
    if any(str(page.path) == "README.md" for page in pages):
        told = {field for path, field in compared if path == "README.md"}
        for field in sorted({field for field, _ in statements.RANGES.values()} - told):
            yield f"README.md: its table of options does not tell the range of {field}"


def block_problems(pages, shop):
    """Problems, and what was missing; tells how each page went."""
    problems, missing = [], []
    for page in pages:
        context, skipped, before = shop.context(page.path), 0, len(problems)
        for block in page.blocks:
            skipped += block.mark("skip because ") is not None
            try:
                problems += runners.check(block, context)
            except runners.Missing as tool:
                missing.append(f"{block.place}: SKIPPED: no {tool}")
        print(f"{page.path}: {len(page.blocks)} blocks, {skipped} marked to be skipped, "
              f"{len(problems) - before} problems", flush=True)
    return problems, missing


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, required=True)
    parser.add_argument("--python-site", type=pathlib.Path, default=pathlib.Path("/nowhere"))
    parser.add_argument("--root", type=pathlib.Path, default=pathlib.Path(__file__).parents[2])
    parser.add_argument("pages", nargs="*", type=pathlib.Path)
    arguments = parser.parse_args()
    root = arguments.root.resolve()
    pages = [documents.read(root, page) for page in arguments.pages or documents.pages(root)]
    with tempfile.TemporaryDirectory() as scratch, workshop.Workshop(
            root, arguments.build.resolve(), arguments.python_site.resolve(), pathlib.Path(scratch)) as shop:
        flags = statements.Flags(shop.capfit, shop.server)
        problems = list(statement_problems(root, pages, flags))
        of_blocks, missing = block_problems(pages, shop)
    for problem in [*problems, *of_blocks, *missing]:
        print(problem)
    if problems or of_blocks:
        print(f"{len(problems) + len(of_blocks)} statements of the documents are not true")
        return 1
    return 77 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
