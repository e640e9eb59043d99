"""Counts the instructions of the kernels by callgrind: every run of a program gives the same number, whatever else the
machine does.

valgrind's processor is the same everywhere: AVX2 and nothing newer, for Embree, Highway and the C library alike."""
import concurrent.futures
import os
import re
import subprocess

from table import FAIL, NOT_COMPARABLE, OK, Row, percent

CHECK = "instructions"
LIMIT = 1.01  # highest ratio of head to base


def kernel_names(program):
    listed = subprocess.run([program, "--benchmark_list_tests"], check=True, stdout=subprocess.PIPE, text=True)
    return listed.stdout.split()


def total_of(profile):
    """Returns the total in the text of a callgrind.out file."""
    return int(re.search(r"^totals: (\d+)$", profile, re.MULTILINE).group(1))


def count(program, kernel, output):
    subprocess.run(["valgrind", "--tool=callgrind", "--toggle-collect=counted_work", f"--callgrind-out-file={output}",
                    program, "--once", kernel], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return total_of(output.read_text())


def judge(kernel, base, head):
    verdict = FAIL if head > base * LIMIT else OK
    return Row(CHECK, kernel, f"{base:,}", f"{head:,}", f"{percent(head / base)} (limit {percent(LIMIT)})", verdict)


def check(base, head, results):
    program = head.build("perf_kernels")
    kernels = kernel_names(program)
    base_program = base.build("perf_kernels")
    if not base_program:
        return [Row(CHECK, "all kernels", f"no build: {base.log('perf_kernels')}", "", "", NOT_COMPARABLE)]
    both = set(kernel_names(base_program))
    kernels = [kernel for kernel in kernels if kernel in both]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        counts = {(side.name, kernel): pool.submit(count, binary, kernel, results / f"callgrind.{side.name}.{kernel}")
                  for side, binary in ((base, base_program), (head, program)) for kernel in kernels}
    return [judge(kernel, counts[base.name, kernel].result(), counts[head.name, kernel].result())
            for kernel in kernels]
