#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Copyright (c) the clues authors. Permission is granted to use, copy, modify and distribute this file under the MIT licence,
# whose text is in vectors/LICENSE; it comes without any warranty.
"""An adapter for `clues conform`, to copy: JSON lines on standard input and output (docs/protocol.md).

    clues conform --impl 'python3 clues_adapter.py'

Python 3, standard library only. Replace potentially_visible_set, and what START says about your program."""
import json
import sys

START = {
    "protocol": 1,
    "implementation": {"name": "my implementation", "version": "0.1", "language": "Python"},
    # modes: "sheet" (both sides of a triangle can be seen) and "solid" (closed meshes, only front sides can).
    # input: "float32" if coordinates are stored in single precision: then only such scenes are sent.
    # see_through: true if it knows triangles that do not block or do not count; without it such scenes are not sent.
    "capabilities": {"modes": ["sheet", "solid"], "input": "float64", "see_through": True},
}


class Skip(Exception):
    """Raise it for input that your program does not support: counted, but no failure."""


# ---------------------------------------------------------------- replace this function ----------------------------------
def potentially_visible_set(vertices, triangles, cell, mode, see_through, not_counted):
    """The numbers of all triangles that may be visible from some point of the cell.

    vertices: list of [x, y, z]; triangles: list of [a, b, c], vertex numbers; cell: list of [x, y, z] whose convex hull is the view
    cell; mode: "sheet" or "solid"; see_through: numbers of triangles that sight lines pass; not_counted: of triangles that block and are not
    asked about. This one lists everything: sound, and as conservative as can be."""
    return [t for t in range(len(triangles)) if t not in not_counted]
# ------------------------------------------------------------------------------------------------------------------------


def run(request):
    case = request["case"]
    try:
        scene = case["scene"]
        visible = potentially_visible_set(scene["vertices"], scene["triangles"], case["cell"], case["mode"],
                                          set(scene.get("see_through", [])), set(scene.get("not_counted", [])))
        return {"seq": request["seq"], "result": {"visible": visible}}
    except Skip as reason:
        return {"seq": request["seq"], "skipped": {"message": str(reason)}}
    except Exception as error:  # the next case may work
        return {"seq": request["seq"], "errored": {"message": f"{type(error).__name__}: {error}"}}


def main():
    replies = sys.stdout
    sys.stdout = sys.stderr  # whatever else prints must not come between the replies
    for line in sys.stdin:
        request = json.loads(line)
        if request["cmd"] == "stop":
            return
        reply = START if request["cmd"] == "start" else run(request)
        print(json.dumps(reply), file=replies, flush=True)


if __name__ == "__main__":
    main()
