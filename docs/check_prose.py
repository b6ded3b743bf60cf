#!/usr/bin/env python3
"""Checks that the documentation is plain and that its links work. Usage: check_prose.py SOURCE_DIR

Every Markdown file but CHANGELOG.md is read. Complaints, one a line, each with its file and line:
- a line of prose is longer than 100 characters (tables and code may be longer);
- a sentence has more than 40 words, or the sentences of a file more than 20 words on average;
- a relative link leads to no file, or to no heading of it;
- a file or folder of the repository that the text names in `code` does not exist.
"""
import pathlib
import re
import sys

LINE, SENTENCE, MEAN = 100, 40, 20
SKIPPED = {"CHANGELOG.md"}
FILE = re.compile(r"[\w.-]+(/[\w.-]+)*/?")
SUFFIXES = {".cpp", ".hpp", ".md", ".py", ".sh", ".cmake", ".lcm", ".obj", ".vtu", ".vtp"}


def markdown_files(source):
    for path in sorted(source.rglob("*.md")):
        inside = path.relative_to(source).parts
        if inside[0] not in ("build", "out") and inside[-1] not in SKIPPED and inside[0][0] != ".":
            yield path


def prose(text):
    """(line number, line) of what is no code block, table, or indented code."""
    fenced = False
    for number, line in enumerate(text.splitlines(), 1):
        if line.lstrip().startswith("```"):
            fenced = not fenced
        elif not fenced and not line.startswith(("|", "    ")):
            yield number, line


def blocks(text):
    """Paragraphs and items of lists, each with the number of its first line."""
    block, start, last = [], 0, -1
    for number, line in prose(text):
        begins = re.match(r"\s*([-*]|\d+\.)\s", line)
        if block and (begins or not line.strip() or number != last + 1):
            yield start, " ".join(block)
            block = []
        if line.strip() and not line.startswith("#"):
            start = start if block else number
            block.append(line.strip())
        last = number
    if block:
        yield start, " ".join(block)


def sentences(block):
    block = re.sub(r"^([-*]|\d+\.)\s+", "", block)
    block = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", block)
    block = re.sub(r"`[^`]*`", "code", block)
    block = re.sub(r"\b(e\.g|i\.e|et al|eq|eqs|Fig|vs|J|Math|Comp|Acta)\.", r"\1", block)
    for sentence in re.split(r"(?<=[.!?])[)*\"]*\s+(?=[A-Z(*\"`0-9]|code)", block):
        # A word holds a letter or a digit: signs alone are none.
        words = [w for w in sentence.split() if re.search(r"\w", w)]
        if words:
            yield len(words), sentence


def anchors(path):
    for line in path.read_text().splitlines():
        if line.startswith("#"):
            title = line.lstrip("#").strip().lower()
            yield re.sub(r"[^\w\- ]", "", title).replace(" ", "-")


def broken_links(source, path, text):
    for number, line in prose(text):
        for target in re.findall(r"\]\(([^)\s]+)\)", line):
            if re.match(r"[a-z]+:", target):
                continue
            file, _, anchor = target.partition("#")
            to = path if not file else path.parent / file
            if not to.exists():
                yield f"{number}: links to {target}, which does not exist"
            elif anchor and anchor not in anchors(to):
                yield f"{number}: links to {target}, whose file has no such heading"


def missing_files(source, known, text):
    """Names in `code` that look like files of the repository and are none."""
    tops = {p.name for p in source.iterdir()}
    for number, line in enumerate(text.splitlines(), 1):
        if line.startswith("    "):
            continue
        for name in re.findall(r"`([^`]+)`", line):
            if not FILE.fullmatch(name) or "NAME" in name:
                continue
            path = pathlib.PurePosixPath(name)
            if "/" in name and path.parts[0] in tops - {"build", "out"}:
                exists = (source / name).exists() or list(source.glob(name + ".?pp"))
            elif "/" not in name and path.suffix in SUFFIXES and path.stem:
                exists = name in known
            else:
                continue
            if not exists:
                yield f"{number}: names `{name}`, which does not exist"


def check(source):
    files = list(markdown_files(source))
    skipped = {"build", ".git", "out"}
    known = {p.name for top in source.iterdir() if top.name not in skipped
             for p in ([top] if top.is_file() else top.rglob("*"))}
    complaints = []
    for path in files:
        name, text = path.relative_to(source).as_posix(), path.read_text()
        for number, line in prose(text):
            if len(line) > LINE and not line.startswith("!["):
                complaints.append(f"{name}:{number}: {len(line)} characters; at most {LINE}")
        lengths = []
        for number, block in blocks(text):
            for count, sentence in sentences(block):
                lengths.append(count)
                if count > SENTENCE:
                    complaints.append(f"{name}:{number}: {count} words: '{sentence[:50]}...'")
        if lengths and sum(lengths) > MEAN * len(lengths):
            mean = sum(lengths) / len(lengths)
            complaints.append(f"{name}: {mean:.1f} words a sentence; at most {MEAN}")
        for what in (*broken_links(source, path, text), *missing_files(source, known, text)):
            complaints.append(f"{name}:{what}")
    return len(files), complaints


def main():
    count, complaints = check(pathlib.Path(sys.argv[1]).resolve())
    print("\n".join(complaints + [f"{count} files, {len(complaints)} complaints"]))
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
