"""What documents and `--help` tell people to type: found, and run as typed."""
import dataclasses
import re
import subprocess


@dataclasses.dataclass
class Command:
    """What is typed at once: a line, or several that make one command."""
    text: str
    output: list  # lines that the document shows, or none


@dataclasses.dataclass
class Block:
    where: str  # file:line, or `clues map --help`
    lines: list

    def commands(self):
        """Lines are put together until a shell calls them complete. With "$ " before commands, the rest is their output."""
        shown = any(line.startswith("$ ") for line in self.lines)
        found, typed = [], ""
        for line in self.lines:
            if shown and not typed and not line.startswith("$ "):
                found[-1].output.append(line)
                continue
            typed += line.removeprefix("$ ") + "\n"
            if not typed.endswith("\\\n") and subprocess.run(["sh", "-n"], input=typed, text=True, capture_output=True, check=False).returncode == 0:
                found.append(Command(typed.strip(), []))
                typed = ""
        if typed:
            found.append(Command(typed.strip(), []))
        return found


def blocks_of_document(name, text):
    """Indented and fenced blocks, as Markdown has them; an indented one follows a blank line. Without those that name
    another language than that of the shell."""
    lines = text.split("\n")
    at = 0
    while at < len(lines):
        fence = re.match(r"( {0,3})```", lines[at])
        indented = lines[at].startswith("    ") and (at == 0 or not lines[at - 1].strip())
        begin = at + 1
        if fence:
            while begin < len(lines) and not lines[begin].lstrip().startswith("```"):
                begin += 1
            if lines[at].strip().removeprefix("```") in ("", "sh", "console"):
                yield Block(f"{name}:{at + 2}", [line.removeprefix(fence[1]) for line in lines[at + 1:begin]])
            begin += 1
        elif indented:
            while begin < len(lines) and lines[begin].startswith("    "):
                begin += 1
            margin = min(len(line) - len(line.lstrip()) for line in lines[at:begin])
            yield Block(f"{name}:{at + 1}", [line[margin:] for line in lines[at:begin]])
        at = begin


def blocks_of_help(name, text):
    section = re.search(r"^EXAMPLES\n((?:  .*\n|\n(?=  ))*)", text + "\n", re.MULTILINE)
    if section:
        yield Block(f"{name} --help", [line[2:] for line in section[1].split("\n") if line.strip()])


SYNOPSIS = re.compile(r"^clues .*(\[|\b(SCENE|FINDING|DIR)\b)")


def code_of(text, blocks):
    """All that stands there as code, in pieces: what is between two backticks, and the lines of blocks."""
    return re.findall(r"`([^`\n]+)`", text) + [line for block in blocks for line in block.lines]


def unknown_names(pieces, help_of):
    """Commands and options that code names and clues does not have. `help_of`: command -> text."""
    quoted = [word for piece in pieces for word in re.findall("'([^']*)'", piece)]
    for piece in quoted + [re.sub("'[^']*'", "''", piece) for piece in pieces]:
        for command, rest in re.findall(r"\bclues ([a-z]+)((?:(?!\bclues [a-z]| #).)*)", piece):
            if command not in help_of:
                yield f"clues {command}"
                continue
            second = re.match(r" ([a-z]+)", rest)
            if second and f"{command} {second[1]}" in help_of:  # a subcommand of it
                command = f"{command} {second[1]}"
            for option in re.findall(r"(?<![\w-])--[a-z][a-z-]*", rest):
                if not re.search(re.escape(option) + r"(?![\w-])", help_of[command]):
                    yield f"clues {command} {option}"


NUMBER = re.compile(r"-?\d+(\.\d+)?(e[-+]?\d+)?(/\d+)?")


def shape(line):
    """The words of a line; numbers may be any, and blanks as many as they like."""
    return " ".join(NUMBER.sub("#", line).split())


def run(text, folder, environment):
    """In a shell; what takes minutes is no example, or listed as not run."""
    return subprocess.run(["sh", "-c", text], cwd=folder, env=environment, stdin=subprocess.DEVNULL, capture_output=True,
                          text=True, timeout=300, check=False)


def flaws(command, expected_code, ran):
    """What is not as the document says."""
    if ran.returncode != expected_code:
        said = (ran.stderr.strip() or ran.stdout.strip())[-400:]
        yield f"exit code {ran.returncode} in place of {expected_code}: {said}"
    if command.output:
        wanted = [shape(line) for line in command.output]
        got = [shape(line) for line in ran.stdout.rstrip("\n").split("\n")]
        if got != wanted:
            yield "prints another thing than is shown:\n    " + "\n    ".join(ran.stdout.split("\n"))
