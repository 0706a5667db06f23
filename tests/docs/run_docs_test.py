"""The checks of the documents find what they are for: each is given a page that is wrong."""
from __future__ import annotations

import pathlib
import tempfile
import types
import unittest

import documents
import runners
import statements

ROOT = pathlib.Path(__file__).resolve().parents[2]


def page(text):
    return documents.Document(pathlib.Path("docs/page.md"), text)


def block(language, code, *marks):
    return documents.Block(pathlib.Path("page.md"), 10, language, code, list(marks))


class Marks(unittest.TestCase):
    def test_are_read_with_their_block(self):
        read = page("text\n\n<!-- docs-test: skip because of rain -->\n\n```sh\nfalse\n```\n")
        self.assertEqual(read.blocks[0].mark("skip because "), "of rain")
        self.assertEqual(read.blocks[0].line, 6)
        self.assertEqual(read.problems, [])

    def test_go_over_several_lines(self):
        read = page("<!-- docs-test: before\nx = 1\n-->\n```python\nassert x\n```\n")
        self.assertEqual(read.blocks[0].mark("before\n"), "x = 1")

    def test_unknown_or_loose_ones_are_problems(self):
        for text in ("<!-- docs-test: skip -->\n```sh\n```\n", "<!-- docs-test: elided -->\ntext\n",
                     "<!-- docs-test: skip because -->\n```sh\n```\n"):
            self.assertEqual(len(page(text).problems), 1, text)


class Statements(unittest.TestCase):
    def test_links(self):
        good = page("# A B\n[a](../README.md) [b](https://x.y/z) [c](architecture.md#rooms) [d](#a-b)\n")
        self.assertEqual(list(statements.broken_links(ROOT, good)), [])
        for target in ("none.md", "architecture.md#none", "#none"):
            self.assertEqual(len(list(statements.broken_links(ROOT, page(f"[a]({target})\n")))), 1, target)

    def test_paths(self):
        good = page("`core/formats/read_*.h` `core/formats/read_NAME.h` `.ci/rooms` `tests/data/fuzz/NAME` `a/b`\n")
        self.assertEqual(list(statements.missing_paths(ROOT, good)), [])
        wrong = page("`core/mesh/none.h`\n\n`cat proto/none.proto`\n")
        self.assertEqual(len(list(statements.missing_paths(ROOT, wrong))), 2)

    def test_flags(self):
        flags = types.SimpleNamespace(of={"render": {"--views"}, "info": {"--timeout"}, "": {"--version"},
                                          "server": {"--listen"}})
        flags.all = set().union(*flags.of.values())
        good = page("`--views` `capfit COMMAND --timeout` `capfit-server --listen X`\n\n"
                    "```sh\ncapfit render a \\\n  --views 3 && capfit info --timeout 2  # --none\n```\n")
        self.assertEqual(list(statements.unknown_flags(good, flags, "")), [])
        wrong = page("`--none` `capfit info --views`\n\n```sh\ntrue\nx | build/y/capfit render --timeout=1\n"
                     "capfit paint --views\ncapfit-server --views\n```\n")
        found = list(statements.unknown_flags(wrong, flags, ""))
        self.assertEqual(len(found), 5, found)
        self.assertTrue(any(problem.startswith("docs/page.md:5: ") for problem in found), found)

    def test_ranges(self):
        contract = statements.ranges_of_contract(ROOT)
        self.assertEqual(contract["max_spheres"], (10, 500))
        self.assertLessEqual({field for field, _ in statements.RANGES.values()}, set(contract))
        compared = set()
        good = "| `--max-spheres` 10\u2013500, `--max-capsules` 5 to 1000 |\n\n| `--tolerance-mm` | 0\u2013100 |\n"
        self.assertEqual(list(statements.wrong_ranges(page(good), contract, compared)), [])
        self.assertEqual({field for _, field in compared}, {"max_spheres", "max_capsules", "tolerance_m"})
        for row in ("| `--max-spheres` 11\u2013500 |", "| `max_spheres`, `max_capsules` | 10 to 500 |",
                    "| `--polygon-error` 0.001 to 20 |", "| `--tolerance-mm` 0 to 0.1 |"):
            self.assertEqual(len(list(statements.wrong_ranges(page(row), contract, set()))), 1, row)


