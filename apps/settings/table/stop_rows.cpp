#include <limits>

#include "apps/command_line/values.h"
#include "apps/settings/table/rows.h"
#include "render/settings/names.h"

namespace kaustik::app {

namespace {

constexpr CommandSet kStopped = SettingsCommand::kRender | SettingsCommand::kResume;

// The values that a rule accepts: above 0 and at most `most`. "none" removes a rule that the scene file or a
// partial result sets.
struct RuleValue {
  std::optional<double> StopSettings::*field;
  std::optional<double> (*parse)(std::string_view);
  std::string_view expected;
  std::string_view unit = "";  // suffix with which `show` writes the value
  double most = std::numeric_limits<double>::infinity();
};

Setting rule(Setting s, const RuleValue& rule) {
  s.kind = ValueKind::kChoice;
  s.assign = [rule](Settings& settings, ValueTexts texts) -> Complaint {
    const std::optional<double> value = texts[0] == "none" ? std::nullopt : rule.parse(texts[0]);
    if (texts[0] != "none" && !(value && *value > 0 && *value <= rule.most))
      return fmt::format("`{}`: expected {}", texts[0], rule.expected);
    settings.stop.*rule.field = value;
    return std::nullopt;
  };
  s.show = [rule](const Settings& settings) {
    const std::optional<double>& value = settings.stop.*rule.field;
    return value ? as_texts(fmt::format("{}{}", *value, rule.unit)) : std::vector<std::string>{};
  };
  s.decides_sums = false;
  return s;
}

// A share. One above 1 needs the percent sign: `5` is more likely meant as 5 % than as 500 %.
std::optional<double> parse_error(std::string_view text) {
  const std::optional<double> share = parse_share(text);
  return share && *share > 1 && !text.ends_with('%') ? std::nullopt : share;
}

std::string error_text(double share) {
  return share > 1 ? fmt::format("{}%", 100 * share) : fmt::format("{}", share);
}

Setting target_error_row() {
  Setting s = rule(
      {.name = "target-error",
       .commands = kStopped,
       .value_name = "E",
       .range = "above 0, like 1% or 0.01; above 1 only with %; none",
       .default_text = "none",
       .doc =
           "Render passes until the picture's error is at most E. The error is the 90 % confidence bound of "
           "noise and kernel bias, relative to the radiance, as a mean over the pixels. Radiance below a "
           "tenth of the picture's mean counts as a tenth of it."},
      {&StopSettings::target_error, parse_error,
       "a share above 0, like 1% or 0.01, and the percent sign if it is above 1"});
  s.show = [](const Settings& settings) {
    const std::optional<double> share = settings.stop.target_error;
    return share ? as_texts(error_text(*share)) : std::vector<std::string>{};
  };
  return s;
}

Setting target_quantile_row() {
  return rule(
      {.name = "target-quantile",
       .commands = kStopped,
       .value_name = "Q",
       .range = "above 0, at most 1, like 95% or 0.95; none",
       .default_text = "none (the mean)",
       .doc = "Make --target-error limit the error at this quantile of the pixels instead of their mean."},
      {&StopSettings::target_quantile, parse_share, "a share above 0, at most 1, like 95% or 0.95", "", 1});
}

Setting time_row() {
  return rule(
      {.name = "time",
       .commands = kStopped,
       .value_name = "TIME",
       .range = "like 60s, 10m or 1.5h; none",
       .default_text = "none",
       .doc =
           "Time limit of the render, counted from the start of the program. If no passes are asked for and "
           "the "
           "command line sets neither photons nor samples, trials choose how many of them fill the time. "
           "Otherwise "
           "passes are rendered until the next one would end too late; the first is always rendered. For a "
           "resumed render the time of its earlier passes counts."},
      {&StopSettings::seconds, parse_duration, "a time above 0 with its unit, like 60s, 10m or 1.5h", "s"});
}

// A setting that is off, on, or left to its default.
Setting switch_row(std::string_view name, CommandSet commands,
                   std::optional<bool> render::RenderSettings::*member, std::string_view by_default,
                   std::string_view doc) {
  constexpr std::array<std::string_view, 2> kOffOn = {"off", "on"};
  Setting s{.name = name,
            .commands = commands,
            .kind = ValueKind::kChoice,
            .value_name = "NAME",
            .range = "off, on",
            .default_text = std::string(by_default),
            .doc = doc};
  s.choices.assign(kOffOn.begin(), kOffOn.end());
  s.assign = [kOffOn, member](Settings& settings, ValueTexts texts) -> Complaint {
    const std::optional<bool> on = render::from_name<bool>(kOffOn, texts[0]);
    if (!on) return fmt::format("`{}`: expected off or on", texts[0]);
    settings.render.*member = *on;
    return std::nullopt;
  };
  s.show = [kOffOn, member](const Settings& settings) {
    const std::optional<bool>& on = settings.render.*member;
    return on ? as_texts(kOffOn[*on ? 1 : 0]) : std::vector<std::string>{};
  };
  return s;
}

Setting estimate_bias_row() {
  return switch_row(
      "estimate-bias", kRenderingCommands, &render::RenderSettings::estimate_bias,
      "on if the error is asked for",
      "Measure the bias of the photon maps' kernels by gathering at half the radius too, once per pixel and "
      "pass. --target-error and the layers error and bias turn it on.");
}

Setting denoise_row() {
  return switch_row(
      "denoise", SettingsCommand::kRender, &render::RenderSettings::denoise,
      "on for --time and for up to 256 samples a pixel; off for more, and with --passes, --target-error, "
      "--crop, "
      "partial results or --method mc",
      "Filter noise out of the picture. EXR files then hold the unfiltered picture as the layer noisy; other "
      "layers and the stated error are never filtered.");
}

Setting final_gather_row() {
  return switch_row(
      "final-gather", SettingsCommand::kRender, &render::RenderSettings::final_gather,
      "on with --method auto; off with --quality reference, --target-error, --estimate-bias and the layer "
      "error",
      "Let paths that look for indirect light end at the second diffuse surface, in the light that few "
      "photons have brought there. Takes most of their noise; blurs the light of light less than the paths "
      "do, but no number of samples takes that away. off: paths go on.");
}

}  // namespace

std::vector<Setting> stop_rows() {
  return {target_error_row(),  target_quantile_row(), time_row(),
          estimate_bias_row(), denoise_row(),         final_gather_row()};
}

}  // namespace kaustik::app
