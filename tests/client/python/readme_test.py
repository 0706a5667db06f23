"""The page on the package: its examples run, and its table of options is complete."""
import contextlib
import inspect
import io
import os
import re

import capfit
from support import ROOT, ServerTest

README = (ROOT / "client" / "python" / "README.md").read_text(encoding="utf-8")
EXAMPLES = re.findall(r"^```python\n(.*?)^```", README, re.DOTALL | re.MULTILINE)


class ReadmeTest(ServerTest):
    """client/python/README.md."""

    def test_examples_run_and_print_what_they_say(self):
        before = os.getcwd()
        self.addCleanup(os.chdir, before)
        os.chdir(self.scratch)
        known = {"capfit": capfit, "client": self.client, "vertices": self.vertices,
                 "faces": self.faces, "moved_vertices": self.vertices}
        self.assertEqual(len(EXAMPLES), 3)
        for example in EXAMPLES:
            printed = io.StringIO()
            with contextlib.redirect_stdout(printed):
                exec(example.replace("127.0.0.1:50051", self.address), dict(known))
            for comment in re.findall(r"print\(error.*?\)  +# (.*)", example):
                self.assertIn(comment, printed.getvalue())
        self.assertIn("OUT_OF_RANGE", printed.getvalue())
        self.assertTrue((self.scratch / "result.json").exists())

    def test_every_option_stands_in_the_table(self):
        options = set(inspect.signature(capfit.Client.approximate).parameters)
        table = README.partition("## Options")[2].partition("## Errors")[0]
        listed = set(re.findall(r"`([a-z_]+)`", " ".join(
            line.split("|")[1] for line in table.splitlines() if line.startswith("| `"))))
        self.assertEqual(listed, options - {"self", "body", "vertices", "faces"})
