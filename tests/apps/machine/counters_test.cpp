// What the kernel counts: threads that wait for cores, and energy.

#include <gtest/gtest.h>

#include <filesystem>

#include "apps/machine/energy.h"
#include "apps/machine/waiting.h"
#include "tests/apps/support/program.h"

namespace kaustik::app {
namespace {

class KernelCounters : public test::ProgramTest {
 protected:
  void put(const std::string& file, const std::string& text) const {
    std::filesystem::create_directories(std::filesystem::path(path(file)).parent_path());
    write(file, text);
  }
};

TEST_F(KernelCounters, WaitingIsSummedOverThreads) {
  EXPECT_FALSE(waiting_seconds(path(".")));
  put("proc/self/task/1/schedstat", "5000000000 1000000000 77\n");
  put("proc/self/task/2/schedstat", "9 500000000 1\n");
  put("proc/self/task/3/schedstat", "");  // a thread that ends
  EXPECT_DOUBLE_EQ(waiting_seconds(path(".")).value(), 1.5);
}

TEST_F(KernelCounters, EnergyOfPackagesWrapsAround) {
  EXPECT_FALSE(EnergyMeter(path(".")).joules());
  for (const char* package : {"intel-rapl:0", "intel-rapl:1"}) {
    put(std::string("sys/class/powercap/") + package + "/energy_uj", "9000000\n");
    put(std::string("sys/class/powercap/") + package + "/max_energy_range_uj", "10000000\n");
  }
  put("sys/class/powercap/intel-rapl:0:0/energy_uj", "5000000\n");  // a part of package 0
  put("sys/class/powercap/intel-rapl:0:0/max_energy_range_uj", "10000000\n");
  EnergyMeter meter(path("."));
  put("sys/class/powercap/intel-rapl:0/energy_uj", "9500000\n");
  put("sys/class/powercap/intel-rapl:1/energy_uj", "1000000\n");
  put("sys/class/powercap/intel-rapl:0:0/energy_uj", "6000000\n");
  EXPECT_DOUBLE_EQ(meter.joules().value(), 0.5 + 2);
  put("sys/class/powercap/intel-rapl:0/energy_uj", "9600000\n");
  EXPECT_DOUBLE_EQ(meter.joules().value(), 2.6);
}

}  // namespace
}  // namespace kaustik::app
