#pragma once
// Work and span of parallel code, measured in one thread: how far it can scale, whatever the machine has.
//
// The work is all time, the span the longest chain of what must happen one after another: stretches outside
// of parallel loops, and in each loop its longest task. On p cores a greedy scheduler needs at most
// (work - span) / p + span (Brent 1974; Blumofe and Leiserson 1999). Memory bandwidth and clocks that fall
// when all cores work are not in it. Times are processor times, which other programs change little.

#include <cstdint>
#include <map>
#include <source_location>
#include <string>
#include <utility>
#include <vector>

#include "core/stopwatch.h"
#include "core/thread_time.h"

namespace kaustik {

// What takes time at one place of the sources, in a phase.
struct SpanPlace {
  double serial = 0;   // seconds in one thread before the loops there begin
  double work = 0;     // seconds in their tasks
  double span = 0;     // sum of the longest task of each loop; serial parts of loops included
  uint64_t tasks = 0;  // that could run at the same time, of all loops
};

struct PhaseSpan {
  double seconds = 0;                       // the work
  std::map<std::string, SpanPlace> places;  // by "folder/file.cpp:line"

  double serial() const;
  double span() const;
  // The least speed-up that a greedy scheduler reaches on so many cores.
  double speed_up(double cores) const;
};

// Records what the calling thread does in parallel loops (core/parallel/parallel.h) and phases, as long as it
// lives. The thread must be the only one that works: within an arena of one thread. Not nested.
class WorkSpanRecorder {
 public:
  using Clock = double (*)();  // seconds
  explicit WorkSpanRecorder(Clock clock = thread_seconds);
  ~WorkSpanRecorder();
  WorkSpanRecorder(const WorkSpanRecorder&) = delete;
  WorkSpanRecorder& operator=(const WorkSpanRecorder&) = delete;

  // The recorder of the calling thread; null in all others and where nothing is measured.
  static WorkSpanRecorder* present();

  // A parallel loop. Loops in its tasks count for the tasks' own spans.
  void begin_loop(const std::source_location& place);
  void end_loop();
  // A task of the innermost loop, or, with `in_order`, a part of it that only one thread can do at a time.
  void begin_task();
  void end_task(bool in_order = false);
  // The span of a loop's only task is known to be this share of its time.
  void set_span_share(double share);

  // Phases do not nest; a phase that is begun twice goes on.
  void begin_phase();
  void end_phase(const std::string& name, const std::source_location& place);
  const std::map<std::string, PhaseSpan>& phases() const { return phases_; }

 private:
  // A loop, or the phase as a loop of one task.
  struct Frame {
    std::source_location place;
    double task_began = 0;
    double inner_seconds = 0, inner_span = 0;  // of loops in the present task
    double work = 0, longest = 0, in_order = 0, share = 1;
    uint64_t tasks = 0;
  };

  const Clock clock_;
  std::vector<Frame> frames_;
  double serial_since_ = 0;                       // outside of all loops
  std::map<std::string, SpanPlace> since_begin_;  // of the present phase
  double phase_began_ = 0;
  std::map<std::string, PhaseSpan> phases_;
};

// Measures a phase's time, and tells the recorder of it, if there is one.
class PhaseWatch {
 public:
  PhaseWatch() {
    if (auto* recorder = WorkSpanRecorder::present()) recorder->begin_phase();
  }
  // Ends the phase of this name; returns its seconds.
  double end(const char* phase, const std::source_location& place = std::source_location::current()) const {
    if (auto* recorder = WorkSpanRecorder::present()) recorder->end_phase(phase, place);
    return watch_.seconds();
  }

 private:
  Stopwatch watch_;
};

}  // namespace kaustik
