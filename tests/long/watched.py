"""Processes that live as long as a soak: their memory and descriptors are sampled, and their pages read as a browser does."""
import json
import pathlib
import re
import statistics
import subprocess
import threading
import time
import urllib.error
import urllib.request

# Memory may rise by a tenth and 24 MiB between the second quarter of a run and the last: allocators keep what threads have freed.
kMemoryFactor, kMemoryMore = 1.1, 24 << 20
kDescriptorsMore = 4  # connections that are just being closed


def resident_bytes(pid):
    return int(re.search(r"^VmRSS:\s+(\d+) kB", pathlib.Path(f"/proc/{pid}/status").read_text(), re.M)[1]) * 1024


def descriptors(pid):
    return len(list(pathlib.Path(f"/proc/{pid}/fd").iterdir()))


def quarter(values, number):
    length = len(values)
    return values[length * number // 4:length * (number + 1) // 4]


class Watched:
    """A process that serves a page, the first line of whose output is the page's address."""

    def __init__(self, name, command, log):
        self.name, self.samples, self.requests = name, [], 0
        self.log = open(log, "w")
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=self.log, text=True)
        self.address = self.process.stdout.readline().strip()

    def fetch(self, path, data=None):
        self.requests += 1
        with urllib.request.urlopen(self.address + path, data=data, timeout=120) as answer:
            return answer.read()

    def status(self):
        """The newest event: one line of data."""
        with urllib.request.urlopen(self.address + "events", timeout=120) as events:
            for line in events:
                if line.startswith(b"data:"):
                    return json.loads(line[5:])
        raise OSError("the events have ended")

    def sample(self):
        if self.process.poll() is None:
            self.samples.append((resident_bytes(self.process.pid), descriptors(self.process.pid)))

    def growth(self):
        """What is wrong with memory and descriptors, as text, where there are enough samples to tell."""
        if len(self.samples) < 16:
            return
        memory, files = ([sample[i] for sample in self.samples] for i in (0, 1))
        before, after = statistics.median(quarter(memory, 1)), statistics.median(quarter(memory, 3))
        if after > before * kMemoryFactor + kMemoryMore:
            yield f"{self.name}: memory has grown from {before / 2**20:.0f} to {after / 2**20:.0f} MiB"
        before, after = statistics.median(quarter(files, 1)), statistics.median(quarter(files, 3))
        if after > before + kDescriptorsMore:
            yield f"{self.name}: descriptors have grown from {before:.0f} to {after:.0f}"

    def summary(self):
        if not self.samples:
            return f"{self.name}: no samples"
        memory, files = zip(*self.samples)
        quarters = ", ".join(f"{statistics.median(quarter(memory, i) or memory) / 2**20:.0f}" for i in range(4))
        return (f"{self.name}: {self.requests} requests, {len(self.samples)} samples; memory in the quarters of the time {quarters} MiB, "
                f"{max(memory) / 2**20:.0f} at most; descriptors {files[0]} at first, {max(files)} at most, {files[-1]} at last")

    def end(self):
        """Asks the process to end; returns its exit code, or None if it had to be killed."""
        self.process.terminate()
        try:
            return self.process.wait(60)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
            return None
        finally:
            self.process.stdout.close()
            self.log.close()


class Reader(threading.Thread):
    """Fetches the pixels that change of a render's page, as a browser does, and drops the connection now and then."""

    def __init__(self, watched, stop):
        super().__init__(daemon=True)
        self.watched, self.stop, self.trouble = watched, stop, None

    def run(self):
        version = 0
        try:
            while not self.stop.is_set():
                pixels = self.watched.fetch(f"pixels?layer=&since={version}")
                version = int.from_bytes(pixels[:8], "little")
                self.watched.status()
                time.sleep(0.1)
        except (OSError, ValueError, urllib.error.URLError) as error:
            if not self.stop.is_set():
                self.trouble = f"{self.watched.name}: {error}"
