#include "apps/settings/table/number_settings.h"

#include <fmt/format.h>

#include <cmath>

#include "apps/command_line/values.h"
#include "apps/settings/table/rows.h"

namespace kaustik::app {

using render::kMostStops;
using render::RenderSettings;

std::optional<RadiusChoice> parse_radius(std::string_view text) {
  RadiusChoice choice;
  if (text == "auto") return choice;
  const bool factor = text.ends_with('x');
  if (factor) text.remove_suffix(1);
  const std::optional<float> value = parse_number(text);
  if (!value || *value <= 0) return std::nullopt;
  if (factor)
    choice.factor = *value;
  else
    choice.metres = *value;
  return choice;
}

RadiusChoice RadiusChoice::of(const Settings& settings) {
  return {settings.render.radius, settings.render.radius_factor};
}

void RadiusChoice::apply(Settings& settings) const {
  settings.render.radius = metres;
  settings.render.radius_factor = factor;
}

std::string RadiusChoice::text() const {
  if (metres) return fmt::format("{}", *metres);
  return factor == 1 ? "auto" : fmt::format("{}x", factor);
}

Setting radius_setting() {
  Setting s{
      .name = "radius",
      .commands = SettingsCommand::kRender | SettingsCommand::kBench,
      .kind = ValueKind::kNumber,
      .value_name = "R",
      .unit = "m",
      .range = "above 0, auto, or a multiple of auto like 0.5x",
      .default_text = "auto",
      .doc =
          "Gather radius r0 of the photon maps. auto: chosen for each map to balance noise and bias. A "
          "gather in a map of M photons then finds k ~ M^(2/3) of them: with a million photons 160 (direct), "
          "232 (caustic; each photon has its own radius) or 500 (indirect; four times as many where other "
          "surfaces are far). 0.5x: half of auto."};
  s.assign = [](Settings& settings, ValueTexts texts) -> Complaint {
    const std::optional<RadiusChoice> choice = parse_radius(texts[0]);
    if (!choice)
      return fmt::format("`{}`: expected a radius in metres above 0, auto, or a multiple of auto like 0.5x",
                         texts[0]);
    choice->apply(settings);
    return std::nullopt;
  };
  s.show = [](const Settings& settings) { return as_texts(RadiusChoice::of(settings).text()); };
  return s;
}

Setting alpha_setting() {
  Setting s{.name = "alpha",
            .commands = kRenderingCommands,
            .kind = ValueKind::kNumber,
            .value_name = "A",
            .range = "above 0, at most 1",
            .default_text = "1; 0.667 with --target-error, or when --time renders several passes",
            .doc =
                "How the radius shrinks over the passes: r^2 of pass i + 1 is (i + A) / (i + 1) times r^2 of "
                "pass i. 1: it stays the same. 0.667: both bias and noise vanish with the number of passes."};
  s.assign = [](Settings& settings, ValueTexts texts) -> Complaint {
    const std::optional<float> value = parse_number(texts[0]);
    if (!value || *value <= 0 || *value > 1)
      return fmt::format("`{}`: expected a number above 0, at most 1", texts[0]);
    settings.render.alpha = *value;
    return std::nullopt;
  };
  s.show = [](const Settings& settings) { return as_texts(settings.render.alpha.value_or(1)); };
  return s;
}

Setting adaptive_setting() {
  constexpr float kMost = 100;
  const float usual = RenderSettings{}.adaptive;
  Setting s{.name = "adaptive",
            .commands = kRenderingCommands,
            .kind = ValueKind::kNumber,
            .value_name = "W",
            .range = "0 to 100, off, on",
            .default_text = fmt::format("{}", usual),
            .doc =
                "Adaptive samples: further samples in the pixels where they reduce noise most for their "
                "cost, for up to W "
                "times the work of the --spp samples. off: 0, on: the default. A crop then has different "
                "noise from the "
                "same part of the whole picture. Renders in several passes and methods that trace paths from "
                "the camera "
                "take no adaptive samples."};
  s.assign = [usual, kMost](Settings& settings, ValueTexts texts) -> Complaint {
    std::optional<float> value = parse_number(texts[0]);
    if (texts[0] == "off") value = 0.0f;
    if (texts[0] == "on") value = usual;
    if (!value || !(*value >= 0) || *value > kMost)
      return fmt::format("`{}`: expected a number, 0 to {}, off or on", texts[0], kMost);
    settings.render.adaptive = *value;
    return std::nullopt;
  };
  s.show = [](const Settings& settings) { return as_texts(settings.render.adaptive); };
  return s;
}

Setting cone_k_setting() {
  Setting s{.name = "cone-k",
            .commands = kRenderingCommands,
            .kind = ValueKind::kNumber,
            .value_name = "K",
            .range = "1 or more",
            .default_text = fmt::format("{}", RenderSettings{}.cone_k),
            .doc =
                "Slope of the cone kernel, whose weight at distance d is 1 - d / (K r0). With 1 it falls to "
                "zero at r0; "
                "larger values make it flatter."};
  s.assign = [](Settings& settings, ValueTexts texts) -> Complaint {
    const std::optional<float> value = parse_number(texts[0]);
    if (!value || *value < 1) return fmt::format("`{}`: expected a number, 1 or more", texts[0]);
    settings.render.cone_k = *value;
    return std::nullopt;
  };
  s.show = [](const Settings& settings) { return as_texts(settings.render.cone_k); };
  return s;
}

Setting exposure_setting() {
  Setting s{
      .name = "exposure",
      .commands = SettingsCommand::kRender | SettingsCommand::kResume | SettingsCommand::kMerge |
                  SettingsCommand::kSweep | SettingsCommand::kDenoise,
      .kind = ValueKind::kNumber,
      .value_name = "STOPS",
      .unit = "stops",
      .range = fmt::format("-{} to {}, or auto", kMostStops, kMostStops),
      .default_text = "auto",
      .doc =
          "Multiply the radiance by 2^STOPS for PNG and JPEG files. EXR files keep the radiance. auto: show "
          "the log-average luminance of the picture as middle grey, without the lights that it shows and "
          "without extreme pixels. The number of stops is printed, to use it for other pictures."};
  s.assign = [](Settings& settings, ValueTexts texts) -> Complaint {
    const std::optional<float> value = parse_number(texts[0]);
    const bool automatic = texts[0] == "auto";
    if (!automatic && (!value || std::abs(*value) > kMostStops))
      return fmt::format("`{}`: expected stops, -{} to {}, or auto", texts[0], kMostStops, kMostStops);
    settings.tone.exposure = automatic ? std::nullopt : value;
    return std::nullopt;
  };
  s.show = [](const Settings& settings) {
    const std::optional<float> stops = settings.tone.exposure;
    return as_texts(stops ? fmt::format("{}", *stops) : "auto");
  };
  s.decides_sums = false;
  return s;
}

}  // namespace kaustik::app
