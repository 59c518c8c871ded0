"""Changes that tests make on purpose in copies of our sources: which file is meant, and what becomes of its text."""


class NotFound(Exception):
    """What is to be changed is not there as it is written here."""


def source_of(root, name):
    """The file that `name` stands for: a top folder and a file name, as in reference/walk.cpp. It may lie in any folder below that one."""
    folder, base = name.split("/")
    found = sorted((root / folder).rglob(base))
    if len(found) != 1:
        raise NotFound(f"{name}: {len(found)} files are called {base} below {folder}/, and it has to be one")
    return found[0]


def edited(name, text, old, new):
    """`text`, the contents of the source `name`, with `new` in place of `old`."""
    count = text.count(old)
    if count != 1:
        raise NotFound(f"{name}: this text is there {count} times, and it has to be there once:\n{old}")
    return text.replace(old, new)
