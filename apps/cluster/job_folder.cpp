#include "apps/cluster/job_folder.h"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/cluster/job_scripts.h"
#include "apps/console/exit_error.h"
#include "apps/session/files/output_files.h"
#include "core/files/input_file.h"
#include "render/settings/names.h"

namespace kaustik::app {

namespace fs = std::filesystem;

namespace {

constexpr uint64_t kLargestJob = 1 << 20;  // bytes

void write_script(const JobFolder& job, const std::string& name, const std::string& text) {
  const std::string path = job.path + "/" + name;
  write_text_file(path, text);
  fs::permissions(path, fs::perms::owner_exec | fs::perms::group_exec | fs::perms::others_exec,
                  fs::perm_options::add);
}

}  // namespace

render::PassSet JobFolder::passes_of(uint64_t task) const {
  return {task * passes / tasks, (task + 1) * passes / tasks};
}

std::string JobFolder::part(uint64_t task) const {
  return fmt::format("{}/parts/{}.kpart", path, task);
}

void make_job_folder(const std::string& path) {
  std::error_code error;
  if (fs::exists(path, error) && !fs::is_empty(path, error))
    refuse(fmt::format("{}: the folder exists and is not empty", path));
  fs::create_directories(path, error);
  if (error) refuse(fmt::format("cannot create the folder {}: {}", path, error.message()));
  check_writable(path + "/job.json");
}

void write_job(const JobFolder& job, const std::vector<std::string>& pictures) {
  fs::create_directories(job.path + "/parts");
  fs::create_directories(job.path + "/logs");
  const nlohmann::ordered_json json = {
      {"tasks", job.tasks}, {"passes", job.passes}, {"engine", kEngineNames[size_t(job.engine)]}};
  write_text_file(job.path + "/job.json", json.dump(1) + "\n");
  write_script(job, "task.sh", task_script(job));
  write_script(job, "merge.sh", merge_script(job, pictures));
  const bool slurm = job.engine == Engine::kSlurm;
  write_script(job, slurm ? "submit.sh" : "run.sh", slurm ? submit_script(job) : run_script(job));
}

JobFolder read_job_folder(const std::string& path) {
  try {
    const auto json = nlohmann::json::parse(read_file(path + "/job.json", kLargestJob));
    const auto count = [&](const char* name) {
      if (!json.at(name).is_number_unsigned()) throw std::runtime_error("a number is not a count");
      return json.at(name).get<uint64_t>();
    };
    JobFolder job{path, count("tasks"), count("passes")};
    const auto engine = render::from_name<Engine>(kEngineNames, json.at("engine").get<std::string>());
    if (!engine || job.tasks < 1 || job.tasks > job.passes || job.passes > render::kMostPasses)
      throw std::runtime_error("a value is out of range");
    job.engine = *engine;
    return job;
  } catch (const std::exception&) {
    refuse(fmt::format("{}: not a folder that `kaustik split` has written: it has no valid job.json", path));
  }
}

}  // namespace kaustik::app
