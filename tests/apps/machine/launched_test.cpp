// Tests what the environment of launchers says.

#include "apps/machine/launched.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <initializer_list>
#include <string>
#include <utility>

#include "apps/machine/usable_cores.h"

namespace kaustik::app {
namespace {

class LaunchedBy : public ::testing::Test {
 protected:
  static constexpr std::initializer_list<const char*> kNames = {
      "OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_LOCAL_SIZE", "PMI_SIZE", "MPI_LOCALNRANKS", "PMIX_RANK",
      "SLURM_STEP_NUM_TASKS"};
  void SetUp() override { clear(); }
  void TearDown() override { clear(); }
  static void clear() {
    for (const char* const name : kNames) unsetenv(name);
  }
  static Launched with(std::initializer_list<std::pair<const char*, const char*>> variables) {
    clear();
    for (const auto& [name, value] : variables) setenv(name, value, 1);
    return launched();
  }
};

TEST_F(LaunchedBy, NobodyIsAlone) {
  EXPECT_EQ(launched().ranks, 0);
  EXPECT_EQ(launched().on_machine, 1);
}

TEST_F(LaunchedBy, MpirunSaysHowManyRanksThereAre) {
  const Launched four = with({{"OMPI_COMM_WORLD_SIZE", "4"}, {"OMPI_COMM_WORLD_LOCAL_SIZE", "2"}});
  EXPECT_EQ(four.ranks, 4);
  EXPECT_EQ(four.on_machine, 2);
  EXPECT_EQ(with({{"OMPI_COMM_WORLD_SIZE", "1"}}).ranks, 1);
  for (const char* const bad : {"", "-3", "4x", "99999999999"})
    EXPECT_EQ(with({{"OMPI_COMM_WORLD_SIZE", bad}}).ranks, 0);
}

TEST_F(LaunchedBy, SrunStartsRanksOnlyWhereThereAreSeveralTasks) {
  EXPECT_EQ(with({{"PMIX_RANK", "0"}, {"SLURM_STEP_NUM_TASKS", "3"}}).ranks, 3);
  EXPECT_EQ(with({{"PMIX_RANK", "0"}, {"SLURM_STEP_NUM_TASKS", "1"}}).ranks, 0);
  EXPECT_EQ(with({{"SLURM_STEP_NUM_TASKS", "3"}}).ranks, 0);  // tasks without MPI
  EXPECT_EQ(with({{"PMI_SIZE", "5"}}).ranks, 5);
}

TEST_F(LaunchedBy, RanksThatAreNotBoundShareTheCores) {
  CoreLimits limits{.hardware = 8, .affinity = 8, .quota = {}, .ranks = 2};
  EXPECT_EQ(limits.usable(), 4);
  limits.affinity = 3;  // bound
  EXPECT_EQ(limits.usable(), 3);
  limits = {.hardware = 2, .affinity = 2, .quota = {}, .ranks = 4};
  EXPECT_EQ(limits.usable(), 1);
}

}  // namespace
}  // namespace kaustik::app
