#!/usr/bin/env python3
"""One name is one thing: no struct, class, union or enum of one qualified name is defined in two files.

The linker takes two different types of one name for one type (one-definition rule) and says nothing. Looked at are all headers, and the sources
of the libraries and the program; types in functions and in namespaces without a name belong to one file and are left out, and so are
specialisations of templates. The text is read as it stands, all branches of #if.
Usage: check_definitions.py [ROOT]; prints one line per violation and exits 1 if there is one."""
import pathlib
import re
import sys

LIBRARIES = ("scene", "exact", "reference", "fastpath", "validate", "fuzz", "app")
TESTS = ("tests", "bench")
HEADERS, SOURCES = {".h", ".hpp"}, {".c", ".cpp", ".cc"}

# Comments, literals and preprocessor lines hold no definition; a quote between digits is none.
NOISE = re.compile(
    r"""//[^\n]*|/\*.*?\*/|R"([^(\s]*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|(?<![0-9a-fA-F])'(?:\\.|[^'\\\n])+'"""
    r"""|^[ \t]*\#(?:\\\n|[^\n])*""",
    re.DOTALL | re.MULTILINE)
NAMESPACE = re.compile(r"^(?:inline\s+)?namespace(?:\s+([\w:]+))?$")
TYPE = re.compile(r"^(?:typedef\s+|static\s+|const\s+|constexpr\s+|inline\s+)*(?:enum\s+(?:class|struct)|enum|struct|class|union)\b"
                  r"(?:\s*(?:\[\[.*?\]\]|alignas\s*\([^()]*\)|__attribute__\s*\(\(.*?\)\)))*"
                  r"\s+([A-Za-z_][\w:]*)(?:\s+final)?\s*(?::(?!:).*)?$", re.DOTALL)
C_LINKAGE = 'extern "C"'  # braces, and no scope
TEMPLATE = re.compile(r"^template\s*<")


def without_template(head):
    """The head of a declaration behind its `template <...>`."""
    while TEMPLATE.match(head):
        depth = parentheses = 0  # within parentheses "<" compares
        for at in range(head.index("<"), len(head)):
            parentheses += {"(": 1, ")": -1}.get(head[at], 0)
            if parentheses == 0:
                depth += {"<": 1, ">": -1}.get(head[at], 0)
            if depth == 0:
                break
        head = head[at + 1:].lstrip()
        requires = re.match(r"requires\b.*?(?=\b(?:struct|class|union)\b)", head, re.DOTALL)
        head = head[requires.end():] if requires else head
    return head


def definitions(text):
    """Qualified name and line of every type that has a body."""
    text = NOISE.sub(lambda m: re.sub(r"[^\n]", " ", m[0]), text)
    scopes = []  # names; "" for a namespace without one, None for everything in which types are local
    start = 0
    for match in re.finditer(r"[{};]", text):
        if match[0] == "{":
            head = re.sub(r"^(?:\s*(?:public|private|protected)\s*:(?!:))+", "", text[start:match.start()]).strip()
            head = without_template(head)
            space, kind = NAMESPACE.match(head), TYPE.match(head)
            if space:
                scopes.append(space[1] or "")
            elif kind:
                if all(scopes):
                    yield "::".join([*(s for s in scopes if s != C_LINKAGE), kind[1]]), text.count("\n", 0, match.start()) + 1
                scopes.append(kind[1])
            else:
                scopes.append(C_LINKAGE if head == "extern" else None)
        elif match[0] == "}" and scopes:
            scopes.pop()
        start = match.end()


def files_of(root):
    for folder in (*LIBRARIES, *TESTS):
        for path in sorted((root / folder).rglob("*")):
            if path.suffix in HEADERS or (path.suffix in SOURCES and folder in LIBRARIES):
                yield path


def violations(root):
    found = {}  # name: places, one for each file
    for path in files_of(root):
        here = {}
        for name, line in definitions(path.read_text(encoding="utf-8")):
            here.setdefault(name, f"{path.relative_to(root)}:{line}")
        for name, place in here.items():
            found.setdefault(name, []).append(place)
    if not found:
        yield f"{root}: no definitions found: nothing was checked"
    for name, places in sorted(found.items()):
        if len(places) > 1:
            yield f"{name} is defined more than once: {', '.join(places)}; give each thing a name of its own"


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent).resolve()
    found = list(violations(root))
    print("\n".join(found) if found else "one name is one thing")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
