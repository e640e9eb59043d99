#include "core/parallel/work_span.h"

#include <algorithm>
#include <string_view>

namespace kaustik {

namespace {

thread_local WorkSpanRecorder* recorder_of_thread = nullptr;

// "folder/file.cpp:line", from the folder of the layer on.
std::string name_of(const std::source_location& place) {
  std::string_view file = place.file_name();
  for (const std::string_view layer : {"/core/", "/accel/", "/photon/", "/render/", "/images/", "/apps/"})
    if (const size_t at = file.rfind(layer); at != file.npos) {
      file.remove_prefix(at + 1);
      break;
    }
  return std::string(file) + ":" + std::to_string(place.line());
}

}  // namespace

double PhaseSpan::serial() const {
  double sum = 0;
  for (const auto& [name, place] : places) sum += place.serial;
  return sum;
}

double PhaseSpan::span() const {
  double sum = 0;
  for (const auto& [name, place] : places) sum += place.serial + place.span;
  return std::min(sum, seconds);
}

double PhaseSpan::speed_up(double cores) const {
  return seconds > 0 ? seconds / ((seconds - span()) / cores + span()) : 1;
}

WorkSpanRecorder::WorkSpanRecorder(Clock clock) : clock_(clock) {
  recorder_of_thread = this;
}

WorkSpanRecorder::~WorkSpanRecorder() {
  recorder_of_thread = nullptr;
}

WorkSpanRecorder* WorkSpanRecorder::present() {
  return recorder_of_thread;
}

void WorkSpanRecorder::begin_loop(const std::source_location& place) {
  if (frames_.empty()) since_begin_[name_of(place)].serial += clock_() - serial_since_;
  frames_.push_back({place, clock_()});
}

void WorkSpanRecorder::end_loop() {
  const Frame loop = frames_.back();
  frames_.pop_back();
  const double span = loop.share * loop.longest + loop.in_order;
  if (frames_.empty()) {
    SpanPlace& place = since_begin_[name_of(loop.place)];
    place.work += loop.work, place.span += span, place.tasks += loop.tasks;
    serial_since_ = clock_();
  } else {
    frames_.back().inner_seconds += loop.work, frames_.back().inner_span += span;
  }
}

void WorkSpanRecorder::begin_task() {
  Frame& loop = frames_.back();
  loop.inner_seconds = loop.inner_span = 0;
  loop.task_began = clock_();
}

void WorkSpanRecorder::end_task(bool in_order) {
  Frame& loop = frames_.back();
  const double seconds = clock_() - loop.task_began;
  const double span = std::max(seconds - loop.inner_seconds, 0.0) + loop.inner_span;
  loop.work += seconds;
  if (in_order) {
    loop.in_order += span;
  } else {
    loop.longest = std::max(loop.longest, span);
    ++loop.tasks;
  }
}

void WorkSpanRecorder::set_span_share(double share) {
  frames_.back().share = share;
}

void WorkSpanRecorder::begin_phase() {
  since_begin_.clear();
  phase_began_ = serial_since_ = clock_();
}

void WorkSpanRecorder::end_phase(const std::string& name, const std::source_location& place) {
  since_begin_[name_of(place)].serial += clock_() - serial_since_;
  PhaseSpan& phase = phases_[name];
  phase.seconds += clock_() - phase_began_;
  for (const auto& [where, of] : since_begin_) {
    SpanPlace& sum = phase.places[where];
    sum.serial += of.serial, sum.work += of.work, sum.span += of.span, sum.tasks += of.tasks;
  }
  since_begin_.clear();
  phase_began_ = serial_since_ = clock_();
}

}  // namespace kaustik
