#include <iostream>

#include "apps/run.h"

int main(int argc, char** argv) {
  return kaustik::app::run(argc, argv, std::cout, std::cerr);
}
