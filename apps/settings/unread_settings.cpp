#include "apps/settings/unread_settings.h"

#include <fmt/format.h>

#include "render/settings/names.h"

namespace kaustik::app {

namespace {

bool reads(const render::EstimatorPlan& plan, SettingReader reader) {
  const photon::KindMask kinds = render::kinds_needed(plan);
  switch (reader) {
    case SettingReader::kEveryRender:
      return true;
    case SettingReader::kEmission:
      return kinds.any() || plan.direct == render::DirectEstimator::kPredicted;
    case SettingReader::kGather:
      return kinds.any();
    case SettingReader::kGuidedEmission:
      return kinds.caustic || kinds.indirect;
    case SettingReader::kLectureTest:
      return plan.direct == render::DirectEstimator::kLecture;
    case SettingReader::kAdaptiveSamples:
      return !render::traces_paths(plan) || render::splits_sources(plan);  // which may name photons
  }
  return true;
}

}  // namespace

std::vector<std::string> unread_settings(const SettingOverrides& given, const render::EstimatorPlan& plan) {
  std::vector<std::string> warnings;
  for (const Setting& setting : settings_table()) {
    if (!given.sets(setting.name) || reads(plan, setting.reader)) continue;
    warnings.push_back(fmt::format(
        "--{} has no effect: with direct {}, caustics {} and indirect {}, nothing reads it", setting.name,
        render::name_of(plan.direct), render::name_of(plan.caustics), render::name_of(plan.indirect)));
  }
  return warnings;
}

}  // namespace kaustik::app
