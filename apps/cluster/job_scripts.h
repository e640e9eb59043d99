#pragma once
// The shell scripts in the folder of a job.

#include <string>
#include <vector>

#include "apps/cluster/job_folder.h"

namespace kaustik::app {

std::string task_script(const JobFolder& job);
std::string merge_script(const JobFolder& job, const std::vector<std::string>& pictures);
std::string submit_script(const JobFolder& job);
std::string run_script(const JobFolder& job);

// A word of a shell command that means exactly this text.
std::string quoted(const std::string& text);

}  // namespace kaustik::app
