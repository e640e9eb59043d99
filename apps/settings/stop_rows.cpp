#include "apps/settings/rows.h"
#include "apps/settings/values.h"
#include "render/names.h"

namespace kaustik::app {

namespace {

// Takes a rule back that the scene's file or a partial result holds.
constexpr std::string_view kNone = "none";
Complaint take_back(std::optional<double>& rule) {
  rule.reset();
  return std::nullopt;
}

Setting target_error_row() {
  Setting s{
      .name = "target-error",
      .kind = ValueKind::kChoice,
      .value_name = "E",
      .range = "above 0, like 1% or 0.01; none",
      .default_text = "none",
      .doc =
          "Render passes until the picture's error is below E: the bound that holds with 90 % confidence for "
          "noise and kernel bias, relative to the radiance, as a mean over pixels. Radiance below a tenth of "
          "the picture's mean counts as that."};
  s.assign = [](Settings& settings, Texts texts) -> Complaint {
    if (texts[0] == kNone) return take_back(settings.stop.target_error);
    const std::optional<double> share = parse_share(texts[0]);
    if (!share || *share <= 0)
      return fmt::format("`{}`: expected a share above 0, like 1% or 0.01", texts[0]);
    settings.stop.target_error = *share;
    return std::nullopt;
  };
  s.show = [](const Settings& settings) {
    return settings.stop.target_error ? as_texts(*settings.stop.target_error) : std::vector<std::string>{};
  };
  s.decides_sums = false;
  return s;
}

Setting target_quantile_row() {
  Setting s{
      .name = "target-quantile",
      .kind = ValueKind::kChoice,
      .value_name = "Q",
      .range = "above 0, at most 1, like 95% or 0.95; none",
      .default_text = "none (the mean)",
      .doc = "The error that --target-error bounds is that of this quantile of the pixels, not their mean."};
  s.assign = [](Settings& settings, Texts texts) -> Complaint {
    if (texts[0] == kNone) return take_back(settings.stop.target_quantile);
    const std::optional<double> share = parse_share(texts[0]);
    if (!share || *share <= 0 || *share > 1)
      return fmt::format("`{}`: expected a share above 0, at most 1, like 95% or 0.95", texts[0]);
    settings.stop.target_quantile = *share;
    return std::nullopt;
  };
  s.show = [](const Settings& settings) {
    return settings.stop.target_quantile ? as_texts(*settings.stop.target_quantile)
                                         : std::vector<std::string>{};
  };
  s.decides_sums = false;
  return s;
}

Setting time_row() {
  Setting s{
      .name = "time",
      .kind = ValueKind::kChoice,
      .value_name = "TIME",
      .range = "like 60s, 10m or 1.5h; none",
      .default_text = "none",
      .doc =
          "Render passes until the next would end later than this after the start; a first pass there is "
          "always. Of a render that is resumed, the time of its earlier passes counts."};
  s.assign = [](Settings& settings, Texts texts) -> Complaint {
    if (texts[0] == kNone) return take_back(settings.stop.seconds);
    const std::optional<double> seconds = parse_duration(texts[0]);
    if (!seconds || *seconds <= 0)
      return fmt::format("`{}`: expected a time above 0 with its unit, like 60s, 10m or 1.5h", texts[0]);
    settings.stop.seconds = *seconds;
    return std::nullopt;
  };
  s.show = [](const Settings& settings) {
    return settings.stop.seconds ? as_texts(fmt::format("{}s", *settings.stop.seconds))
                                 : std::vector<std::string>{};
  };
  s.decides_sums = false;
  return s;
}

Setting estimate_bias_row() {
  constexpr std::array<std::string_view, 2> kOffOn = {"off", "on"};
  Setting s{.name = "estimate-bias",
            .kind = ValueKind::kChoice,
            .value_name = "NAME",
            .range = "off, on",
            .default_text = "on where the error is asked for",
            .doc =
                "Measure the bias of the photon maps' kernels, by reading them at half the radius too, once "
                "a pixel "
                "and pass. Asked for by --target-error and by the layers error and bias."};
  s.choices.assign(kOffOn.begin(), kOffOn.end());
  s.assign = [kOffOn](Settings& settings, Texts texts) -> Complaint {
    const std::optional<bool> on = render::from_name<bool>(kOffOn, texts[0]);
    if (!on) return fmt::format("`{}`: expected off or on", texts[0]);
    settings.render.estimate_bias = *on;
    return std::nullopt;
  };
  s.show = [kOffOn](const Settings& settings) {
    const std::optional<bool>& on = settings.render.estimate_bias;
    return on ? as_texts(kOffOn[*on ? 1 : 0]) : std::vector<std::string>{};
  };
  return s;
}

}  // namespace

std::vector<Setting> stop_rows() {
  return {target_error_row(), target_quantile_row(), time_row(), estimate_bias_row()};
}

}  // namespace kaustik::app