class Blocks(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.context = types.SimpleNamespace(
            root=ROOT, folder=pathlib.Path(folder.name), environment=None, has_buf=False,
            has_python_package=True, cpp_flags=["-std=c++20"], with_port=lambda code: code)

    def problems(self, *arguments):
        return runners.check(block(*arguments), self.context)

    def test_shell(self):
        self.assertEqual(self.problems("sh", "echo a >file\n"), [])
        self.assertEqual(self.problems("sh", "cat file | grep a\n"), [])
        wrong = self.problems("sh", "true\n\nf() { ls /none; }\nf | cat\n")[0]
        self.assertIn("page.md:12: ends with 2\n    > f() { ls /none; }", wrong)
        self.assertIn("cannot access", wrong)
        self.assertIn("page.md:11: ends with 3", self.problems("sh", "true\nexit_3() { return 3; }; exit_3\n")[0])

    def test_shell_that_must_be_marked(self):
        for code in ("sudo true", "tests/run.sh", "apt-get install x", "deploy/quickstart.sh  # y", "pip install x"):
            self.assertIn("must be marked", self.problems("sh", code)[0])
            self.assertEqual(self.problems("sh", code, "skip because of rain"), [])

    def test_missing_tools_are_told(self):
        with self.assertRaises(runners.Missing):
            self.problems("sh", "buf --version")

    def test_python(self):
        self.assertEqual(self.problems("python", "assert x == 1\n", "before\nx = 1\n"), [])
        self.assertIn("page.md:11: ends with 1\n    > assert x == 2",
                      self.problems("python", "y = 1\nassert x == 2\n", "before\nx = 1\n")[0])

    def test_cpp(self):
        self.assertEqual(self.problems("cpp", "#include <vector>\nstd::vector<int> a(n);\n", "before\nint n = 1;"), [])
        self.assertIn("does not compile", self.problems("cpp", "int a = b;\n")[0])

    def test_proto(self):
        self.assertEqual(self.problems("proto", "message A { FitOptions b = 1; }\n"), [])
        self.assertIn("is no proto", self.problems("proto", "message A { None b = 1; }\n")[0])

    def test_json(self):
        self.assertEqual(self.problems("json", '{"a": [1]}'), [])
        self.assertIn("page.md:11: is not JSON", self.problems("json", '{"a":\n x}')[0])
        code = '{"a": [[x, y], ...], "b": {"c..": .., "d": {...}, ...}, "e": ["f...", ...], "g": 0.5, ...}'
        self.assertEqual(self.problems("json", code, "elided"), [])
        self.assertIn("is not JSON", self.problems("json", '{"a": [x, }', "elided")[0])

    def test_json_as_in_a_file(self):
        self.assertIn("wrote real.json", self.problems("json", '{"a": ..}', "elided as in real.json")[0])
        (self.context.folder / "real.json").write_text('{"a": [{"b": 1}], "c": {}}')
        self.assertEqual(self.problems("json", '{"a": [{"b": x}, ...], ...}', "elided as in real.json"), [])
        for code, name in (('{"d": 1}', "d"), ('{"a": [{"e": 1}]}', "a.e"), ('{"a": {"b": 1}}', "a of that form")):
            self.assertIn(f"has no {name}", self.problems("json", code, "elided as in real.json")[0])

    def test_excerpts(self):
        mark = "excerpt of client/samples/cpp/approximate.cc"
        self.assertEqual(self.problems("cpp", '#include "client/body_client.h"\n\noptions.max_spheres = 32;\n'
                                       "for (const auto& [center, radius] : ...\n", mark), [])
        for code in ("options.max_spheres = 33;", 'options.max_spheres = 32;\n#include "client/body_client.h"'):
            self.assertIn("is not in client/samples", self.problems("cpp", code, mark)[0])


if __name__ == "__main__":
    unittest.main()
