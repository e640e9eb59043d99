#include <csignal>
#include <iostream>

#include "apps/run.h"

int main(int argc, char** argv) {
  // A file that grows beyond the limit of the shell (ulimit -f) is then an error like a full disk.
  std::signal(SIGXFSZ, SIG_IGN);
  return kaustik::app::run(argc, argv, std::cout, std::cerr);
}
