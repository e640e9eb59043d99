#!/usr/bin/env python3
"""Reads off built files that they are hardened (cmake/KaustikHardening.cmake), with readelf of binutils.

  hardening_test.py [--not-fortified] FILE...   a program, or modules that it loads; --not-fortified: of a build without optimisation

Every file must be position-independent, with full RELRO, without an executable stack, without relocations of code, and without a
segment that can be both written and executed. At least one of them, since small modules have no buffers, must have canaries and
call fortified functions (a compiler takes the plain form where it does not know the size of the buffer).
"""
import argparse
import re
import subprocess
import sys


def readelf(option, file):
    return subprocess.run(["readelf", "--wide", option, file], check=True, capture_output=True, text=True).stdout


def is_pie(dynamic, segments):
    """Modules are position-independent by themselves; a program, which names its loader, has a flag."""
    return "DYN (" in segments and ("INTERP" not in segments or re.search(r"\(FLAGS_1\).*\bPIE\b", dynamic))


def mistakes(file):
    dynamic, segments = readelf("--dynamic", file), readelf("--program-headers", file)
    if not is_pie(dynamic, segments):
        yield "is not position-independent"
    if "GNU_RELRO" not in segments:
        yield "has no RELRO"
    if not re.search(r"BIND_NOW|FLAGS_1.*\bNOW\b", dynamic):
        yield "has no BIND_NOW, so its RELRO is partial"
    if "TEXTREL" in dynamic:
        yield "has relocations of code"
    stack = re.search(r"^\s+GNU_STACK\s.*\s(R[W ][E ])\s", segments, re.M)
    if not stack or "E" in stack[1]:
        yield "has an executable stack"
    if re.search(r"^\s+LOAD\s.*\sRWE\s", segments, re.M):
        yield "has memory that can be written and executed"


def imported(file):
    return set(re.findall(r"\bUND\s+(\w+)", readelf("--dyn-syms", file)))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--not-fortified", action="store_true")
    parser.add_argument("files", nargs="+", metavar="FILE")
    arguments = parser.parse_args()
    found = [f"{file}: {mistake}" for file in arguments.files for mistake in mistakes(file)]
    names = set().union(*(imported(file) for file in arguments.files))
    if "__stack_chk_fail" not in names:
        found.append("no file has stack canaries")
    if not arguments.not_fortified and not any(re.fullmatch(r"__\w+_chk", name) for name in names):
        found.append("no file calls a fortified function (__*_chk)")
    print("\n".join(found) if found else f"hardening: {len(arguments.files)} files are hardened")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
