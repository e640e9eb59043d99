#include "apps/settings/table/table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>

#include "apps/command_line/values.h"
#include "apps/settings/table/choice_row.h"
#include "apps/settings/table/number_settings.h"
#include "apps/settings/table/quality.h"
#include "apps/settings/table/rows.h"
#include "core/diagnostics/nearest_name.h"
#include "render/film/film.h"
#include "render/settings/names.h"

namespace kaustik::app {

namespace {

using render::RenderSettings;

constexpr uint64_t kMaxInt = std::numeric_limits<int>::max();
constexpr uint64_t kMaxUint32 = std::numeric_limits<uint32_t>::max();
constexpr uint64_t kMaxUint64 = std::numeric_limits<uint64_t>::max();
constexpr std::string_view kByMethod = "set by --method";

// Sets of commands that several rows name. A command that is missing has a list of values instead of the
// setting, or has no use for it.
constexpr SettingsCommand kRender = SettingsCommand::kRender;
constexpr CommandSet kRenderAndBench = kRender | SettingsCommand::kBench;
constexpr CommandSet kRenderAndPhotons = kRender | SettingsCommand::kPhotons;
constexpr CommandSet kAllThatTrace = kRenderingCommands | SettingsCommand::kPhotons;
constexpr CommandSet kThatWritePictures = kRender | SettingsCommand::kResume | SettingsCommand::kMerge;

template <class T>
std::optional<T> whole_in_range(std::string_view text, uint64_t least, uint64_t most) {
  const std::optional<uint64_t> value = parse_count(text);
  if (!value || *value < least || *value > most) return std::nullopt;
  return static_cast<T>(*value);
}

// A row for an integer, with suffixes. `zero`: how the table describes 0, if 0 has a special meaning.
template <class T>
Setting count(std::string_view name, CommandSet commands, std::string_view unit, T RenderSettings::*field,
              uint64_t least, uint64_t most, std::string_view zero, std::string_view doc) {
  Setting s{.name = name,
            .commands = commands,
            .kind = ValueKind::kCount,
            .value_name = "COUNT",
            .unit = unit,
            .doc = doc};
  const uint64_t preset = static_cast<uint64_t>(medium_quality().*field);
  s.default_text = preset == 0 && !zero.empty() ? std::string(zero) : count_text(preset);
  const bool any_size = most == std::numeric_limits<uint64_t>::max();
  s.range = any_size ? fmt::format("{} or more", least) : fmt::format("{} to {}", least, count_text(most));
  s.assign = [=, range = s.range](Settings& settings, ValueTexts texts) -> Complaint {
    const std::optional<T> value = whole_in_range<T>(texts[0], least, most);
    if (!value)
      return fmt::format("`{}`: expected a whole number, {} (like 250, 10k, 2.5M, 1G)", texts[0], range);
    settings.render.*field = *value;
    return std::nullopt;
  };
  s.show = [field](const Settings& settings) { return as_texts(settings.render.*field); };
  return s;
}

template <class Enum, class Field, size_t N>
Setting choice(std::string_view name, CommandSet commands, Field RenderSettings::*field,
               const std::array<std::string_view, N>& names, std::string default_text, std::string_view doc) {
  const auto in_render = [field](auto& settings) -> auto& {
    return settings.render.*field;
  };
  return choice_row<Enum>(name, commands, in_render, names, std::move(default_text), doc);
}

template <class Enum, size_t N>
Setting choice(std::string_view name, CommandSet commands, Enum RenderSettings::*field,
               const std::array<std::string_view, N>& names, std::string_view doc) {
  return choice<Enum>(name, commands, field, names,
                      std::string(names[static_cast<size_t>(medium_quality().*field)]), doc);
}

Setting crop_setting() {
  Setting s{.name = "crop",
            .commands = kRenderingCommands,
            .kind = ValueKind::kInteger,
            .value_name = "X0 X1 Y0 Y1",
            .unit = "pixels",
            .range = "X0 < X1, Y0 < Y1",
            .default_text = "whole image",
            .doc = "Render only columns X0 to X1 - 1 and rows Y0 to Y1 - 1. Row 0 is at the top.",
            .values = 4};
  s.assign = [](Settings& settings, ValueTexts texts) -> Complaint {
    std::array<int, 4> edges{};
    for (size_t i = 0; i < edges.size(); ++i) {
      const std::optional<int64_t> value = parse_integer(texts[i]);
      if (!value || *value < 0 || *value > std::numeric_limits<int>::max()) {
        return fmt::format("`{}`: expected a pixel coordinate, 0 or more", texts[i]);
      }
      edges[i] = static_cast<int>(*value);
    }
    const render::CropWindow crop{edges[0], edges[1], edges[2], edges[3]};
    if (crop.empty()) {
      return fmt::format("`{}`: the window is empty; expected X0 X1 Y0 Y1 with X0 < X1 and Y0 < Y1",
                         fmt::join(texts, " "));
    }
    settings.render.crop = crop;
    return std::nullopt;
  };
  s.show = [](const Settings& settings) {
    const render::CropWindow& c = settings.render.crop;
    return c.empty() ? std::vector<std::string>{} : as_texts(c.x0, c.x1, c.y0, c.y1);
  };
  return s;
}

Setting aov_setting() {
  Setting s{.name = "aov",
            .commands = kThatWritePictures,
            .kind = ValueKind::kNames,
            .value_name = "NAMES",
            .range = fmt::format("{}, {}, all, none", fmt::join(render::kLayerNames, ", "),
                                 render::kDenoisingLayers),
            .default_text = "none",
            .doc =
                "Layers to write to EXR files besides the image, separated by commas; denoising: all that "
                "`kaustik denoise` reads."};
  s.choices.assign(render::kLayerNames.begin(), render::kLayerNames.end());
  s.choices.insert(s.choices.end(), {render::kDenoisingLayers, "all", "none"});
  s.assign = [names = s.choices](Settings& settings, ValueTexts texts) -> Complaint {
    std::vector<std::string> layers = split_at_commas(fmt::format("{}", fmt::join(texts, ",")));
    for (const std::string& layer : layers) {
      if (std::find(names.begin(), names.end(), layer) == names.end()) {
        return fmt::format("`{}` is not a layer{}", layer, name_hint(layer, names));
      }
    }
    std::erase(layers, "none");
    settings.render.aov = std::move(layers);
    return std::nullopt;
  };
  s.show = [](const Settings& settings) {
    return settings.render.aov.empty() ? as_texts("none") : settings.render.aov;
  };
  s.decides_sums = false;
  return s;
}

Setting tonemap_setting() {
  Setting s{
      .name = "tonemap",
      .commands = kThatWritePictures | SettingsCommand::kSweep | SettingsCommand::kDenoise,
      .kind = ValueKind::kChoice,
      .value_name = "NAME",
      .range = fmt::format("{}", fmt::join(render::kTonemapNames, ", ")),
      .default_text = std::string(render::name_of(ToneChoice{}.tonemap)),
      .doc =
          "How PNG and JPEG files map radiance to the range from 0 to 1. filmic: each channel by a curve "
          "that keeps detail in highlights. reinhard: all channels by the luminance Y, times 1 / (1 + Y). "
          "srgb: by clipping."};
  s.choices.assign(render::kTonemapNames.begin(), render::kTonemapNames.end());
  s.assign = [](Settings& settings, ValueTexts texts) -> Complaint {
    const std::optional<render::Tonemap> value = render::tonemap_from_name(texts[0]);
    if (!value) return not_a_choice(texts[0], render::kTonemapNames);
    settings.tone.tonemap = *value;
    return std::nullopt;
  };
  s.show = [](const Settings& settings) { return as_texts(render::name_of(settings.tone.tonemap)); };
  s.decides_sums = false;
  return s;
}

// The rows that choose the estimators.
void add_methods(std::vector<Setting>& table) {
  table.push_back(
      choice("method", kRenderAndBench, &RenderSettings::method, render::kMethodNames,
             "Preset of the estimators --direct, --caustics and --indirect. raytrace: direct light by shadow "
             "rays, and "
             "what mirrors and glass show; no caustics and no indirect light. mc: unbiased path tracing, for "
             "references. hybrid: direct light by the lecture's test, caustics from photons, indirect light "
             "by paths. "
             "photon: everything from photons. auto: the fastest mix for the scene."));
  table.push_back(choice<render::DirectEstimator>(
      "direct", kRenderingCommands, &RenderSettings::direct, render::kDirectNames, std::string(kByMethod),
      "Estimator of direct light. shadow-rays: sample a light and trace a ray to it. photons: the density of "
      "direct photons. lecture: photons where they suffice, else shadow rays. predicted: like shadow-rays, "
      "but "
      "where photons predict the visibility only few rays are traced, without bias. signed: the unoccluded "
      "light "
      "minus the flux of shadow photons."));
  table.push_back(choice<render::CausticEstimator>("caustics", kRenderingCommands, &RenderSettings::caustics,
                                                   render::kCausticNames, std::string(kByMethod),
                                                   "Estimator of caustics, the light that reaches a diffuse "
                                                   "surface by way of mirrors and glass only. photons: "
                                                   "from photon maps. paths: by path tracing. split: photons "
                                                   "for small bright lights, paths for others. off: none."));
  table.push_back(choice<render::IndirectEstimator>(
      "indirect", kRenderingCommands, &RenderSettings::indirect, render::kIndirectNames,
      std::string(kByMethod),
      "Estimator of indirect light, which reaches the visible surface after a diffuse reflection elsewhere. "
      "paths: by path tracing. photons: from photon maps. split: photons carry the light of bright places, "
      "paths find that of others. off: none."));
}

void add_photons(std::vector<Setting>& table) {
  table.push_back(count("photons", kRenderAndPhotons, "photons", &RenderSettings::photons, 1, kMaxUint64, {},
                        "Number of photons to emit; half as many again if caustics are guided. With "
                        "--balance-photons on, which is the default where no number is given: their scale."));
  table.back().reader = SettingReader::kEmission;
  table.push_back(choice<render::Balance>(
      "balance-photons", kRenderAndPhotons, &RenderSettings::balance, render::kBalanceNames,
      "on; off with --photons",
      "on: few photons tell how many caustic and how many indirect ones are worth their time in this scene, "
      "at most 4 times --photons of each. off: --photons of them."));
  table.back().reader = SettingReader::kEmission;
  table.push_back(count(
      "passes", kRenderingCommands, "passes", &RenderSettings::passes, 0, kMaxInt, "0 (as memory allows)",
      "Number of equal passes among which photons and samples are divided; both are rounded up. Each pass "
      "has "
      "photon maps of its own, so that only those of one pass are in memory. 0: one pass, or as many as "
      "needed for the maps to fit into memory."));
  table.push_back(radius_setting());
  table.back().reader = SettingReader::kGather;
  table.push_back(alpha_setting());
  table.back().reader = SettingReader::kGather;
  table.push_back(count("nearest", kRenderingCommands, "photons", &RenderSettings::nearest, 0, kMaxUint32,
                        "0 (off)",
                        "Shrink the radius to the COUNT-th nearest photon where more photons are in reach."));
  table.back().reader = SettingReader::kGather;
  table.push_back(
      choice("kernel", kRenderingCommands, &RenderSettings::kernel, render::kKernelNames,
             "Weight of a photon as a function of its distance, normalised over the disc of radius r0."));
  table.back().reader = SettingReader::kGather;
  table.push_back(cone_k_setting());
  table.back().reader = SettingReader::kGather;
  table.push_back(
      count("min-photons", kRenderingCommands, "photons", &RenderSettings::min_photons, 0, kMaxUint32, {},
            "M0 of the lecture's test: an octree node decides only if it holds more photons than this."));
  table.back().reader = SettingReader::kLectureTest;
  table.push_back(count("node-photons", kRenderingCommands, "photons", &RenderSettings::node_photons, 1,
                        kMaxUint32, {},
                        "N0 of the lecture: an octree node with at most this many photons is not divided."));
  table.back().reader = SettingReader::kGather;
  table.push_back(choice(
      "lookup", kRenderingCommands, &RenderSettings::lookup, render::kLookupNames,
      "Which photons a gather uses. exact: all within the radius. leaf: those of one octree node, as in the "
      "lecture."));
  table.back().reader = SettingReader::kGather;
}

// How photons are emitted and how far they and paths go.
void add_emission(std::vector<Setting>& table) {
  table.push_back(choice("emission", kAllThatTrace, &RenderSettings::emission, render::kEmissionNames,
                         "Distribution of photon directions at area lights. cosine: photons of equal flux. "
                         "uniform-angle: uniform in "
                         "angle and weighted, as in the lecture."));
  table.back().reader = SettingReader::kEmission;
  table.push_back(choice("guide", kRenderingCommands, &RenderSettings::guide, render::kGuideNames,
                         "Guided emission. on: caustic photons are emitted where earlier photons reached a "
                         "diffuse surface by way of "
                         "mirrors and glass, and indirect photons where earlier photons reached visible "
                         "surfaces. off: all kinds "
                         "come from the same photons."));
  table.back().reader = SettingReader::kGuidedEmission;
  table.push_back(
      choice("for-camera", kRenderingCommands, &RenderSettings::for_camera, render::kForCameraNames,
             "Cameras for which indirect photons are guided and gather radii are chosen. this: the camera of "
             "the render. all: any camera in the scene, for photon maps that several cameras share."));
  table.back().reader = SettingReader::kEmission;
  table.push_back(count("max-bounces", kAllThatTrace, "bounces", &RenderSettings::max_bounces, 1, 65535, {},
                        "Most reflections and refractions of a photon or path."));
}

Setting memory_setting() {
  Setting s = count("memory", kAllThatTrace | SettingsCommand::kResume, "bytes", &RenderSettings::memory, 0,
                    kMaxUint64, "0 (what the system leaves)",
                    "Most memory that the process takes, such as 2G: for the scene, its BVH, the film and "
                    "photons, which are divided into passes that fit. 0: what the machine, the control group "
                    "and `ulimit` leave.");
  s.value_name = "BYTES";
  s.decides_sums = false;
  s.in_scene_files = false;
  return s;
}

void add_image(std::vector<Setting>& table) {
  table.push_back(count("spp", kRenderAndBench, "samples", &RenderSettings::spp, 1, kMaxInt, {},
                        "Camera samples per pixel. With --balance-samples on, which is the default where no "
                        "number is given: at least these."));
  table.push_back(choice<render::Balance>(
      "balance-samples", kRenderingCommands, &RenderSettings::sample_balance, render::kBalanceNames,
      "on; off with --spp, or with a file that asks for more samples than --quality",
      "on: up to 16 times --spp, but not beyond 1,024, where paths bring what photons would, as far as few "
      "photons tell that the "
      "paths "
      "are noisy; not with --time or --target-error. off: --spp."));
  table.push_back(adaptive_setting());
  table.back().reader = SettingReader::kAdaptiveSamples;
  table.push_back(count("seed", kAllThatTrace, {}, &RenderSettings::seed, 0, kMaxUint64, {},
                        "Random seed. The same seed gives a bit-identical image."));
  table.push_back(count(
      "threads",
      kRenderAndPhotons | SettingsCommand::kResume | SettingsCommand::kSweep | SettingsCommand::kDenoise,
      "threads", &RenderSettings::threads, 0, 65535, "0 (all usable cores)",
      "Most threads that the process uses: at most four for each core, or 64. The image does not depend on "
      "it."));
  table.back().decides_sums = false;
  table.push_back(memory_setting());
  table.push_back(count("width", kAllThatTrace, "pixels", &RenderSettings::width, 0, 65535, "0 (the scene's)",
                        "Image width. If it is given alone, the height keeps the aspect ratio."));
  table.push_back(count("height", kAllThatTrace, "pixels", &RenderSettings::height, 0, 65535,
                        "0 (the scene's)",
                        "Image height. If it is given alone, the width keeps the aspect ratio."));
  table.push_back(crop_setting());
  table.push_back(aov_setting());
  table.push_back(exposure_setting());
  table.push_back(tonemap_setting());
}

// What renders of a scene need most: how good, how long, how large, how bright, and from where.
constexpr std::array<std::string_view, 16> kEveryday = {
    "quality", "time", "target-error", "method", "photons", "spp",     "denoise", "width",
    "height",  "crop", "exposure",     "aov",    "camera",  "look-at", "sky",     "threads"};

// What kept photon maps depend on.
constexpr std::array<std::string_view, 11> kOfPhotons = {
    "photons", "balance-photons", "emission", "guide", "for-camera", "max-bounces", "seed",
    "at",      "light-unit",      "sky",      "floor"};
constexpr std::array<std::string_view, 4> kOfEstimators = {"method", "direct", "caustics", "indirect"};

// What `kaustik shoot` takes besides: the camera, for which photons are guided, among others.
constexpr std::array<std::string_view, 9> kShooting = {"width", "height",  "camera",  "look-at", "memory",
                                                       "fov",   "quality", "threads", "frame"};

bool among_names(std::span<const std::string_view> names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

MapPart map_part_of(std::string_view name) {
  if (among_names(kOfPhotons, name)) return MapPart::kPhotons;
  if (among_names(kOfEstimators, name)) return MapPart::kEstimators;
  return name == "radius" ? MapPart::kRadii : MapPart::kNone;
}

std::vector<Setting> make_table() {
  std::vector<Setting> table = {quality_setting()};
  add_methods(table);
  add_photons(table);
  add_emission(table);
  std::vector<Setting> stop = stop_rows();
  std::move(stop.begin(), stop.end(), std::back_inserter(table));
  add_image(table);
  for (std::vector<Setting> rows : {import_rows(), view_rows()})
    std::move(rows.begin(), rows.end(), std::back_inserter(table));
  for (Setting& setting : table) {
    setting.for_everyday = among_names(kEveryday, setting.name);
    setting.map_part = map_part_of(setting.name);
    const bool shoots = setting.map_part != MapPart::kNone || among_names(kShooting, setting.name);
    if (setting.commands.has(kRender) && shoots)
      setting.commands = setting.commands | SettingsCommand::kShoot;
  }
  return table;
}

// Whether two names are equal, ignoring dashes.
bool same_name(std::string_view a, std::string_view b) {
  size_t i = 0, j = 0;
  for (;;) {
    while (i < a.size() && a[i] == '-') ++i;
    while (j < b.size() && b[j] == '-') ++j;
    if (i == a.size() || j == b.size()) return i == a.size() && j == b.size();
    if (a[i++] != b[j++]) return false;
  }
}

}  // namespace

const std::vector<Setting>& settings_table() {
  static const std::vector<Setting> table = make_table();
  return table;
}

const Setting* find_setting(std::string_view name) {
  for (const Setting& setting : settings_table()) {
    if (same_name(setting.name, name)) return &setting;
  }
  return nullptr;
}

std::string settings_markdown() {
  std::string text = "| option | default | unit | values | meaning |\n| --- | --- | --- | --- | --- |\n";
  for (const Setting& s : settings_table()) {
    text += fmt::format("| `--{} {}` | {} | {} | {} | {} |\n", s.name, s.value_name, s.default_text, s.unit,
                        s.range, s.doc);
  }
  return text;
}

}  // namespace kaustik::app
