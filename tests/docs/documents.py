"""Markdown as far as the checks need it: fenced blocks with their marks, prose, links, code spans.

A mark is an HTML comment right above a fenced block:

  <!-- docs-test: skip because REASON -->       the block cannot run here
  <!-- docs-test: excerpt of FILE -->           its lines are in FILE, in this order; `...` at the end
                                                of a line or alone stands for what is left out
  <!-- docs-test: elided -->                    JSON with `...` and words in place of values
  <!-- docs-test: elided as in RESULT.json -->  and every name in it is in that file, which a block
                                                before it wrote
  <!-- docs-test: before                        lines that go before the block when it runs
  CODE
  -->
"""
from __future__ import annotations

import dataclasses
import pathlib
import re
import textwrap

FENCE = re.compile(r"^(\s*)(`{3,}|~{3,})\s*([\w+-]*)")
MARK = re.compile(r"<!--\s*docs-test:\s*(.*?)\s*-->", re.DOTALL)
KINDS = ("skip because ", "excerpt of ", "elided", "before\n")


@dataclasses.dataclass
class Block:
    path: pathlib.Path
    line: int  # of its first line of code
    language: str
    code: str
    marks: list[str]

    def mark(self, kind):
        """What stands behind the kind's words; None where the block has no such mark."""
        return next((m[len(kind):].strip() for m in self.marks if m.startswith(kind)), None)

    @property
    def place(self):
        return f"{self.path}:{self.line}"


class Document:
    """One page. `problems`: marks that nobody can read."""

    def __init__(self, path, text):
        self.path, self.text = path, text
        self.blocks, self.problems, self.prose = [], [], []  # prose: (line, text) outside of blocks
        self._read(text.splitlines())

    def _read(self, lines):
        marks, number = [], 0
        while number < len(lines):
            line = lines[number]
            fence = FENCE.match(line)
            if fence:
                end = number + 1
                while end < len(lines) and not lines[end].strip().startswith(fence[2]):
                    end += 1
                code = textwrap.dedent("\n".join(lines[number + 1:end])) + "\n"
                self.blocks.append(Block(self.path, number + 2, fence[3].lower(), code, marks))
                marks, number = [], end + 1
                continue
            if line.strip().startswith("<!--"):
                end = number
                while end < len(lines) - 1 and "-->" not in lines[end]:
                    end += 1
                mark = MARK.search("\n".join(lines[number:end + 1]))
                if mark:
                    self._add_mark(mark[1], number + 1, marks)
                number = end + 1
                continue
            if line.strip():
                if marks:
                    self.problems.append(f"{self.path}:{number + 1}: a docs-test mark must stand "
                                         "right above a fenced block")
                marks = []
                self.prose.append((number + 1, line))
            number += 1

    def _add_mark(self, mark, line, marks):
        mark = mark + "\n" if mark == "before" else mark
        if not mark.startswith(KINDS) or mark.strip() == "skip because":
            self.problems.append(f"{self.path}:{line}: unknown mark '{mark}'; known: "
                                 + ", ".join(repr(kind.strip()) for kind in KINDS))
        marks.append(mark)

    def links(self):
        """(line, target) of each link and picture."""
        for line, text in self.prose:
            for target in re.findall(r"\]\(([^)\s]+)\)", re.sub(r"`[^`]*`", "", text)):
                yield line, target

    def spans(self):
        """(line, text) of each `code span`, also of those that go over a line's end."""
        text = "\n".join(line for _, line in self.prose)
        numbers = [number for number, _ in self.prose]
        for span in re.finditer(r"(?<!`)`([^`]+)`(?!`)", text):
            yield numbers[text.count("\n", 0, span.start())], span[1].replace("\n", " ")

    def anchors(self):
        """What GitHub makes of the headings: of those that come out alike, later ones get a number."""
        seen = {}
        for _, line in self.prose:
            if not line.startswith("#"):
                continue
            words = re.sub(r"[^\w\- ]", "", line.lstrip("#").strip().lower().replace("`", ""))
            anchor = words.replace(" ", "-")
            count = seen.get(anchor, 0)
            seen[anchor] = count + 1
            yield f"{anchor}-{count}" if count else anchor


def read(root, path):
    return Document(path, (root / path).read_text())


def pages(root):
    """All documents that are checked, relative to the root."""
    for pattern in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md", "docs/*.md", "docs/engines/*.md",
                    "client/*/README.md"):
        yield from (path.relative_to(root) for path in sorted(root.glob(pattern)))
