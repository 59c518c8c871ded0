#!/usr/bin/env python3
"""Documents can be read in any editor, and their links lead somewhere.

No line of a Markdown file is longer than 110 columns, but for tables, code, and lines of one word, such as an address; wrap_documents.py makes
them so. A relative link names a file or folder of the repository, and behind # a heading of that file. The files in tables of questions
(header "question | folder | file") are where these say.
Usage: check_documents.py [ROOT]; prints one line per violation and exits 1 if there is one."""
import pathlib
import re
import sys
import urllib.parse

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from wrap_documents import BLANK, CODE, CODE_SPAN, HEADING, TABLE, TEXT, WIDTH, classified, documents  # noqa: E402

LINK = re.compile(r"\]\(\s*<?([^)>\s]+)[^)]*\)|^ {0,3}\[[^\]]+\]:\s+<?([^>\s]+)", re.MULTILINE)
ANCHOR = re.compile(r"""<a\s[^>]*(?:id|name)=["']([^"']+)""")


def too_long(line):
    if len(line.text) <= WIDTH or line.kind in (TABLE, CODE):
        return False
    return len(line.body.split()) > 1 or line.kind != TEXT


def without_spans(text):
    return CODE_SPAN.sub(lambda m: re.sub(r"[^\n]", " ", m[0]), text)


def links(lines):
    """Line number and target of every link outside of code."""
    start = 0
    while start < len(lines):
        end = start
        while end < len(lines) and lines[end].kind not in (BLANK, CODE):
            end += 1
        block = without_spans("\n".join(line.text for line in lines[start:end]))
        for match in LINK.finditer(block):
            yield start + 1 + block.count("\n", 0, match.start()), match[1] or match[2]
        start = end + 1


def anchor_of(heading):
    """As the forges make it: lower case, without marks, hyphens for spaces."""
    text = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", heading.strip().lstrip("#").strip())
    text = re.sub(r"\s+#+$", "", text).lower()
    return re.sub(r"[^\w\- ]", "", text).replace(" ", "-")


def anchors(lines):
    seen = {}
    for line in lines:
        if line.kind == HEADING:
            name = anchor_of(line.text)
            again = seen.get(name, 0)
            seen[name] = again + 1
            yield f"{name}-{again}" if again else name
        if line.kind != CODE:
            yield from ANCHOR.findall(line.text)


def lines_of(file):
    return list(classified(file.read_text(encoding="utf-8").split("\n")))


def flaw_of_link(root, file, target):
    """Why the target, seen from the file, leads nowhere; None where it does not."""
    if re.match(r"[A-Za-z][A-Za-z0-9+.-]+:", target):
        return None  # the network is not asked
    path, _, anchor = target.partition("#")
    path = urllib.parse.unquote(path)
    if path.startswith("/"):
        return "is an absolute path"
    goal = (file.parent / path).resolve() if path else file
    if not goal.is_relative_to(root):
        return "leads out of the repository"
    if not goal.exists():
        return "names no file"
    if anchor and goal.suffix == ".md" and urllib.parse.unquote(anchor) not in set(anchors(lines_of(goal))):
        return "names no heading there"
    return None


def wrong_answers(root, lines):
    """Line number and file of every answer in a table of questions that is not there."""
    inside = False
    for number, line in enumerate(lines, 1):
        cells = [cell.strip() for cell in line.text.strip().strip("|").split("|")]
        if line.kind != TABLE:
            inside = False
        elif cells == ["question", "folder", "file"]:
            inside = True
        elif inside and len(cells) == 3:
            for file in re.findall(r"`([^`]+)`", cells[2]):
                path = cells[1].strip("`") + "/" + file
                if not (root / path).is_file():
                    yield number, path


def violations(root):
    seen = 0
    for document in documents(root):
        seen += 1
        lines = lines_of(root / document)
        for number, line in enumerate(lines, 1):
            if too_long(line):
                yield f"{document}:{number}: {len(line.text)} columns, more than {WIDTH} (.ci/wrap_documents.py wraps paragraphs)"
        for number, target in links(lines):
            flaw = flaw_of_link(root, root / document, target)
            if flaw:
                yield f"{document}:{number}: the link {target} {flaw}"
        for number, path in wrong_answers(root, lines):
            yield f"{document}:{number}: there is no file {path}"
    if seen == 0:
        yield f"{root}: no documents found: nothing was checked"


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent).resolve()
    found = list(violations(root))
    print("\n".join(found) if found else "documents keep their width, and their links lead somewhere")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
