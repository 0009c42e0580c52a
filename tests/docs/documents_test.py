#!/usr/bin/env python3
"""The documents say what the program does: documents_test.py CASE SOURCE_DIR BUILD_DIR

An example in a document is a fenced block whose first line ends in file=NAME (%20 for a space)."""

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import urllib.parse

SOURCE, BUILD = pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
JET = BUILD / "bin" / "jet"


def check(condition, message):
    if not condition:
        sys.exit(f"FAILED: {message}")


def jet(*arguments, code=0):
    run = subprocess.run([JET, *map(str, arguments)], capture_output=True, text=True)
    check(run.returncode == code, f"jet {' '.join(map(str, arguments))}: exit code {run.returncode}\n{run.stdout}{run.stderr}")
    return run


def read(path):
    return (SOURCE / path).read_text(encoding="utf-8")


def extract(document, folder):
    """Writes the document's examples into the folder."""
    found = re.findall(r"^```\w+ file=(\S+)\n(.*?)^```$", read(document), re.M | re.S)
    check(found, f"{document} has no examples")
    for name, content in found:
        target = folder / urllib.parse.unquote(name)
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(content, encoding="utf-8")


def file_format(scratch):
    """The example projects load and play; written anew they have the same bytes."""
    extract("docs/file-format.md", scratch)
    small = jet("project", "check", scratch / "small")
    check("1 scenes, 6 items, 0 warnings" in small.stdout, f"the small project has remarks: {small.stdout}{small.stderr}")
    check("landed" in jet("play", scratch / "small", "--steps", 240).stdout, "the jelly of the small project does not land")
    foreign = json.loads(jet("project", "check", scratch / "foreign", "--json").stdout)
    check(len(foreign["notes"]) == 2, f"the foreign project should have two remarks: {foreign}")
    for name in ("small", "foreign"):
        jet("convert", scratch / name, scratch / "again" / name)
        scene = pathlib.Path("scenes/Scene 0.scene")
        before, after = ((scratch / part / name / scene).read_text() for part in ("", "again"))
        check(before == after, f"the scene of {name} is not written as the document shows it:\n{after}")
    project = (scratch / "again/foreign/project.jet").read_text()
    check(project == (scratch / "foreign/project.jet").read_text(), f"the record of missing plugins changed:\n{project}")


def schemas(scratch):
    """The schemas of sdk/share accept the examples and what the documents show, and refuse what JET refuses."""
    if not shutil.which("xmllint"):
        print("xmllint is not installed: the schemas are not tried")
        return
    extract("docs/file-format.md", scratch)

    def valid(kind, file):
        return subprocess.run(["xmllint", "--noout", "--relaxng", SOURCE / f"sdk/share/{kind}.rng", file], capture_output=True).returncode == 0

    for folder in (scratch, SOURCE / "examples"):
        files = [f for f in folder.rglob("*") if f.suffix in (".jet", ".scene")]
        check(files, f"there are no projects in {folder}")
        for file in files:
            check(valid("project" if file.suffix == ".jet" else "scene", file), f"the schema does not accept {file}")
    scene = (scratch / "small/scenes/Scene 0.scene").read_text()
    for old, new in (('id="1"', 'id="0"'), ('version="1"', 'version="2"'), ("<settings>", "<setings>"), ('locked="true"', 'locked="yes"'),
                     ('collides="true"', 'collides="maybe"'), ('name="Ground"', 'nam="Ground"')):
        check(old in scene, f"the example of the document has no {old} any more")
        wrong = scratch / "wrong.scene"
        wrong.write_text(scene.replace(old, new, 1).replace("</settings>", "</setings>") if "<set" in old else scene.replace(old, new, 1))
        check(not valid("scene", wrong), f"the schema accepts {new}")


