#!/usr/bin/env python3
"""docs/check_prose.py finds each kind of fault, and finds none in plain text. Needs no build."""
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "docs"))
from check_prose import check  # noqa: E402

PLAIN = """# A page
A [link](other.md#a-heading) works, so do names like `docs/other.md`.
A [site](https://x.org/a) is not asked.

| tables | may be longer than a hundred characters, because nobody can break a line of a table in two |
|---|---|

- An item ends here.
- So does this one.
"""
FAULTS = {
    "characters": "word-and-word " * 8,
    "41 words": "\n".join(["word " * 10] * 4) + "\nend.",
    "words a sentence": "\n".join(["word " * 10] * 3) + "\nend.",
    "which does not exist": "See [that](nowhere.md).",
    "no such heading": "See [that](other.md#nothing).",
    "names `docs/none.md`": "See `docs/none.md`.",
    "names `none.cpp`": "See `none.cpp`.",
}


def complaints(text):
    with tempfile.TemporaryDirectory() as folder:
        docs = pathlib.Path(folder) / "docs"
        docs.mkdir()
        (docs / "other.md").write_text("# A heading\nIt is short.\n")
        (docs / "page.md").write_text(text)
        return check(pathlib.Path(folder))[1]


failed = [f"plain text: {c}" for c in complaints(PLAIN)]
for expected, text in FAULTS.items():
    found = complaints(text + "\n")
    if len(found) != 1 and expected != "41 words" or not any(expected in c for c in found):
        failed.append(f"expected '{expected}' and no more; found {found}")
print("\n".join(failed) or f"{len(FAULTS)} faults found")
sys.exit(1 if failed else 0)
