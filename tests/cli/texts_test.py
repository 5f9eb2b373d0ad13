#!/usr/bin/env python3
"""The texts: the README stays short, its program is the one that is compiled, and links lead somewhere."""

import os
import pathlib
import re
import unittest

ROOT = pathlib.Path(os.environ["RETRACE_SOURCE_DIR"])
PROGRAM = "apps/examples/find_a_walk.cpp"
TEXTS = sorted(path for path in ROOT.rglob("*.md") if not {"build", "out"} & set(path.relative_to(ROOT).parts))


class TextsTest(unittest.TestCase):
    def test_the_readme_is_short(self):
        self.assertLessEqual(len((ROOT / "README.md").read_text(encoding="utf-8").splitlines()), 130)

    def test_the_readme_shows_the_program_that_is_compiled(self):
        if not (ROOT / PROGRAM).exists():
            self.skipTest(f"{PROGRAM} does not exist")
        shown = re.search(f"<!-- {PROGRAM} -->\n\n```cpp\n(.*?)```\n", (ROOT / "README.md").read_text(encoding="utf-8"), re.S)
        self.assertIsNotNone(shown, f"README.md: expected a block of code after <!-- {PROGRAM} -->")
        program = (ROOT / PROGRAM).read_text(encoding="utf-8")
        self.assertEqual(shown.group(1), program)
        self.assertLessEqual(len(program.splitlines()), 25)

    def test_no_shell_is_called(self):
        """Names of files and what is in them are never part of a command line."""
        calls = re.compile(r"\b(?:system|popen|wordexp|execl[pe]?)\s*\(|\"(?:/bin/)?sh\"")
        sources = [path for room in ("libvo", "libplace", "apps") for path in sorted((ROOT / room).rglob("*.[ch]pp"))]
        self.assertGreater(len(sources), 300)
        for path in sources:
            self.assertEqual(calls.findall(path.read_text(encoding="utf-8")), [], path)

    def test_links_lead_somewhere(self):
        self.assertIn(ROOT / "README.md", TEXTS)
        for text in TEXTS:
            for link in re.findall(r"\]\(([^)#]+)", text.read_text(encoding="utf-8")):
                if "://" not in link:
                    self.assertTrue((text.parent / link).exists(), f"{text.relative_to(ROOT)}: {link}")


if __name__ == "__main__":
    unittest.main(verbosity=2)
