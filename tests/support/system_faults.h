#pragma once
// Makes system calls of core/files fail.

#include <array>
#include <atomic>

#include "core/files/system_calls.h"

namespace kaustik::test {

// Only one may exist at a time. Calls are counted from 1, from the construction on.
class SystemFaults {
 public:
  SystemFaults() {
    state() = {};
    calls() = 0;
    set_system_fault(&ask);
  }
  ~SystemFaults() { stop(); }
  SystemFaults(const SystemFaults&) = delete;
  SystemFaults& operator=(const SystemFaults&) = delete;

  // The n-th call of this kind fails with this value of errno.
  void fail(SystemCall call, int n, int error) { state().of_kind[size_t(call)] = {n, error}; }
  // The n-th call of any kind fails.
  void fail_call(int n, int error) { state().of_any = {n, error}; }
  // Whether the call of fail_call() has been made.
  bool happened() const { return calls() >= state().of_any.n && state().of_any.n > 0; }
  void stop() { set_system_fault(nullptr); }

 private:
  struct Fault {
    int n = 0, error = 0;
  };
  static constexpr size_t kKinds = size_t(SystemCall::kMap) + 1;
  struct State {
    std::array<Fault, kKinds> of_kind{};
    Fault of_any{};
    std::array<int, kKinds> made{};
  };
  static State& state() {
    static State state;
    return state;
  }
  static std::atomic<int>& calls() {
    static std::atomic<int> calls;
    return calls;
  }
  static int ask(SystemCall call) {
    State& s = state();
    const Fault& fault = s.of_kind[size_t(call)];
    if (++s.made[size_t(call)] == fault.n) return fault.error;
    return ++calls() == s.of_any.n ? s.of_any.error : 0;
  }
};

}  // namespace kaustik::test
