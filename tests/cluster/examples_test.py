#!/usr/bin/env python3
"""The job files of docs/clusters.md: scripts are read by bash, YAML is read and says what a Job needs to say, and the
commands in both are such as `clues` takes. Usage: examples_test.py CLUES SOURCE; exit code 77 without python3-yaml."""
import pathlib
import re
import subprocess
import sys

try:
    import yaml
except ImportError:
    print("no python3-yaml")
    sys.exit(77)


def flaws_of_script(text, clues, what):
    ran = subprocess.run(["bash", "-n"], input=text, capture_output=True, text=True)
    if ran.returncode != 0:
        yield f"{what}: {ran.stderr}"
    commands = re.findall(r"clues (\w+)((?:\\\n|[^\n])*)", re.sub(r"(?m)^\s*#.*", "", text))
    if not commands:
        yield f"{what}: no clues in it"
    for name, words in commands:
        known = subprocess.run([clues, name, "--help"], capture_output=True, text=True).stdout
        for option in re.findall(r"(?<!\S)(--?\w[\w-]*)", words):
            if not re.search(rf"(?<![\w-]){option}(?![\w-])", known):
                yield f"{what}: clues {name} has no {option}"


def flaws_of_job(text, clues, what):
    try:
        job = yaml.safe_load(text)
        spec = job["spec"]
        pod = spec["template"]["spec"]
        container, = pod["containers"]
        script, = container["args"]
    except (yaml.YAMLError, KeyError, ValueError, TypeError) as error:
        yield f"{what}: {error!r}"
        return
    yield from flaws_of_script(script, clues, what)
    if (job["apiVersion"], job["kind"], spec["completionMode"]) != ("batch/v1", "Job", "Indexed"):
        yield f"{what}: no indexed Job"
    if pod["restartPolicy"] not in ("OnFailure", "Never"):
        yield f"{what}: a Job's pods are not restarted {pod['restartPolicy']}"
    shards = re.search(r"JOB_COMPLETION_INDEX \+ 1\)\)/(\d+)", script)
    if not shards or int(shards[1]) != spec["completions"]:
        yield f"{what}: as many shards as completions"
    if {m["name"] for m in container["volumeMounts"]} != {v["name"] for v in pod["volumes"]}:
        yield f"{what}: a volume that is not mounted, or is not there"


def flaws(name, text, clues):
    return list((flaws_of_job if name.endswith(".yaml") else flaws_of_script)(text, clues, name))


def main():
    clues, source = sys.argv[1], pathlib.Path(sys.argv[2])
    found, files = [], sorted((source / "docs/clusters").iterdir())
    for file in files:
        found += flaws(file.name, file.read_text(), clues)
    # What it must catch.
    script, job = (next(f.read_text() for f in files if f.suffix == suffix) for suffix in (".slurm", ".yaml"))
    for name, text in [("a.slurm", script.replace("set -euo pipefail", "if")), ("b.slurm", script.replace("--cells", "--sells")),
                       ("c.yaml", job.replace("completions: 20", "completions: 19")),
                       ("d.yaml", job.replace("spec:", "spec", 1)), ("e.yaml", job.replace("--shard", "--shart")),
                       ("f.yaml", job.replace("- name: campaign\n          persistent", "- name: other\n          persistent"))]:
        if not flaws(name, text, clues):
            found.append(f"{name}: planted, and not caught")
    print("\n".join(found) or f"{len(files)} files, 6 planted flaws")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
