#include "apps/web/open_browser.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace kaustik::app {

bool open_browser(const std::string& url) {
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  for (const int file : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&files, file, "/dev/null", O_RDWR, 0);
  // A shell in between ends at once, so that no child is left that nobody waits for.
  const std::string command = "command -v xdg-open >/dev/null && { xdg-open \"$1\" & }";
  std::string shell = "sh", option = "-c", text = command, name = "kaustik", argument = url;
  char* const arguments[] = {shell.data(), option.data(), text.data(), name.data(), argument.data(), nullptr};
  pid_t process = 0;
  const bool started = posix_spawnp(&process, "sh", &files, nullptr, arguments, environ) == 0;
  posix_spawn_file_actions_destroy(&files);
  int status = 0;
  return started && waitpid(process, &status, 0) == process && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace kaustik::app
