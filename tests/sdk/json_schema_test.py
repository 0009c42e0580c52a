#!/usr/bin/env python3
"""The JSON Schemas agree with the tables of cases in tests/fixtures, which the parsers' tests go by, too; all shipped
manifests and plugin sets satisfy them: json_schema_test.py SOURCE_FOLDER"""

import json
import pathlib
import re
import sys

import jsonschema

TREE = pathlib.Path(sys.argv[1])
problems = []


def schema(name):
    content = json.loads((TREE / "sdk/share" / name).read_text())
    jsonschema.Draft202012Validator.check_schema(content)
    return jsonschema.Draft202012Validator(content)


def manifest_of(table, case):
    manifest = {**table["base"], **case.get("with", {})}
    for field in case.get("without", []):
        del manifest[field]
    return manifest


def set_of(_, case):
    return case["set"]


def check(schema_name, table_name, content_of, shipped, at_least):
    validator = schema(schema_name)
    table = json.loads((TREE / "tests/fixtures" / table_name).read_text())
    for case in table["cases"]:
        valid = validator.is_valid(content_of(table, case))
        if valid != (case["verdict"] == "good"):
            verb = "accepts" if valid else "refuses"
            problems.append(f"{schema_name} {verb} {case['name']} of {table_name}, which is {case['verdict']}")
    if len(shipped) < at_least:
        problems.append(f"only {len(shipped)} shipped files for {schema_name} found")
    for file in shipped:
        content = json.loads(re.sub(r"^\s*//.*$", "", file.read_text(), flags=re.M))
        for error in validator.iter_errors(content):
            problems.append(f"{file.relative_to(TREE)}: {error.json_path}: {error.message}")
    print(f"{schema_name}: {len(table['cases'])} cases, {len(shipped)} shipped files")


def files(pattern):
    found = [file for folder in ("plugins", "examples") for file in sorted((TREE / folder).rglob(pattern))]
    return [file for file in found if "build" not in file.relative_to(TREE).parts]


check("plugin.schema.json", "manifests.json", manifest_of, files("plugin.json"), 10)
check("jetset.schema.json", "sets.json", set_of, files("*.jetset"), 4)
print("\n".join(problems) or "all agree")
sys.exit(1 if problems else 0)
