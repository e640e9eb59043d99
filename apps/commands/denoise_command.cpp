// kaustik denoise: filters the noise out of a picture that is already there.

#include <fmt/format.h>

#include <algorithm>

#include "apps/commands/commands.h"
#include "apps/console/exit_error.h"
#include "apps/machine/thread_limit.h"
#include "apps/session/files/collisions.h"
#include "apps/session/files/file_writer.h"
#include "apps/session/files/output_files.h"
#include "apps/session/tone.h"
#include "apps/settings/setting_options.h"
#include "core/stopwatch.h"
#include "render/denoise/denoise.h"
#include "render/denoise/noisy_picture.h"
#include "render/picture/exposure.h"
#include "render/picture/image_io.h"

namespace kaustik::app {

namespace {

struct DenoiseOptions {
  std::string picture;
  std::vector<std::string> outputs;
  SettingOverrides overrides;
};

// What read() makes of a file; refuses the file with its name if that fails.
template <class Read>
auto read_or_refuse(const std::string& path, const Read& read) {
  try {
    return read();
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    refuse(fmt::format("{}: {}", path, error.what()));
  }
}

// The file as it was read, with another picture in R, G and B, and the one before as the layer `noisy`.
void replace_picture(const render::Image& image, const render::Film& before, render::ExrChannels* file) {
  const auto put = [&](const std::string& name, const auto& value) {
    if (!file->find(name)) {
      file->names.push_back(name);
      file->values.emplace_back(image.pixels.size());
    }
    const auto at = std::find(file->names.begin(), file->names.end(), name) - file->names.begin();
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x)
        file->values[size_t(at)][size_t(y) * size_t(image.width) + size_t(x)] = value(x, y);
  };
  for (int c = 0; c < 3; ++c) {
    put(fmt::format("noisy.{}", "RGB"[c]), [&](int x, int y) { return before.at(x, y).radiance()[c]; });
    put(std::string(1, "RGB"[c]), [&](int x, int y) { return image.at(x, y)[c]; });
  }
}

int run_denoise(const DenoiseOptions& options, const Console& console) {
  if (options.outputs.empty()) refuse("-o is required: it names the file to write");
  std::vector<NamedFile> files;
  for (const std::string& path : options.outputs) {
    check_image_output(path);
    files.push_back({"-o", path});
  }
  check_collisions(files, {{"the picture", options.picture}});
  const Settings settings = options.overrides.alone();
  FileWriter writer(console);
  with_thread_limit(settings.render.threads, console, [&] {
    const std::string& path = options.picture;
    render::ExrChannels file =
        read_or_refuse(path, [&] { return render::read_exr_file(path, render::kMostPixelsRead); });
    const render::NoisyPicture noisy = read_or_refuse(path, [&] { return render::noisy_picture(file); });
    if (!noisy.measured)
      console.note(
          "the file has no halves of samples (kaustik render --aov denoising): its noise is estimated from "
          "the picture");
    for (const std::string& feature : noisy.missing)
      console.warning(fmt::format("{}: no layer of {} was found, which keeps edges sharp", path, feature));
    const Stopwatch watch;
    const render::Image image = render::denoise(noisy.film, noisy.halves);
    console.note(
        fmt::format("denoised {} x {} pixels in {:.2f} s", image.width, image.height, watch.seconds()));
    replace_picture(image, noisy.film, &file);
    render::ToneSettings tone;
    if (std::any_of(options.outputs.begin(), options.outputs.end(), shows_tones))
      tone = tone_for(image, render::lights_seen(file), settings.tone, console);
    for (const std::string& output : options.outputs)
      writer.write(output, [&] {
        if (render::is_exr(output))
          render::write_channels(output, file, {{"kaustik:denoised", path}});
        else
          render::write_image(output, image, tone);
      });
  });
  return writer.report() ? kDone : kFailed;
}

}  // namespace

Command make_denoise_command() {
  Command command("denoise", "Filter the noise out of a picture");
  const auto options = std::make_shared<DenoiseOptions>();
  command.add_argument(
      "PICTURE", options->picture,
      "EXR file, best one of `render --aov denoising`; of other renderers with their layers of "
      "albedo, normal and depth, by the names that Blender, pbrt and Mitsuba use");
  Option& output = command.add_list("-o,--output", "FILE", options->outputs,
                                    "File to write: .exr (all layers of PICTURE, which itself becomes the "
                                    "layer noisy), .png or .jpg. Repeat "
                                    "the option for more files");
  output.at_commas = false;  // file names may hold commas
  command.add_quiet();
  add_setting_options(command, options->overrides, SettingsCommand::kDenoise);
  command.run = [options](const Console& console) { return run_denoise(*options, console); };
  return command;
}

}  // namespace kaustik::app
