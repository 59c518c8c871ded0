#!/usr/bin/env python3
"""Wraps the paragraphs and list items of Markdown files at 110 columns.

Headings, tables, code, HTML, link definitions and rules stay as they are, to the byte. No character but white space changes, and a second run
changes nothing. A code span of up to 60 columns and "FIG. 25" stay on one line, and no line begins with a word that would begin a list, a
heading, a quote or a table.
Usage: wrap_documents.py [FILE...]; without FILE all documents of the repository. Prints the files that it changed."""
import os
import pathlib
import re
import sys

WIDTH = 110
LONGEST_SPAN = 60  # a longer code span is broken like text
FOREIGN_FOLDERS = {"build", "node_modules"}

# Kinds of lines. Text is what is wrapped: paragraphs, with or without the marker of a list item or of a quotation.
BLANK, TEXT, HEADING, TABLE, CODE, HTML, OTHER = "blank", "text", "heading", "table", "code", "html", "other"

FENCE = re.compile(r"\s*(```+(?=[^`]*$)|~~~+)")
HEADING_LINE = re.compile(r" {0,3}#{1,6}(\s|$)")
RULE = re.compile(r"\s*(([-*_])(\s*\2){2,}|=+|-+)\s*$")  # thematic breaks, and the lines beneath headings of two lines
HTML_LINE = re.compile(r"\s*<(!--|\?|!\w|/?[A-Za-z][\w-]*(\s|/?>|$))")
ITEM = re.compile(r"(\s*)([-*+]|(\d{1,9})[.)])(\s+)(?=\S)")
EMPTY_ITEM = re.compile(r"\s*([-*+]|\d{1,9}[.)])\s*$")
QUOTE = re.compile(r" {0,3}> ?")
DEFINITION = re.compile(r" {0,3}\[[^\]]+\]:\s")
CODE_SPAN = re.compile(r"(?<![\\`])(`+)(?!`)(.+?)(?<!`)\1(?!`)", re.DOTALL)
STARTS_A_BLOCK = re.compile(r"([-+*]|\d{1,9}[.)]|#{1,6}|[*_=-]+|[>|].*|```.*|~~~.*|<[A-Za-z!/?][^:@]*)$")
STICKS_TO_THE_NEXT = re.compile(r"\(?FIGS?\.$")


def documents(root):
    """README.md wherever it stands, and all Markdown of the root and of docs/."""
    for folder, below, files in os.walk(root):
        below[:] = sorted(f for f in below if f not in FOREIGN_FOLDERS and not f.startswith("."))
        here = pathlib.Path(folder).relative_to(root)
        for name in sorted(files):
            if name == "README.md" or (name.endswith(".md") and here.parts[:1] in ((), ("docs",))):
                yield here / name


class Line:
    """One line: its kind, and for text the prefix of this line, that of the lines after it, and whether it begins a paragraph."""

    def __init__(self, kind, text, first="", then="", begins=False):
        self.kind, self.text, self.first, self.then, self.begins = kind, text, first, then, begins

    @property
    def body(self):
        return self.text[len(self.first):] if self.begins else self.text.strip()


def is_special(text):
    """Whether text where a paragraph may begin begins something else."""
    return bool(text.startswith(("|", "    ", ">")) or any(
        pattern.match(text) for pattern in (FENCE, HEADING_LINE, HTML_LINE, RULE, EMPTY_ITEM, DEFINITION)))


