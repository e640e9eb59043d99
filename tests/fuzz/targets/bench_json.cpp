// Results of `kaustik bench`, which --from and --baseline read.

#include "apps/bench/bench_json.h"
#include "apps/bench/baseline.h"
#include "apps/bench/bench_table.h"
#include "tests/fuzz/input_folder.h"

namespace kaustik::fuzz {

void fuzz_bench_json(Bytes input) {
  app::BenchResult result;
  try {
    result = app::bench_from_json(std::string(as_text(input)));
  } catch (const std::runtime_error&) {
    return;
  }
  // What was read can be written, and is then the same.
  const std::string written = app::bench_json(result);
  if (app::bench_json(app::bench_from_json(written)) != written)
    throw Violation("a result changes when it is written and read");
  try {
    app::baseline_table(result, result);
  } catch (const std::runtime_error&) {  // no points
  }
  app::slow_down(result, result, 1.1);
}

}  // namespace kaustik::fuzz
