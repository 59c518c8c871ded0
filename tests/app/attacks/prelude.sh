# What the rows of stores.txt use. CLUES: the program; FINDING: the folder of a good finding, about triangle 4 of scene.off; SUITE: the conformance suite.
set -u
clues() { "$CLUES" "$@"; }
# A program that hides everything, as a subject that the user names.
BLIND="sh -c ': > {pvs}'"
CELL=box:-0.25,-0.25,-0.25,0.25,0.25,0
GRID=grid:2x1x1:box:-1,-1,-1,1,1,0
ESC=$(printf '\033')

# NAME: a copy of the good finding.
finding() { cp -R "$FINDING" "$1"; }

# FOLDER CODE: changes j (finding.json) and w (witness.json) by Python, or files by hand; then sets all hashes right, as somebody would who knows how.
forge() {
  "$PYTHON" - "$1" "${2:-pass}" <<'END'
import hashlib, json, pathlib, sys
folder = pathlib.Path(sys.argv[1])
j = json.loads((folder / "finding.json").read_text())
w = json.loads((folder / "witness.json").read_text())
before = json.dumps(w)
exec(sys.argv[2])
if json.dumps(w) != before: (folder / "witness.json").write_text(json.dumps(w, indent=2) + "\n")
for key, place in (("sha256", folder), ("sha256_original", folder / "original")):
    for name in j[key]: j[key][name] = hashlib.sha256((place / name).read_bytes()).hexdigest()
text = lambda: json.dumps(j, indent=2, sort_keys=True, ensure_ascii=False) + "\n"
if "checksum" in j:
    del j["checksum"]
    j["checksum"] = hashlib.sha256(text().encode()).hexdigest()
(folder / "finding.json").write_text(text())
END
}

# FILE CODE: changes j by Python.
edit() {
  "$PYTHON" - "$1" "$2" <<'END'
import json, pathlib, sys
file = pathlib.Path(sys.argv[1])
j = json.loads(file.read_text())
exec(sys.argv[2])
file.write_text(json.dumps(j, indent=2, sort_keys=True) + "\n")
END
}

# STORE CODE: changes the database s by Python.
store() {
  "$PYTHON" - "$1" "$2" <<'END'
import json, sqlite3, sys
s = sqlite3.connect(sys.argv[1])
exec(sys.argv[2])
s.commit()
END
}

# FOLDER COMMAND...: while another program holds the folder's lock.
while_locked() {
  "$PYTHON" - "$@" <<'END'
import fcntl, os, subprocess, sys
lock = os.open(sys.argv[1] + "/.clues-lock", os.O_RDWR | os.O_CREAT, 0o666)
fcntl.flock(lock, fcntl.LOCK_EX)
code = subprocess.call([os.environ["CLUES"] if word == "clues" else word for word in sys.argv[2:]])
sys.exit(code if code >= 0 else 128 - code)
END
}

cells() { clues map "$1" --cells $GRID -o "$2" >/dev/null 2>&1; }                                        # SCENE FOLDER
result() { clues map scene.off --cell $CELL -o "$1" >/dev/null; }                                       # FILE
judgement() { clues check scene.off --cell $CELL --pvs all.pvs --json > "$1"; return 0; }               # FILE
campaign() { clues fuzz --subject "$BLIND" --cases 1 --errors 1 --oracle sight-lines --out "$1"; }      # FOLDER
demo_meshes() {  # FOLDER: a tetrahedron for each animal
  mkdir "$1" && for animal in elephant cow bull; do
    printf 'OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n' > "$1/$animal.off"
  done
}
FOUND=sight-lines-hidden-visible-loose_triangles
suite() {  # FOLDER
  mkdir "$1" && cp "$SUITE/needles.json" "$1" && clues lint "$1" --write >/dev/null
}
answers() {  # FOLDER: a right result for the case of `conform`
  clues conform --export cases --suite "$SUITE" --case $CASE >/dev/null && mkdir "$1" &&
    clues map cases/$CASE.scene.off --cell cases/$CASE.cell.off -o "$1/$CASE.clues.json" >/dev/null
}
CASE=groove-seen-from-its-end
conform() { clues conform --results "$1" --suite "$SUITE" --case $CASE; }
# Runs what command.txt proposes, with a program that does nothing.
obey() { (clues() { :; } && . "$1/command.txt"); }
unchanged() { cmp -s "$1" "$2"; }
replays() { clues replay "$1" --subject "$BLIND" >/dev/null 2>&1; [ $? = 1 ]; }
