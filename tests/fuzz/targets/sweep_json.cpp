// What a sweep keeps in its folder: sweep-of.json, and a file for each cell.

#include "apps/console/exit_error.h"
#include "apps/sweep/sweep_files.h"
#include "apps/sweep/sweep_folder.h"
#include "tests/fuzz/input_folder.h"

namespace kaustik::fuzz {

namespace {

// The file of a sweep that the folder does not belong to is refused by an error that names a difference.
void open_folder(std::string_view text) {
  const auto folder = input_folder() / "sweep";
  std::filesystem::create_directories(folder);
  input_file("sweep/sweep-of.json", text);
  try {
    const app::SweepFolder opened(folder.string(), {{"scene", "a.pbrt"}, {"settings", {{"seed", "0"}}}});
  } catch (const app::ExitError&) {
  }
}

void read_cell(std::string_view text) {
  const auto folder = input_folder() / "cells";
  std::filesystem::remove(folder / "sweep-of.json");
  const app::SweepFolder opened(folder.string(), app::Json::object());
  for (const char* file : {"cells/cells/a.json", "cells/cells/a.png", "cells/cells/a-error.png"})
    input_file(file, text);
  std::ostringstream out, err;
  const auto cell = opened.find("a", app::Console(out, err));
  if (!cell && err.str().empty()) throw Violation("a cell was refused without a warning");
  if (cell) app::cell_json(*cell).dump();
}

}  // namespace

void fuzz_sweep_json(Bytes input) {
  open_folder(as_text(input));
  read_cell(as_text(input));
}

}  // namespace kaustik::fuzz
