#!/usr/bin/env python3
"""Tests scripts/sbom: sbom_test.py BUILD-FOLDER FOLDER, with a folder to write to. What it writes must have the form that the
specification of CycloneDX 1.5 asks for, name what the program is made of, and be the same when it is written again."""
import json
import os
import pathlib
import re
import subprocess
import sys

kRoot = pathlib.Path(__file__).resolve().parent.parent.parent
kTypes = {"application", "framework", "library", "container", "platform", "operating-system", "device", "device-driver",
          "firmware", "file", "machine-learning-model", "data"}
kMembers = {"bomFormat", "specVersion", "serialNumber", "version", "metadata", "components", "services", "externalReferences",
            "dependencies", "compositions", "vulnerabilities", "annotations", "formulation", "properties", "signature"}
kComponentMembers = {"type", "mime-type", "bom-ref", "supplier", "author", "publisher", "group", "name", "version",
                     "description", "scope", "hashes", "licenses", "copyright", "cpe", "purl", "swid", "pedigree",
                     "externalReferences", "components", "evidence", "releaseNotes", "modelCard", "data", "properties"}
# What the sources include or link (cmake/KaustikDependencies.cmake), by the start of the package's name.
kExpected = {"linked": ["libembree", "libtbb", "libfmt", "libhwy", "libdraco", "libmeshoptimizer", "libopenimageio", "libopenexr",
                        "zlib1g", "libstdc++6", "libc6"],
             "headers compiled in": ["libglm-dev", "libcli11-dev", "nlohmann-json3-dev"]}


def write(build, file):
    # With the thread sanitizer, tests run with libraries that belong to no package.
    environment = {name: value for name, value in os.environ.items() if name != "LD_LIBRARY_PATH"}
    done = subprocess.run([kRoot / "scripts" / "sbom", "--build", build, "-o", file], capture_output=True, text=True, env=environment)
    if done.returncode == 77:
        print(done.stderr)
        sys.exit(77)
    assert done.returncode == 0, done.stderr
    return file.read_text()


def components_of(bill):
    queue = [bill["metadata"]["component"], *bill["components"]]
    for component in queue:
        yield component
        queue.extend(component.get("components", []))


def check_component(component):
    assert set(component) <= kComponentMembers, component
    assert component["type"] in kTypes and component["name"], component
    for choice in component.get("licenses", []):
        licence = choice["license"]
        assert list(choice) == ["license"] and len({"id", "name"} & set(licence)) == 1, component
    for entry in component.get("properties", []):
        assert set(entry) == {"name", "value"} and all(isinstance(text, str) for text in entry.values()), component
    if "purl" in component:
        assert re.fullmatch(r"pkg:[a-z]+(/[a-z]+)?/[\w.%-]+@[\w.%-]+(\?[\w.=&-]+)?", component["purl"]), component


def check_form(bill):
    assert set(bill) <= kMembers and bill["bomFormat"] == "CycloneDX" and bill["specVersion"] == "1.5", list(bill)
    assert re.fullmatch(r"urn:uuid:[0-9a-f]{8}(-[0-9a-f]{4}){3}-[0-9a-f]{12}", bill["serialNumber"]), bill["serialNumber"]
    assert isinstance(bill["version"], int) and bill["version"] >= 1, bill["version"]
    assert re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ", bill["metadata"]["timestamp"]), bill["metadata"]["timestamp"]
    references = [component["bom-ref"] for component in components_of(bill)]
    assert len(set(references)) == len(references), "a reference is used twice"
    for component in components_of(bill):
        check_component(component)
    depending = [entry["ref"] for entry in bill["dependencies"]]
    assert len(set(depending)) == len(depending), "a component's dependencies are given twice"
    for entry in bill["dependencies"]:
        assert {entry["ref"], *entry["dependsOn"]} <= set(references), entry


def check_contents(bill):
    uses = {component["name"]: component["properties"][0]["value"] for component in bill["components"]}
    for use, starts in kExpected.items():
        for start in starts:
            assert any(name.startswith(start) and uses[name] == use for name in uses), f"{start} is not {use}: {uses}"
    assert any("http" in name for name in uses), uses
    assert [name for name, use in uses.items() if use == "embedded"] in (["libjs-chart.js"], ["chart.js"]), uses
    own = bill["metadata"]["component"]
    assert re.search(rf"VERSION {re.escape(own['version'])} ", (kRoot / "CMakeLists.txt").read_text()), own
    assert {"kaustik", "kaustik-images.so", "kaustik-http.so"} <= {file["name"] for file in own["components"]}, own


def main():
    build, folder = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    os.environ["SOURCE_DATE_EPOCH"] = "1700000000"  # a source archive has no commit whose time it could take
    text = write(build, folder / "kaustik.cdx.json")
    bill = json.loads(text)
    check_form(bill)
    check_contents(bill)
    assert bill["metadata"]["timestamp"] == "2023-11-14T22:13:20Z", bill["metadata"]
    assert write(build, folder / "again.cdx.json") == text, "it changes from run to run"


main()
