#include "apps/cluster/job_scripts.h"

#include <fmt/format.h>

#include <filesystem>

#include "apps/machine/instruction_set.h"

namespace kaustik::app {

namespace {

// The program that is running, so that tasks run the same build. KAUSTIK names another one.
std::string program() {
  std::error_code error;
  const auto path = std::filesystem::read_symlink("/proc/self/exe", error);
  const std::string isa = pinned_instruction_set();
  return fmt::format("kaustik=${{KAUSTIK:-{}}}\nisa=({})\n", quoted(error ? "kaustik" : path.string()),
                     isa.empty() ? "" : "--isa " + isa);
}

constexpr const char* kInFolder =
    "# Slurm runs a copy of this script, slurm_script, in the job's folder.\n"
    "[ \"${0##*/}\" = slurm_script ] || cd \"$(dirname \"$0\")\" || exit\n";

}  // namespace

std::string quoted(const std::string& text) {
  constexpr std::string_view kPlain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_./-";
  if (!text.empty() && text.find_first_not_of(kPlain) == text.npos) return text;
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::string task_script(const JobFolder& job) {
  return fmt::format(
             "#!/bin/bash\n"
             "# task.sh [TASK]: renders the passes of one task, 0 to {}; without TASK that of Slurm's array. "
             "A\n"
             "# task that was stopped goes on after its last checkpoint.\n"
             "task=${{1:-${{SLURM_ARRAY_TASK_ID:?task.sh needs the number of a task}}}}\n",
             job.tasks - 1) +
         kInFolder + program() +
         fmt::format(
             "first=$((task * {1} / {0})) end=$(((task + 1) * {1} / {0}))\n"
             "part=parts/$task.kpart\n"
             "if [ -e \"$part\" ]; then\n"
             "  work=(resume \"$part\")\n"
             "else\n"
             "  work=(resume start.kpart --pass-range \"$first:$end\" --checkpoint \"$part\")\n"
             "fi\n"
             "root=({2})\n"
             "threads=()\n"
             "[ -z \"${{SLURM_CPUS_PER_TASK:-}}\" ] || threads=(--threads \"$SLURM_CPUS_PER_TASK\")\n"
             "\"$kaustik\" \"${{work[@]}}\" --checkpoint-every \"${{CHECKPOINT_EVERY:-60s}}\" "
             "\"${{threads[@]}}\" \"${{isa[@]}}\" \"${{root[@]}}\" "
             "-q &\n"
             "child=$!\n"
             "stopped=\n"
             "trap 'stopped=1; kill -TERM \"$child\"' TERM INT\n"
             "wait \"$child\"\n"
             "code=$?\n"
             "while kill -0 \"$child\" 2>/dev/null; do # a signal ends `wait` early\n"
             "  wait \"$child\"\n"
             "  code=$?\n"
             "done\n"
             "# Slurm has announced the end of the job's time: its passes so far are kept, and the task runs "
             "again.\n"
             "if [ -n \"$stopped\" ] && [ -n \"${{SLURM_ARRAY_JOB_ID:-}}\" ]; then\n"
             "  scontrol requeue \"${{SLURM_ARRAY_JOB_ID}}_$task\"\n"
             "fi\n"
             "exit \"$code\"\n",
             job.tasks, job.passes, job.root.empty() ? "" : "--root " + quoted(job.root));
}

std::string merge_script(const JobFolder& job, const std::vector<std::string>& pictures) {
  std::string outputs;
  for (const std::string& picture : pictures) outputs += " -o " + quoted(picture);
  return "#!/bin/bash\n"
         "# merge.sh [OPTION...]: adds the parts of all tasks and writes the picture; options are those of\n"
         "# `kaustik merge`.\n" +
         std::string(kInFolder) + program() + "if [ $# -eq 0 ]; then set --" + outputs +
         fmt::format(
             "; fi\n"
             "parts=()\n"
             "for ((task = 0; task < {}; ++task)); do\n"
             "  [ ! -e \"parts/$task.kpart\" ] || parts+=(\"parts/$task.kpart\")\n"
             "done\n"
             "\"$kaustik\" merge \"${{parts[@]:-start.kpart}}\" \"${{isa[@]}}\" \"$@\" && exit\n"
             "code=$?\n"
             "\"$kaustik\" status .\n"
             "exit \"$code\"\n",
             job.tasks);
}

std::string submit_script(const JobFolder& job) {
  return fmt::format(
      "#!/bin/bash\n"
      "# submit.sh [OPTION...]: submits the tasks to Slurm as an array, and the merge after them. Options "
      "are those\n"
      "# of `sbatch` for the tasks, such as --cpus-per-task=16 --time=2:00:00 --mem=8G.\n"
      "# TASKS=3,7 submits some tasks again.\n"
      "cd \"$(dirname \"$0\")\" || exit\n"
      "array=$(sbatch --parsable --job-name=kaustik --array=\"${{TASKS:-0-{}}}\" --requeue "
      "--signal=B:TERM@120 \\\n"
      "  --open-mode=append --output=logs/%a.txt \"$@\" task.sh) || exit\n"
      "merge=$(sbatch --parsable --job-name=kaustik-merge --dependency=\"afterok:$array\" "
      "--kill-on-invalid-dep=yes \\\n"
      "  --output=logs/merge.txt merge.sh) || exit\n"
      "echo \"$array $merge\"\n",
      job.tasks - 1);
}

std::string run_script(const JobFolder& job) {
  return fmt::format(
      "#!/bin/bash\n"
      "# run.sh: runs the tasks one after the other, and the merge after them. The same with GNU parallel on "
      "several\n"
      "# machines that share this folder: parallel --sshlogin a,b --workdir . ./task.sh ::: {{0..{0}}} && "
      "./merge.sh\n"
      "cd \"$(dirname \"$0\")\" || exit\n"
      "for ((task = 0; task < {1}; ++task)); do ./task.sh \"$task\" || exit; done\n"
      "exec ./merge.sh \"$@\"\n",
      job.tasks - 1, job.tasks);
}

}  // namespace kaustik::app