def properties(_):
    """docs/file-format.md names every property of scenes, item types and effects, and every item type and effect."""
    document = read("docs/file-format.md")
    sources = [SOURCE / "sdk/src/scene.cpp", SOURCE / "sdk/src/item_types.cpp"]
    sources += (SOURCE / "plugins/effects").glob("*/*.cpp")
    declared = re.compile(r'\b(?:flag|integer|real|vector|color|text|choice)\(\s*"([a-z-]+)",')
    missing = {f"{file.name}: {name}" for file in sources for name in declared.findall(file.read_text(encoding="utf-8"))
               if f"`{name}`" not in document}
    for effect in (SOURCE / "plugins/effects").glob("*/plugin.json"):
        for entry in json.loads(effect.read_text())["contributes"]["effects"]:
            if f"`{entry['id']}`" not in document:
                missing.add(f"effect {entry['id']}")
    for kind in re.findall(r'Item \{ static constexpr std::string_view type = "(\w+)"', read("sdk/include/jet/item.hpp")):
        if f"`{kind}`" not in document:
            missing.add(f"item type {kind}")
    check(not missing, f"docs/file-format.md does not describe {sorted(missing)}")


def command_line(_):
    """docs/command-line.md names every command and every option, and no option that is not there."""
    document = read("docs/command-line.md")
    told = set()

    def visit(command):
        text = jet(*command, "--help").stdout
        told.update(re.findall(r"--[a-z][a-z-]+", text))
        _, _, commands = text.partition("Subcommands:")
        for name in re.findall(r"^  ([a-z]+)", commands, re.M):
            check(f"jet {' '.join([*command, name])}" in document, f"docs/command-line.md does not tell of 'jet {' '.join(command)} {name}'")
            visit([*command, name])

    visit([])
    written = set(re.findall(r"--[a-z][a-z-]+", document))
    check(told <= written, f"docs/command-line.md does not tell of {sorted(told - written)}")
    check(written <= told, f"docs/command-line.md tells of {sorted(written - told)}, which jet does not know")


def links(_):
    """Relative links of all documents lead to files that are there."""
    broken = []
    for document in [*SOURCE.glob("*.md"), *SOURCE.glob("docs/**/*.md")]:
        text = re.sub(r"^```.*?^```$", "", document.read_text(encoding="utf-8"), flags=re.M | re.S)
        for target in re.findall(r"\]\(([^)#\s]+)[^)]*\)", text):
            if "://" not in target and not (document.parent / urllib.parse.unquote(target)).exists():
                broken.append(f"{document.relative_to(SOURCE)}: {target}")
    check(not broken, f"links that lead nowhere: {broken}")


def proofs(_):
    """Each test that the page on what proves the physics engine names is a test of the tree."""
    page = "docs/physics-validation.md"
    macro = re.compile(r"^TEST(?:_F|_P)?\((\w+),\s*(\w+)\)", re.M)
    there = {".".join(found) for file in SOURCE.glob("tests/**/*.cpp") for found in macro.findall(file.read_text(encoding="utf-8"))}
    named = re.findall(r"`(\w+\.[A-Z]\w+)`", read(page))
    check(len(named) > 50, f"{page} names only {len(named)} tests")
    gone = sorted(set(named) - there)
    check(not gone, f"{page} names tests that are not there: {gone}")


def hello_tool(scratch):
    """The first chapter of the guide shows the example's files. scripts/check-examples builds all chapters."""
    extract("docs/guide/1-hello-tool.md", scratch)
    example = SOURCE / "examples/plugins/hello-tool"
    for shown in (scratch / "hello-tool").iterdir():
        file = example / shown.name
        check(file.exists() and shown.read_text() == file.read_text(), f"the guide shows another {file.name} than {example}")


scratch_folder = pathlib.Path(tempfile.mkdtemp())
os.environ.update(XDG_CONFIG_HOME=str(scratch_folder / "config"), XDG_DATA_HOME=str(scratch_folder / "data"),
                  XDG_STATE_HOME=str(scratch_folder / "state"))
try:
    globals()[sys.argv[1]](scratch_folder)
finally:
    shutil.rmtree(scratch_folder)
