#pragma once
// The subcommands: each function returns a command with its options and with what to run after parsing.

#include "apps/command_line/command.h"

namespace kaustik::app {

Command make_render_command();
Command make_view_command();
Command make_shoot_command();
Command make_resume_command();
Command make_merge_command();
Command make_split_command();
Command make_status_command();
Command make_photons_command();
Command make_compare_command();
Command make_denoise_command();
Command make_info_command();
Command make_convert_command();
Command make_bench_command();
Command make_sweep_command();
Command make_reference_command(const Program& program);  // which must outlive the command

}  // namespace kaustik::app
