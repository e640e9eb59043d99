"""The two revisions under comparison: a worktree and a build each, side by side below build/perf-gate/."""
import os
import pathlib
import subprocess
import sys
import tempfile

# Names of equal length, so that paths have the same length on both sides.
BASE, HEAD = "base", "head"


def git(root, *arguments, env=None):
    result = subprocess.run(["git", "-C", str(root), *arguments], check=True, stdout=subprocess.PIPE, text=True,
                            env={**os.environ, **(env or {})})
    return result.stdout.strip()


def snapshot(root):
    """Returns the commit to judge: HEAD, or with local changes a commit of them on top of it, which is on no branch."""
    if not git(root, "status", "--porcelain"):
        return git(root, "rev-parse", "HEAD")
    with tempfile.TemporaryDirectory() as folder:
        env = {"GIT_INDEX_FILE": str(pathlib.Path(folder) / "index")}
        git(root, "read-tree", "HEAD", env=env)
        git(root, "add", "--all", env=env)
        tree = git(root, "write-tree", env=env)
    author = ["-c", "user.name=perf-gate", "-c", "user.email=perf-gate@localhost"]
    return git(root, *author, "commit-tree", tree, "-p", "HEAD", "-m", "working tree")


class Side:
    def __init__(self, root, name):
        self.name = name
        self.folder = root / "build" / "perf-gate" / name
        self.build_folder = self.folder / "build" / "release"
        self.root = root
        self.commit = None
        self.targets = {}  # name: whether it was built
        self.borrowed = False  # benchmarks/ is another commit's

    def check_out(self, commit):
        self.commit = commit
        if (self.folder / ".git").exists():
            git(self.folder, "checkout", "--quiet", "--force", "--detach", commit)
        else:
            git(self.root, "worktree", "prune")
            git(self.root, "worktree", "add", "--quiet", "--force", "--detach", str(self.folder), commit)
        git(self.folder, "clean", "--force", "-d", "--quiet")  # keeps ignored files, such as the build

    def take_driver(self, commit):
        """Replaces benchmarks/ by that of `commit`, so that both sides measure the same work."""
        git(self.folder, "restore", "--source", commit, "--worktree", "--", "benchmarks")
        self.borrowed = commit != self.commit

    def build(self, target):
        """Builds and returns the program; None if it does not build, and the log says why. Where the benchmarks/ of
        another commit do not compile, those of its own are built."""
        if target not in self.targets:
            print(f"perf-gate: building {target} of {self.name}, {self.commit[:10]}", file=sys.stderr)
            self.targets[target] = self._configure_and_build(target)
            if self.borrowed and not self.targets[target]:
                self.take_driver(self.commit)
                git(self.folder, "clean", "--force", "-d", "--quiet", "--", "benchmarks")
                self.targets[target] = self._configure_and_build(target)
        program = self.build_folder / ("kaustik" if target == "kaustik" else f"benchmarks/perf/{target}")
        return program if self.targets[target] and program.exists() else None

    def log(self, target):
        return self.folder.parent / "results" / f"build-{self.name}-{target}.log"

    def _configure_and_build(self, target):
        # Files that are equal on both sides are compiled once.
        env = {**os.environ, "CCACHE_BASEDIR": str(self.folder.parent), "CCACHE_NOHASHDIR": "1"}
        commands = [["cmake", "--preset", "release", "-DKAUSTIK_BUILD_TESTS=OFF"],
                    ["cmake", "--build", "--preset", "release", "--target", target]]
        with open(self.log(target), "w") as log:
            return all(subprocess.run(command, cwd=self.folder, env=env, stdout=log, stderr=log).returncode == 0
                       for command in commands)
