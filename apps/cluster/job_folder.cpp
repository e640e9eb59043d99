#include "apps/cluster/job_folder.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "apps/cluster/job_scripts.h"
#include "apps/console/exit_error.h"
#include "apps/session/files/output_files.h"
#include "render/settings/names.h"

namespace kaustik::app {

namespace fs = std::filesystem;

namespace {

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

void write_job_folder(const JobFolder& job, const std::vector<std::string>& pictures) {
  std::error_code error;
  if (fs::exists(job.path, error) && !fs::is_empty(job.path, error))
    refuse(fmt::format("{}: the folder exists and is not empty", job.path));
  for (const char* folder : {"", "/parts", "/logs"}) {
    fs::create_directories(job.path + folder, error);
    if (error) refuse(fmt::format("cannot create the folder {}{}: {}", job.path, folder, error.message()));
  }
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
    std::ifstream file(path + "/job.json");
    const auto json = nlohmann::json::parse(file);
    JobFolder job{path, json.at("tasks").get<uint64_t>(), json.at("passes").get<uint64_t>()};
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