def classified(lines):
    """A Line for each line of a file."""
    fence, in_comment, in_html = None, False, False
    paragraph = None  # the column at which the text of the open paragraph begins
    items = []  # columns at which the text of open list items begins
    for text in lines:
        indent = len(text) - len(text.lstrip())
        if fence:
            yield Line(CODE, text)
            if re.fullmatch(r"\s*" + re.escape(fence) + r"[`~]*\s*", text):
                fence = None
            continue
        if in_comment:
            in_comment = "-->" not in text
            yield Line(HTML, text)
            continue
        if not text.strip():
            paragraph, in_html = None, False
            yield Line(BLANK, text)
            continue
        if in_html:
            yield Line(HTML, text)
            continue
        item = ITEM.match(text)
        if item and RULE.match(text):
            item = None
        if item and paragraph not in (None, "quote") and indent >= paragraph and item[3] not in (None, "1"):
            item = None  # "1984. " in a paragraph: only 1 begins a list there
        if paragraph is None or item:
            while items and indent < items[-1]:
                items.pop()
        base = items[-1] if items else 0
        if paragraph is None and indent - base >= 4:
            yield Line(CODE, text)
            continue
        if item:
            items.append(len(item[0]))
            rest = text[len(item[0]):]
            paragraph = len(item[0])
            if is_special(rest):
                opened, paragraph = FENCE.match(rest), None
                fence = opened[1] if opened else None
                yield Line(CODE if fence else OTHER, text)
            else:
                yield Line(TEXT, text, item[0], " " * len(item[0]), True)
            continue
        opened = FENCE.match(text)
        kind = None
        if opened:
            kind, fence = CODE, opened[1]
        elif HEADING_LINE.match(text):
            kind = HEADING
        elif text.lstrip().startswith("|"):
            kind = TABLE
        elif RULE.match(text) or EMPTY_ITEM.match(text) or (paragraph is None and DEFINITION.match(text)):
            kind = OTHER
        elif HTML_LINE.match(text):
            kind, in_comment = HTML, "<!--" in text and "-->" not in text
            in_html = not in_comment and "<!--" not in text
        if kind:
            paragraph = None
            while items and indent < items[-1]:
                items.pop()
            yield Line(kind, text)
            continue
        quote = QUOTE.match(text)
        if quote:  # every line has its own mark; an empty one ends a paragraph
            while items and indent < items[-1]:
                items.pop()
            body = text[len(quote[0]):]
            marker = ITEM.match(body)
            begins = paragraph != "quote" or bool(marker)
            if not body.strip() or is_special(body) or (marker and is_special(body[len(marker[0]):])):
                paragraph = None
                yield Line(OTHER, text)
                continue
            paragraph = "quote"
            first = quote[0] + (marker[0] if marker else "")
            then = quote[0] + " " * (len(marker[0]) if marker else 0)
            yield Line(TEXT, text, first, then, True) if begins else Line(TEXT, body)
            continue
        if paragraph is None:
            paragraph = base
            yield Line(TEXT, text, text[:indent], text[:indent], True)
        else:
            yield Line(TEXT, text)


def atoms(text):
    """The words, or what must stay on one line: words that belong together, and short code spans."""
    spans = [m.span() for m in CODE_SPAN.finditer(text) if m.end() - m.start() <= LONGEST_SPAN]
    words, start = [], 0
    for space in re.finditer(r"\s+", text):
        if any(a < space.start() < b for a, b in spans):
            continue
        words.append(text[start:space.start()])
        start = space.end()
    words.append(text[start:])
    joined = []
    for word in filter(None, words):
        word = word.replace("\n", " ")
        if joined and (STARTS_A_BLOCK.match(word) or STICKS_TO_THE_NEXT.search(joined[-1])):
            joined[-1] += " " + word
        else:
            joined.append(word)
    return joined


def filled(paragraph, width):
    """The lines of one paragraph, which may have hard breaks, anew."""
    first, then = paragraph[0].first, paragraph[0].then
    pieces, piece = [], []
    for number, line in enumerate(paragraph):
        last = number + 1 == len(paragraph)
        hard = re.search(r"(  +|\\)$", line.text) if not last else None
        piece.append(line.body.strip())
        if hard or last:
            pieces.append(("\n".join(piece), "  " if hard and hard[1] != "\\" else ""))
            piece = []
    if any(STARTS_A_BLOCK.match(text.split()[0]) for text, _ in pieces[1:]):
        yield from (line.text for line in paragraph)  # only their indentation makes them text
        return
    prefix = first
    for text, ending in pieces:
        current = prefix
        empty = True
        for atom in atoms(text):
            if not empty and len(current) + 1 + len(atom) > width:
                yield current
                current, empty = then, True
            current += atom if empty else " " + atom
            empty = False
        yield current + ending
        prefix = then


def wrapped(text, width=WIDTH):
    out, paragraph = [], []

    def close():
        out.extend(filled(paragraph, width) if paragraph else [])
        paragraph.clear()

    for line in classified(text.split("\n")):
        if line.kind != TEXT or line.begins:
            close()
        if line.kind == TEXT:
            paragraph.append(line)
        else:
            out.append(line.text)
    close()
    result = "\n".join(out)
    if words(result) != words(text):
        raise AssertionError("wrapping would change more than white space")
    return result


def words(text):
    """All but the white space, and the marks of quotations, of which there is one a line."""
    return [w for line in text.split("\n") for w in re.sub(r"^ {0,3}>", "", line).split()]


def main():
    root = pathlib.Path(__file__).resolve().parent.parent
    files = [pathlib.Path(f) for f in sys.argv[1:]] or [root / d for d in documents(root)]
    for file in files:
        if file.suffix != ".md":
            sys.exit(f"{file}: no document (.md); left as it is")
    for file in files:
        before = file.read_bytes().decode("utf-8")
        after = wrapped(before)
        if after != before:
            file.write_bytes(after.encode("utf-8"))
            print(file)


if __name__ == "__main__":
    main()
